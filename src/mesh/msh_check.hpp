// What must be true of a .msh before Gmsh may see it.
#pragma once

#include <string>

namespace cobasis {

/// The whole of a readable, non-empty regular file. Throws InputError naming it.
std::string read_whole_file(const std::string& file);

/// Of a .msh the sections that Gmsh may see: nodes, elements and what groups them. Throws InputError: not a mesh (Gmsh
/// would run it as a script), a version other than 2.x and 4.1, sections that a mesh has not, cut short, or counts that
/// the file cannot hold.
std::string check_msh(const std::string& file, const std::string& text);

}  // namespace cobasis
