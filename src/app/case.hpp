// A case file, read, validated and told apart from what is wrong with it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/setup.hpp"

namespace cobasis {

/// Changes to a case from the command line: --set key=value, --output DIR.
struct CaseOverrides {
  std::vector<std::pair<std::string, std::string>> set;  ///< dotted key, TOML value or bare words
  std::string output;                                    ///< relative to the working directory; empty: the case's
};

/// A periodic pair has an entry for each of its groups, even where the case names it once. The output directory is
/// relative to the working directory. With setup.scene, check_for_geometry holds.
/// Throws InputError listing every mistake found, one per line: `file:line: what was found; what is allowed; nearest
/// name`.
Setup read_case(const std::string& file, const CaseOverrides& overrides = {});

/// What can be checked only once the geometry is known, by the case or by its mesh: third components in a plane,
/// cylinders, flat boxes. Throws InputError listing every mistake.
void check_for_geometry(const Setup& setup, Geometry geometry);

/// The periodic groups, each pair once, in the order of the case.
std::vector<std::pair<std::string, std::string>> periodic_pairs(const Setup& setup);

}  // namespace cobasis
