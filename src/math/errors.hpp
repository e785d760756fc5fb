// What the user can mend: said in full by the exception's text. main turns it into exit status 2 (input) or 4 (system).
#pragma once

#include <stdexcept>

namespace cobasis {

struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct SystemError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace cobasis
