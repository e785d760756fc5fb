#include "app/integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "math/field_info.hpp"

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

struct Layer {
  double x;       ///< coordinate
  double volume;  ///< of the phase
};

/// The volumes in the order of their coordinates. Cells side by side on a structured mesh differ by round-off only:
/// they are one layer, or the quantile would jump from row to row.
std::vector<Layer> layers_of(const std::vector<double>& coordinates, const std::vector<double>& volumes,
                             const std::vector<std::int64_t>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(coordinates[a], ids[a]) < std::pair(coordinates[b], ids[b]);
  });
  std::vector<Layer> layers;
  if (order.empty()) return layers;
  const double same = 1e-9 * (coordinates[order.back()] - coordinates[order.front()]);
  for (const std::size_t i : order) {
    if (layers.empty() || coordinates[i] > layers.back().x + same) layers.push_back({coordinates[i], 0});
    layers.back().volume += volumes[i];
  }
  return layers;
}

/// Coordinate below which the fraction of the volume lies: half of a layer lies below its coordinate, linear between.
double quantile_of(const std::vector<Layer>& layers, double fraction) {
  if (layers.empty()) return nowhere;
  double total = 0;
  for (const Layer& layer : layers) total += layer.volume;
  const double target = fraction * total;
  double below = 0.5 * layers.front().volume;
  if (target <= below) return layers.front().x;
  for (std::size_t i = 1; i < layers.size(); ++i) {
    const double step = 0.5 * (layers[i - 1].volume + layers[i].volume);
    if (target <= below + step) {
      return layers[i - 1].x + (target - below) / step * (layers[i].x - layers[i - 1].x);
    }
    below += step;
  }
  return layers.back().x;
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
  return geometry == Geometry::plane ? std::abs(x.y) : std::sqrt(x.x * x.x + x.y * x.y);
}

Integrals::Integrals(std::vector<IntegralSetup> setups, Geometry geometry, const Mesh& mesh, const Mpi& mpi)
    : setups_(std::move(setups)),
      geometry_(geometry),
      mesh_(mesh),
      mpi_(mpi),
      exchange_(mpi, mesh.neighbours, halo_sizes(mesh), message_tag) {}

std::vector<double> Integrals::evaluate(const Snapshot& snapshot) {
  std::vector<double> results;
  for (const IntegralSetup& setup : setups_) {
    results.push_back(std::visit(
        [&](const auto& what) {
          if constexpr (std::is_same_v<std::decay_t<decltype(what)>, Extent>) {
            return evaluate(what, alpha_with_halo(snapshot, what.phase));
          } else {
            return evaluate(what, snapshot.phases[what.phase].alpha);
          }
        },
        setup.what));
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
  const auto reach = [&](const Point& x) { farthest = std::max(farthest, coordinate(x, extent.axis, geometry_)); };
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

double Integrals::evaluate(const Quantile& quantile, const std::vector<double>& alpha) const {
  std::vector<double> coordinates;
  std::vector<double> volumes;
  std::vector<std::int64_t> ids;
  for (std::int32_t i = 0; i < mesh_.n_owned; ++i) {
    if (alpha[i] <= 0) continue;
    coordinates.push_back(coordinate(mesh_.centroid[i], quantile.axis, geometry_));
    volumes.push_back(alpha[i] * mesh_.volume[i]);
    ids.push_back(mesh_.global_id[i]);
  }
  coordinates = mpi_.gather(std::span<const double>(coordinates));
  volumes = mpi_.gather(std::span<const double>(volumes));
  ids = mpi_.gather(std::span<const std::int64_t>(ids));
  std::vector<char> result;
  if (mpi_.root()) {
    const double value = quantile_of(layers_of(coordinates, volumes, ids), quantile.fraction);
    const char* bytes = reinterpret_cast<const char*>(&value);
    result.assign(bytes, bytes + sizeof value);
  }
  mpi_.broadcast(result);
  double value = 0;
  std::copy(result.begin(), result.end(), reinterpret_cast<char*>(&value));
  return value;
}

}  // namespace cobasis
