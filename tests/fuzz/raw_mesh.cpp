// Nodes, cells and boundary elements as Gmsh may hand them over, connected, measured and cut into parts.
#include "mesh/raw_mesh.hpp"

#include <cmath>

#include "fuzz.hpp"
#include "math/errors.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/distribute.hpp"
#include "mesh/global_mesh.hpp"

using namespace cobasis;

namespace {

RawMesh raw_mesh_of(Numbers& numbers) {
  RawMesh raw;
  raw.dimension = 2 + numbers.below(2);
  raw.region_names = {"body"};
  raw.group_names = {"a", "b", "c"};
  const int n_nodes = 3 + numbers.below(30);
  for (int i = 0; i < n_nodes; ++i) {
    Point p{numbers.coordinate(), numbers.coordinate(), raw.dimension == 3 ? numbers.coordinate() : 0.0};
    for (double* const x : {&p.x, &p.y, &p.z})
      if (!std::isfinite(*x)) *x = 0;  // the reader has refused it
    raw.nodes.push_back(p);
  }
  const int n_cells = 1 + numbers.below(24);
  for (int i = 0; i < n_cells; ++i) {
    const int type = raw.dimension == 2 ? numbers.below(2) : 2 + numbers.below(4);
    raw.cell_type.push_back(static_cast<CellType>(type));
    for (int c = 0; c < cell_shapes[type].n_corners; ++c) raw.cell_nodes.push_back(numbers.below(n_nodes));
    raw.cell_node_begin.push_back(static_cast<std::int32_t>(raw.cell_nodes.size()));
    raw.cell_tag.push_back(i + 1);
    raw.cell_region.push_back(numbers.below(2) - 1);
  }
  while (!numbers.empty() && raw.side_nodes.size() < 100) {
    const int kind = numbers.below(2), n = raw.dimension == 2 ? 2 : 3 + kind;
    std::array<std::int32_t, 4> side{-1, -1, -1, -1};
    for (int c = 0; c < n; ++c) side[c] = raw.cell_nodes[numbers.take<std::uint8_t>() % raw.cell_nodes.size()];
    raw.side_nodes.push_back(side);
    raw.side_tag.push_back(100 + static_cast<std::int64_t>(raw.side_nodes.size()));
    raw.side_group.push_back(numbers.below(3));
  }
  return raw;
}

/// Every bare face of a cell gets the first group: else hardly a mesh would get past its boundary.
void close_boundary(RawMesh& raw) {
  for (std::int32_t cell = 0; cell < raw.n_cells(); ++cell) {
    const CellShape& shape = shape_of(raw.cell_type[cell]);
    for (int f = 0; f < shape.n_faces; ++f) {
      std::array<std::int32_t, 4> side{-1, -1, -1, -1};
      for (int c = 0; c < shape.faces[f].size; ++c)
        side[c] = raw.cell_nodes[raw.cell_node_begin[cell] + shape.faces[f].corner[c]];
      raw.side_nodes.push_back(side);
      raw.side_tag.push_back(1000 + static_cast<std::int64_t>(raw.side_nodes.size()));
      raw.side_group.push_back(f % 3);
    }
  }
}

void check(const Mesh& mesh) {
  claim(mesh.n_owned > 0 && mesh.n_faces() == std::ssize(mesh.left));
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    claim(mesh.left[f] >= 0 && mesh.left[f] < mesh.n_cells());
    claim(mesh.right[f] >= 0 && mesh.right[f] < mesh.n_cells() + mesh.n_ghosts);
    claim(mesh.area[f] >= 0);
  }
  for (const double volume : mesh.volume) claim(volume > 0);
  for (const std::int32_t node : mesh.cell_nodes) claim(node >= 0 && node < std::ssize(mesh.nodes));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(data, size);
  const int choices = numbers.take<std::uint8_t>();
  RawMesh raw = raw_mesh_of(numbers);
  if (choices & 1) close_boundary(raw);
  const bool axisymmetric = (choices & 2) && raw.dimension == 2;
  std::vector<std::pair<std::string, std::string>> periodic;
  if (choices & 4) periodic.emplace_back("a", "b");
  try {
    const GlobalMesh whole = build_global_mesh(std::move(raw), periodic, axisymmetric);
    const int n_parts = std::min(whole.n_cells(), 1 + choices / 8 % 3);
    std::vector<int> owner(whole.n_cells());
    for (std::int32_t cell = 0; cell < whole.n_cells(); ++cell) owner[cell] = cell % n_parts;
    PartCutter cutter(whole, owner, n_parts);
    for (int part = 0; part < n_parts; ++part) {
      const Mesh mesh = cutter.cut(part);
      check(mesh);
      const std::vector<char> bytes = pack(mesh);
      claim(pack(unpack(bytes)) == bytes);
    }
  } catch (const InputError&) {
  }
  return 0;
}
