#include "solver/caution.hpp"

#include <algorithm>

namespace cobasis {
namespace {

constexpr int first_rings = 2;         ///< of neighbours around a cell noted
constexpr std::int64_t duration = 20;  ///< [steps]

}  // namespace

Caution::Caution(const Mpi& mpi, const Mesh& mesh)
    : until_(mesh.n_cells(), 0), exchange_(mpi, mesh.neighbours, halo_capacities(mesh.neighbours, 1), 19) {}

void Caution::spread(const Mesh& mesh, std::int64_t step, int failed) {
  const std::int64_t until = step + duration;
  const int rings = first_rings + 2 * std::max(0, failed - 2);
  for (const std::int32_t cell : noted_) until_[cell] = until;
  noted_.clear();
  for (int ring = 0; ring <= rings; ++ring) {
    tell_halo(mesh);
    if (ring == rings) break;
    const std::vector<std::int64_t> before = until_;
    for (std::int32_t f = 0; f < mesh.first_boundary_face(); ++f) {
      const std::int32_t left = mesh.left[f], right = mesh.right[f];
      if (before[left] == until) until_[right] = until;
      if (before[right] == until) until_[left] = until;
    }
  }
  until_any_ = until;
}

/// Halo cells are treated as their owners say.
void Caution::tell_halo(const Mesh& mesh) {
  exchange_cells(exchange_, mesh.neighbours, [&](std::int32_t cell, const auto& with) { with(until_[cell]); });
}

void Caution::tell(Fields& fields, std::int64_t step) {
  if (step >= until_any_) {
    fields.cautious.clear();
    return;
  }
  fields.cautious.resize(fields.n_all);
  for (std::size_t cell = 0; cell < until_.size(); ++cell) fields.cautious[cell] = step < until_[cell] ? 1 : 0;
}

}  // namespace cobasis
