#include "solver/orphans.hpp"

namespace cobasis {
namespace {

std::vector<std::size_t> capacities(const Mesh& mesh, std::size_t per_cell) {
  std::vector<std::size_t> values;
  for (const Neighbour& n : mesh.neighbours) values.push_back(per_cell * n.receive_count);
  return values;
}

}  // namespace

Orphans::Orphans(const Mpi& mpi, const Mesh& mesh, const Fields& fields)
    : mpi_(mpi),
      exchange_(mpi, mesh.neighbours, capacities(mesh, fields.n_phases()), 20),
      sound_(fields.n_phases(), std::vector<std::int8_t>(mesh.n_cells(), 0)) {}

const std::vector<std::pair<std::int32_t, int>>& Orphans::find(const Mesh& mesh, const Faces& faces,
                                                               const Fields& fields,
                                                               std::span<const std::pair<std::int32_t, int>> fragments,
                                                               double least) {
  found_.clear();
  if (!mpi_.any(!fragments.empty())) return found_;
  for (int k = 0; k < fields.n_phases(); ++k)
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) sound_[k][cell] = fields.phases[k].alpha[cell] >= least;
  for (const auto& [cell, k] : fragments) sound_[k][cell] = false;
  exchange_cells(exchange_, mesh.neighbours, [&](std::int32_t cell, const auto& with) {
    for (auto& of_phase : sound_) with(of_phase[cell]);
  });
  for (const auto& [cell, k] : fragments) {
    bool alone = true;
    for (int f = 0; f < faces.max_cell_faces && alone; ++f) {
      const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell];
      const std::int32_t face = entry >> 1;
      if (face >= mesh.first_boundary_face()) continue;
      const std::int32_t other = entry & 1 ? faces.left[face] : faces.right[face];
      alone = other == cell || !sound_[k][other];
    }
    if (alone) found_.emplace_back(cell, k);
  }
  return found_;
}

}  // namespace cobasis
