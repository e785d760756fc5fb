#include "app/integrals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "app/output_fields.hpp"
#include "app/sampler.hpp"
#include "math/errors.hpp"
#include "math/field_info.hpp"
#include "solver/cut_cell.hpp"

namespace cobasis {
namespace {

constexpr int message_tag = 901;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

std::vector<std::size_t> halo_sizes(const Mesh& mesh) {
  std::vector<std::size_t> sizes;
  for (const Neighbour& neighbour : mesh.neighbours) sizes.push_back(static_cast<std::size_t>(neighbour.receive_count));
  return sizes;
}

bool through_periodic_image(const Mesh& mesh, std::int32_t face) {
  const Point& delta = mesh.face_delta[face];
  const Point difference = mesh.centroid[mesh.right[face]] - mesh.centroid[mesh.left[face]] - delta;
  return dot(difference, difference) > 1e-18 * dot(delta, delta);
}

bool is_in(const Box& box, const Point& x) {
  return box.low.x <= x.x && x.x <= box.high.x && box.low.y <= x.y && x.y <= box.high.y && box.low.z <= x.z &&
         x.z <= box.high.z;
}

}  // namespace

double coordinate(const Point& x, Axis axis, Geometry geometry) {
  switch (axis) {
    case Axis::x:
      return x.x;
    case Axis::y:
      return x.y;
    case Axis::z:
      return x.z;
    case Axis::radial:
      break;
  }
  return geometry != Geometry::space ? std::abs(x.y) : std::sqrt(x.x * x.x + x.y * x.y);
}

Integrals::Integrals(std::vector<IntegralSetup> setups, Geometry geometry, const Mesh& mesh, const Mpi& mpi,
                     std::vector<PhaseSetup> phases)
    : setups_(std::move(setups)),
      geometry_(geometry),
      mesh_(mesh),
      mpi_(mpi),
      exchange_(mpi, mesh.neighbours, halo_sizes(mesh), message_tag),
      phases_(std::move(phases)) {
  for (const IntegralSetup& setup : setups_) regions_.push_back(region_of(setup));
}

Integrals::Region Integrals::region_of(const IntegralSetup& setup) const {
  Region region;
  Shape shape = Everywhere{};
  std::string where;
  if (const auto* mean = std::get_if<Mean>(&setup.what)) {
    shape = mean->region;
    where = mean->where;
  } else if (const auto* extent = std::get_if<Extent>(&setup.what); extent && extent->box) {
    shape = *extent->box;
    where = extent->where;
  } else {
    return region;
  }
  for (std::int32_t i = 0; i < mesh_.n_owned; ++i) {
    const double fraction = inside_fraction(shape, mesh_, i);
    if (fraction == 0) continue;
    region.cells.push_back(i);
    region.volumes.push_back(fraction * mesh_.volume[i]);
  }
  if (!mpi_.any(!region.cells.empty()))
    throw InputError(fmt::format(
        "{}: integral \"{}\": the box lies outside the mesh; allowed: one that holds part of it", where, setup.name));
  return region;
}

std::vector<double> Integrals::evaluate(const Snapshot& snapshot) {
  std::vector<double> results;
  for (std::size_t i = 0; i < setups_.size(); ++i) {
    results.push_back(std::visit(
        [&](const auto& what) {
          if constexpr (std::is_same_v<std::decay_t<decltype(what)>, Extent>) {
            return evaluate(what, alpha_with_halo(snapshot, what.phase));
          } else if constexpr (std::is_same_v<std::decay_t<decltype(what)>, Mean>) {
            return evaluate(what, regions_[i], snapshot);
          } else {
            return evaluate(what, snapshot.phases[what.phase].alpha);
          }
        },
        setups_[i].what));
  }
  return results;
}

std::vector<double> Integrals::alpha_with_halo(const Snapshot& snapshot, int phase) {
  std::vector<double> alpha = snapshot.phases[phase].alpha;
  alpha.resize(static_cast<std::size_t>(mesh_.n_cells()));
  for (std::size_t n = 0; n < mesh_.neighbours.size(); ++n) {
    std::vector<double>& values = exchange_.outgoing(n);
    values.clear();
    for (const std::int32_t cell : mesh_.neighbours[n].send) values.push_back(alpha[cell]);
  }
  exchange_.start();
  exchange_.finish();
  for (std::size_t n = 0; n < mesh_.neighbours.size(); ++n) {
    const auto values = exchange_.incoming(n);
    std::copy(values.begin(), values.end(), alpha.begin() + mesh_.neighbours[n].receive_first);
  }
  return alpha;
}

double Integrals::evaluate(const Extent& extent, const std::vector<double>& alpha) const {
  double farthest = -infinity;
  const auto reach = [&](const Point& x) {
    if (!extent.box || is_in(*extent.box, x)) farthest = std::max(farthest, coordinate(x, extent.axis, geometry_));
  };
  for (std::int32_t i = 0; i < mesh_.n_owned; ++i) {
    if (alpha[i] >= extent.alpha) reach(mesh_.centroid[i]);
  }
  for (std::int32_t f = 0; f < mesh_.first_boundary_face(); ++f) {
    const std::int32_t l = mesh_.left[f];
    const std::int32_t r = mesh_.right[f];
    if ((alpha[l] >= extent.alpha) == (alpha[r] >= extent.alpha) || through_periodic_image(mesh_, f)) continue;
    const double weight = (extent.alpha - alpha[l]) / (alpha[r] - alpha[l]);
    reach(mesh_.centroid[l] + weight * (mesh_.centroid[r] - mesh_.centroid[l]));
  }
  for (std::int32_t f = mesh_.first_boundary_face(); f < mesh_.n_faces(); ++f) {
    if (alpha[mesh_.left[f]] >= extent.alpha) reach(mesh_.face_centroid[f]);
  }
  farthest = mpi_.max(farthest);
  return farthest == -infinity ? nowhere : farthest;
}

/// A cell's volume is spread evenly over the cell's range of the coordinate, so that the volume below a coordinate is
/// continuous and a body's edge is where its outermost cells end; a ring's over its range of r^2. The quantile is found
/// by the Illinois method.
double Integrals::evaluate(const Quantile& quantile, const std::vector<double>& alpha) const {
  struct Range {
    double low, high, volume;
  };
  const bool across_rings = mesh_.axisymmetric && quantile.axis != Axis::x;
  const auto evenly = [&](double x) { return across_rings ? x * x : x; };
  const auto back = [&](double x) { return across_rings ? std::sqrt(x) : x; };
  std::vector<Range> ranges;
  std::vector<double> volumes;
  double low = infinity, high = -infinity;
  for (std::int32_t i = 0; i < mesh_.n_owned; ++i) {
    if (!(alpha[i] > 0)) continue;
    Range range{infinity, -infinity, alpha[i] * mesh_.volume[i]};
    for (std::int32_t n = mesh_.cell_node_begin[i]; n < mesh_.cell_node_begin[i + 1]; ++n) {
      const double x = evenly(coordinate(mesh_.nodes[mesh_.cell_nodes[n]], quantile.axis, geometry_));
      range.low = std::min(range.low, x);
      range.high = std::max(range.high, x);
    }
    low = std::min(low, range.low);
    high = std::max(high, range.high);
    ranges.push_back(range);
    volumes.push_back(range.volume);
  }
  low = mpi_.min(low);
  high = mpi_.max(high);
  if (!(low <= high)) return nowhere;
  const double total = mpi_.exact_sum(volumes);
  const auto excess_below = [&](double x) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const Range& range = ranges[i];
      volumes[i] = x <= range.low    ? 0
                   : x >= range.high ? range.volume
                                     : (x - range.low) / (range.high - range.low) * range.volume;
    }
    return mpi_.exact_sum(volumes) / total - quantile.fraction;
  };
  double below = -quantile.fraction, above = 1 - quantile.fraction;
  const double tolerance = 1e-12 * (high - low);
  int repeated = 0;  // > 0: `high` was replaced last, < 0: `low`
  for (int i = 0; i < 100 && high - low > tolerance; ++i) {
    const double x = low - below * (high - low) / (above - below);
    const double excess = excess_below(x);
    if (std::abs(excess) < 1e-14) return back(x);
    if (excess > 0) {
      high = x;
      above = excess;
      if (repeated > 0) below *= 0.5;
      repeated = 1;
    } else {
      low = x;
      below = excess;
      if (repeated < 0) above *= 0.5;
      repeated = -1;
    }
  }
  return back(0.5 * (low + high));
}

double Integrals::evaluate(const Mean& mean, const Region& region, const Snapshot& snapshot) const {
  const Snapshot here = extract(snapshot, region.cells);
  const Mixture mixture = mix(here, phases_);
  for (const OutputField& field : output_fields(all_output_fields(), here, mixture)) {
    for (std::size_t c = 0; c < field.values.size(); ++c) {
      if (field.column(c) != mean.field) continue;
      std::vector<double> weights = region.volumes, products;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!field.presence.empty()) weights[i] *= field.presence[i];
        products.push_back(weights[i] * field.values[c][i]);
      }
      const double total = mpi_.exact_sum(weights);
      const double sum = mpi_.exact_sum(products);
      return total > 0 ? sum / total : nowhere;
    }
  }
  assert(false);  // the reader of the case knows the fields
  return nowhere;
}

}  // namespace cobasis
