#include "solver/initial_condition.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "math/errors.hpp"
#include "solver/cut_cell.hpp"

namespace cobasis {
namespace {

void check_groups(const std::vector<RegionSetup>& regions, const Mesh& mesh) {
  const auto& names = mesh.region_names;
  for (const RegionSetup& region : regions) {
    const auto* group = std::get_if<PhysicalGroup>(&region.shape);
    if (!group || std::find(names.begin(), names.end(), group->name) != names.end()) continue;
    const std::string allowed =
        names.empty() ? "it names none of its cells" : fmt::format("{}", fmt::join(names, ", "));
    throw InputError(fmt::format("{}: the mesh has no cells in a physical group '{}'; allowed: {}", region.where,
                                 group->name, allowed));
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

}  // namespace cobasis
