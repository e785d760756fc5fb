#include "solver/orphans.hpp"

namespace cobasis {

Orphans::Orphans(const Mpi& mpi, const Mesh& mesh, const Fields& fields)
    : mpi_(mpi),
      exchange_(mpi, mesh.neighbours, halo_capacities(mesh.neighbours, fields.n_phases()), 20),
      is_fragment_(fields.n_phases(), std::vector<std::int8_t>(mesh.n_owned, 0)),
      sound_in_halo_(fields.n_phases(), std::vector<std::int8_t>(mesh.n_halo, 0)) {}

const std::vector<std::pair<std::int32_t, int>>& Orphans::find(const Mesh& mesh, const Faces& faces,
                                                               const Fields& fields,
                                                               std::span<const std::pair<std::int32_t, int>> fragments,
                                                               double least) {
  found_.clear();
  if (!mpi_.any(!fragments.empty())) return found_;
  for (const auto& [cell, k] : fragments) is_fragment_[k][cell] = true;
  const auto is_sound = [&](int k, std::int32_t cell) -> std::int8_t {
    if (cell >= mesh.n_owned) return sound_in_halo_[k][cell - mesh.n_owned];
    return fields.phases[k].alpha[cell] >= least && !is_fragment_[k][cell];
  };
  exchange_cells(exchange_, mesh.neighbours, [&](std::int32_t cell, const auto& with) {
    for (int k = 0; k < fields.n_phases(); ++k) {
      std::int8_t sound = is_sound(k, cell);
      with(sound);
      if (cell >= mesh.n_owned) sound_in_halo_[k][cell - mesh.n_owned] = sound;
    }
  });
  for (const auto& [cell, k] : fragments) {
    bool alone = fields.phases[k].alpha[cell] >= least;
    for (int f = 0; f < faces.max_cell_faces && alone; ++f) {
      const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell];
      const std::int32_t face = entry >> 1;
      if (face >= mesh.first_boundary_face()) continue;
      alone = !is_sound(k, entry & 1 ? faces.left[face] : faces.right[face]);
    }
    if (alone) found_.emplace_back(cell, k);
  }
  for (const auto& [cell, k] : fragments) is_fragment_[k][cell] = false;
  return found_;
}

}  // namespace cobasis
