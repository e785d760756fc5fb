// What must be true of a .msh before Gmsh may see it.
#pragma once

#include <string>

namespace cobasis {

/// Throws InputError: no such file, a directory, empty, not a mesh (Gmsh would run it as a script), a version other
/// than 2.x and 4.1, cut short, or counts that the file cannot hold. Returns the file's size in bytes.
std::size_t check_msh(const std::string& file);

/// The whole of a readable, non-empty regular file. Throws InputError naming it.
std::string read_whole_file(const std::string& file);

}  // namespace cobasis
