// The text of `cobasis help materials`, from the list by which the reader finds materials.
#pragma once

#include <string>

namespace cobasis {

std::string describe_materials();

}  // namespace cobasis
