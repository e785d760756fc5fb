// What a .geo script would do, found by reading it, before Gmsh runs it.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cobasis {

struct GeoScript {
  std::vector<std::string> constants;  ///< the names its DefineConstant lists set, in order of appearance
};

/// Throws InputError with file:line for a script that is not text and, unless `trust`, for one that runs commands or
/// reads or writes other files.
GeoScript read_geo_script(const std::string& file, const std::string& script, bool trust);

/// Throws InputError for a parameter the script does not define, nearest names first.
void check_parameters(const std::string& file, const GeoScript& script,
                      const std::map<std::string, double>& parameters);

}  // namespace cobasis
