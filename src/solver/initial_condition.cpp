#include "solver/initial_condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/errors.hpp"
#include "math/suggestion.hpp"
#include "solver/cut_cell.hpp"

namespace cobasis {
namespace {

void check_groups(const std::vector<RegionSetup>& regions, const Mesh& mesh) {
  const auto& names = mesh.region_names;
  for (const RegionSetup& region : regions) {
    const auto* group = std::get_if<PhysicalGroup>(&region.shape);
    if (!group || std::find(names.begin(), names.end(), group->name) != names.end()) continue;
    throw InputError(
        fmt::format("{}: the mesh has no cells in a physical group '{}'; {}", region.where, group->name,
                    names.empty() ? "allowed: none, it names none of its cells" : allowed_names(group->name, names)));
  }
}

[[noreturn]] void refuse_uncovered(const std::vector<RegionSetup>& regions, const Point& x, double covered) {
  const std::string where = regions.empty() ? "" : regions.back().where + ": ";
  throw InputError(
      fmt::format("{}the cell at ({:g}, {:g}, {:g}) is {}covered by {}; let a first [[region]] have "
                  "shape = \"everywhere\"",
                  where, x.x, x.y, x.z, covered > 0 ? fmt::format("only to {:.3g} % ", 100 * covered) : "not ",
                  covered > 0 ? "regions" : "any region"));
}

bool contains(const Shape& shape, const Point& x, const std::string& group) {
  struct Visitor {
    const Point& x;
    const std::string& group;
    bool operator()(const Everywhere&) const { return true; }
    bool operator()(const HalfSpace& s) const { return dot(s.normal, x - s.point) > 0; }
    bool operator()(const Box& s) const {
      return s.low.x <= x.x && x.x <= s.high.x && s.low.y <= x.y && x.y <= s.high.y && s.low.z <= x.z &&
             x.z <= s.high.z;
    }
    bool operator()(const Sphere& s) const { return dot(x - s.center, x - s.center) < s.radius * s.radius; }
    bool operator()(const Cylinder& s) const {
      const Point axis = s.to - s.from, to_x = x - s.from;
      const double along = dot(axis, to_x) / dot(axis, axis);
      const Point across = to_x - along * axis;
      return 0 <= along && along <= 1 && dot(across, across) < s.radius * s.radius;
    }
    bool operator()(const PhysicalGroup& s) const { return s.name == group; }
    bool operator()(const Inside& s) const { return s.condition(x) != 0; }
  };
  return std::visit(Visitor{x, group}, shape);
}

}  // namespace

InitialState paint(const std::vector<RegionSetup>& regions, int n_phases, const Mesh& mesh) {
  check_groups(regions, mesh);
  const auto n_cells = static_cast<std::size_t>(mesh.n_owned);
  InitialState state;
  state.alpha.assign(n_phases, std::vector<double>(n_cells, 0));
  state.region.assign(n_phases, std::vector<std::int32_t>(n_cells, -1));

  std::vector<double> share(regions.size());  // of the cell's volume, that still shows each region
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    double covered = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const double f = inside_fraction(regions[r].shape, mesh, cell);
      for (std::size_t below = 0; below < r; ++below) share[below] *= 1 - f;
      share[r] = f;
      covered = (1 - f) * covered + f;
    }
    if (covered < 1 - 1e-10) refuse_uncovered(regions, mesh.centroid[cell], covered);

    for (int k = 0; k < n_phases; ++k) {
      double most = 0;
      for (std::size_t r = 0; r < regions.size(); ++r) {
        const double volume = share[r] * regions[r].filling.alpha[k];
        state.alpha[k][cell] += volume;
        if (volume > 0 && volume >= most) {
          most = volume;
          state.region[k][cell] = static_cast<std::int32_t>(r);
        }
      }
    }
  }
  return state;
}

int cell_cost(const Setup& setup, const Point& centroid, const std::string& group) {
  constexpr int fluid = 8, solid = 16;  // in units of a cell of void
  int cost = 1;
  for (const RegionSetup& region : setup.regions) {
    if (!contains(region.shape, centroid, group)) continue;
    cost = 1;
    for (std::size_t k = 0; k < setup.phases.size(); ++k)
      if (region.filling.alpha[k] > 0 && !setup.phases[k].is_void()) cost += setup.phases[k].is_solid() ? solid : fluid;
  }
  return cost;
}

}  // namespace cobasis
