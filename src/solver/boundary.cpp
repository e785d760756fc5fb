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

void check_axis(const Setup& setup, const Mesh& mesh, const std::vector<Boundary>& boundaries, const Mpi& mpi) {
  if (!mesh.axisymmetric) return;
  std::string mistakes;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const BoundaryGroup& group = mesh.boundary_groups[i];
    bool on_axis = false, off_axis = false;
    for (std::int32_t face = group.first; face < group.last; ++face) (mesh.area[face] == 0 ? on_axis : off_axis) = true;
    on_axis = mpi.any(on_axis), off_axis = mpi.any(off_axis);
    const bool is_axis = std::holds_alternative<AxisOfSymmetry>(boundaries[i]);
    if (is_axis ? !off_axis : !on_axis) continue;
    std::string where = setup.case_file;
    for (const BoundarySetup& boundary : setup.boundaries)
      if (boundary.group == group.name || (boundary.group == "*" && where == setup.case_file)) where = boundary.where;
    if (is_axis)
      mistakes += fmt::format(
          "{}: boundary '{}' = \"axis\", but it has faces off the axis y = 0; allowed: \"axis\" for "
          "groups on it, another condition for the others\n",
          where, group.name);
    else
      mistakes += fmt::format(
          "{}: boundary '{}' has faces on the axis y = 0; allowed: a group of its own for them, with "
          "the condition \"axis\"\n",
          where, group.name);
  }
  if (!mistakes.empty()) throw InputError(mistakes.substr(0, mistakes.size() - 1));
}

void prescribe(const Mesh& mesh, const std::vector<Boundary>& boundaries, Faces& faces) {
  if (std::none_of(boundaries.begin(), boundaries.end(), is_prescribed)) return;
  Prescribed& given = faces.prescribed;
  for (auto* values : {&given.u[0], &given.u[1], &given.u[2], &given.bonded, &given.outlet, &given.pressure})
    values->assign(faces.area.size(), 0);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const auto* wall = std::get_if<Wall>(&boundaries[i]);
    const auto* no_slip = std::get_if<NoSlip>(&boundaries[i]);
    const auto* outlet = std::get_if<Outlet>(&boundaries[i]);
    const std::array<Expression, 3>* const velocity = no_slip                  ? &no_slip->velocity
                                                      : wall && wall->velocity ? &*wall->velocity
                                                                               : nullptr;
    for (std::int32_t face = mesh.boundary_groups[i].first; face < mesh.boundary_groups[i].last; ++face) {
      for (int d = 0; velocity && d < 3; ++d) given.u[d][face] = (*velocity)[d](mesh.face_centroid[face]);
      given.bonded[face] = no_slip != nullptr;
      if (!outlet) continue;
      given.outlet[face] = 1;
      given.pressure[face] = outlet->pressure;
    }
  }
}

}  // namespace cobasis
