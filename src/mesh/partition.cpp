#include "mesh/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "math/errors.hpp"

namespace cobasis {
namespace {

/// Neighbours of every cell, each once: METIS wants a graph without loops and double edges.
void dual_graph(const GlobalMesh& mesh, std::vector<idx_t>& begin, std::vector<idx_t>& neighbours) {
  begin.assign(1, 0);
  for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
    const auto first = static_cast<std::ptrdiff_t>(neighbours.size());
    for (std::int64_t i = mesh.cell_face_begin[cell]; i < mesh.cell_face_begin[cell + 1]; ++i) {
      const FaceLink& face = mesh.faces[mesh.cell_faces[i] / 2];
      const std::int32_t other = mesh.cell_faces[i] % 2 == 0 ? face.right : face.left;
      if (other >= 0 && other != cell) neighbours.push_back(other);
    }
    std::sort(neighbours.begin() + first, neighbours.end());
    neighbours.erase(std::unique(neighbours.begin() + first, neighbours.end()), neighbours.end());
    begin.push_back(static_cast<idx_t>(neighbours.size()));
  }
}

}  // namespace

std::vector<int> partition(const GlobalMesh& mesh, int n_parts, const MeshRequest& request) {
  std::vector<int> owner(mesh.n_cells(), 0);
  if (request.partition) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) owner[cell] = request.partition(cell, n_parts);
    return owner;
  }
  if (n_parts == 1) return owner;
  if (n_parts >= mesh.n_cells()) {
    std::iota(owner.begin(), owner.end(), 0);
    return owner;
  }
  std::vector<idx_t> begin, neighbours, weights;
  dual_graph(mesh, begin, neighbours);
  if (request.cell_weight) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
      const std::int32_t region = mesh.raw.cell_region[cell];
      const std::string group = region < 0 ? "" : mesh.raw.region_names[region];
      weights.push_back(std::max(1, request.cell_weight(mesh.centroid[cell], group)));
    }
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t n_cells = mesh.n_cells(), n_constraints = 1, parts = n_parts, cut = 0;
  std::vector<idx_t> part(mesh.n_cells());
  const int status = METIS_PartGraphKway(&n_cells, &n_constraints, begin.data(), neighbours.data(),
                                         weights.empty() ? nullptr : weights.data(), nullptr, nullptr, &parts, nullptr,
                                         nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw SystemError(fmt::format("METIS cannot partition the mesh (status {})", status));
  std::copy(part.begin(), part.end(), owner.begin());
  return owner;
}

}  // namespace cobasis
