#include "solver/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {

std::vector<Boundary> resolve_boundaries(const Setup& setup, const Mesh& mesh) {
  std::vector<std::string> groups;
  for (const BoundaryGroup& group : mesh.boundary_groups) groups.push_back(group.name);
  const auto in_mesh = [&](const std::string& name) {
    return std::any_of(mesh.boundary_groups.begin(), mesh.boundary_groups.end(),
                       [&](const BoundaryGroup& group) { return group.name == name; });
  };
  std::string mistakes;
  for (const BoundarySetup& boundary : setup.boundaries)
    if (boundary.group != "*" && !std::holds_alternative<Periodic>(boundary.boundary) && !in_mesh(boundary.group))
      mistakes += fmt::format("{}: boundary '{}' is not a physical group of the mesh's boundary; {}\n", boundary.where,
                              boundary.group, allowed_names(boundary.group, groups));
  std::vector<Boundary> result;
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    const BoundarySetup* found = nullptr;
    for (const BoundarySetup& boundary : setup.boundaries)
      if (boundary.group == group.name || (boundary.group == "*" && !found)) found = &boundary;
    if (found) {
      result.push_back(found->boundary);
    } else {
      mistakes += fmt::format(
          "{}: the mesh's physical group '{}' has no boundary condition; name it in [boundary] or add \"*\"\n",
          setup.boundaries.empty() ? setup.case_file : setup.boundaries.front().where, group.name);
    }
  }
  if (!mistakes.empty()) throw InputError(mistakes.substr(0, mistakes.size() - 1));
  return result;
}

}  // namespace cobasis
