#include "mesh/distribute.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/bytes.hpp"
#include "mesh/geometry.hpp"

namespace cobasis {

struct PartCutter::Draft {
  int part = 0;
  Mesh mesh;
  std::vector<std::int64_t> faces;                      ///< global faces in local order
  std::map<int, std::set<std::int32_t>> send, receive;  ///< global cells by other part
};

PartCutter::PartCutter(const GlobalMesh& whole, const std::vector<int>& owner, int n_parts)
    : whole_(whole), owner_(owner), owned_(n_parts), local_(whole.n_cells(), -1) {
  for (std::int32_t cell = 0; cell < whole.n_cells(); ++cell) owned_[owner[cell]].push_back(cell);
}

Mesh PartCutter::cut(int part) {
  Draft draft;
  draft.part = part;
  const std::vector<std::int32_t>& owned = owned_[part];

  for (const std::int32_t cell : owned) {
    for (std::int64_t i = whole_.cell_face_begin[cell]; i < whole_.cell_face_begin[cell + 1]; ++i) {
      const std::int64_t f = whole_.cell_faces[i] / 2;
      const FaceLink& face = whole_.faces[f];
      draft.faces.push_back(f);
      const std::int32_t other = whole_.cell_faces[i] % 2 == 0 ? face.right : face.left;
      if (other < 0 || owner_[other] == part) continue;
      draft.send[owner_[other]].insert(cell);
      draft.receive[owner_[other]].insert(other);
    }
  }
  std::sort(draft.faces.begin(), draft.faces.end());
  draft.faces.erase(std::unique(draft.faces.begin(), draft.faces.end()), draft.faces.end());

  Mesh& mesh = draft.mesh;
  mesh.dimension = whole_.raw.dimension;
  mesh.axisymmetric = whole_.axisymmetric;
  mesh.n_global = whole_.n_cells();
  mesh.n_owned = static_cast<std::int32_t>(owned.size());
  mesh.global_id.assign(owned.begin(), owned.end());
  for (const auto& [other, cells] : draft.receive)
    mesh.global_id.insert(mesh.global_id.end(), cells.begin(), cells.end());
  mesh.n_halo = static_cast<std::int32_t>(mesh.global_id.size()) - mesh.n_owned;
  for (std::int32_t i = 0; i < mesh.n_cells(); ++i) local_[mesh.global_id[i]] = i;

  add_cells(draft);
  add_faces(draft);
  add_cell_faces(draft);
  add_neighbours(draft);
  for (const std::int64_t cell : mesh.global_id) local_[cell] = -1;
  return std::move(draft.mesh);
}

void PartCutter::add_cells(Draft& draft) const {
  Mesh& mesh = draft.mesh;
  mesh.region_names = whole_.raw.region_names;
  mesh.cell_node_begin.push_back(0);
  for (const std::int64_t id : mesh.global_id) {
    const auto cell = static_cast<std::int32_t>(id);
    mesh.volume.push_back(whole_.volume[cell]);
    mesh.centroid.push_back(whole_.centroid[cell]);
    if (mesh.axisymmetric) {
      mesh.section.push_back(whole_.section[cell]);
      mesh.section_centroid.push_back(whole_.section_centroid[cell]);
    }
    mesh.cell_type.push_back(whole_.raw.cell_type[cell]);
    mesh.cell_region.push_back(whole_.raw.cell_region[cell]);
    const auto nodes = whole_.nodes_of(cell);
    mesh.cell_nodes.insert(mesh.cell_nodes.end(), nodes.begin(), nodes.end());
    mesh.cell_node_begin.push_back(static_cast<std::int32_t>(mesh.cell_nodes.size()));
  }
  std::vector<std::int32_t> used = mesh.cell_nodes;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::int32_t node : used) mesh.nodes.push_back(whole_.raw.nodes[node]);
  mesh.node_global_id.assign(used.begin(), used.end());
  for (std::int32_t& node : mesh.cell_nodes)
    node = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), node) - used.begin());
}

void PartCutter::add_faces(Draft& draft) const {
  Mesh& mesh = draft.mesh;
  // The global order holds inside each of the three classes.
  const auto place = [&](std::int64_t f) {
    const FaceLink& face = whole_.faces[f];
    if (face.right < 0) return 2;
    return owner_[face.left] == draft.part && owner_[face.right] == draft.part ? 0 : 1;
  };
  std::stable_sort(draft.faces.begin(), draft.faces.end(),
                   [&](std::int64_t a, std::int64_t b) { return place(a) < place(b); });
  for (const std::string& name : whole_.boundary_names) mesh.boundary_groups.push_back({name, 0, 0});
  std::array<std::int32_t, 3> count{};
  for (const std::int64_t f : draft.faces) ++count[place(f)];
  mesh.n_interior_faces = count[0];
  mesh.n_halo_faces = count[1];
  mesh.n_boundary_faces = mesh.n_ghosts = count[2];

  std::vector<std::int32_t> in_group(whole_.boundary_names.size(), 0);
  for (std::int32_t i = 0; i < mesh.n_faces(); ++i) {
    const std::int64_t f = draft.faces[i];
    const FaceLink& face = whole_.faces[f];
    mesh.left.push_back(local_[face.left]);
    mesh.right.push_back(face.right < 0 ? mesh.ghost_of(i) : local_[face.right]);
    const FaceFrame frame = face_frame(whole_.face_area[f]);
    mesh.area.push_back(length(whole_.face_area[f]) * (mesh.axisymmetric ? whole_.face_circumference[f] : 1.0));
    mesh.nx.push_back(frame.n.x);
    mesh.ny.push_back(frame.n.y);
    mesh.nz.push_back(frame.n.z);
    mesh.tx.push_back(frame.t1.x);
    mesh.ty.push_back(frame.t1.y);
    mesh.tz.push_back(frame.t1.z);
    mesh.face_centroid.push_back(whole_.face_centroid[f]);
    mesh.face_delta.push_back(whole_.delta(f));
    if (face.group >= 0) ++in_group[face.group];
  }
  std::int32_t first = mesh.first_boundary_face();
  for (std::size_t g = 0; g < in_group.size(); ++g) {
    mesh.boundary_groups[g].first = first;
    mesh.boundary_groups[g].last = first += in_group[g];
  }
}

void PartCutter::add_cell_faces(Draft& draft) const {
  Mesh& mesh = draft.mesh;
  std::unordered_map<std::int64_t, std::int32_t> local_face;
  local_face.reserve(draft.faces.size());
  for (std::int32_t i = 0; i < mesh.n_faces(); ++i) local_face.emplace(draft.faces[i], i);
  const auto begin = [&](std::int32_t i) { return whole_.cell_face_begin[mesh.global_id[i]]; };
  const auto end = [&](std::int32_t i) { return whole_.cell_face_begin[mesh.global_id[i] + 1]; };
  for (std::int32_t i = 0; i < mesh.n_owned; ++i)
    mesh.max_cell_faces = std::max(mesh.max_cell_faces, static_cast<int>(end(i) - begin(i)));
  mesh.cell_stride = (mesh.n_owned + 15) / 16 * 16;
  mesh.cell_faces.assign(static_cast<std::size_t>(mesh.cell_stride) * mesh.max_cell_faces, -1);
  for (std::int32_t i = 0; i < mesh.n_owned; ++i)
    for (std::int64_t j = begin(i); j < end(i); ++j) {
      const std::int64_t entry = whole_.cell_faces[j];
      mesh.cell_faces[static_cast<std::size_t>(j - begin(i)) * mesh.cell_stride + i] =
          2 * local_face.at(entry / 2) + static_cast<std::int32_t>(entry % 2);
    }
}

void PartCutter::add_neighbours(Draft& draft) const {
  Mesh& mesh = draft.mesh;
  std::int32_t next = mesh.n_owned;
  for (const auto& [other, cells] : draft.receive) {
    Neighbour neighbour;
    neighbour.rank = other;
    for (const std::int32_t cell : draft.send.at(other)) neighbour.send.push_back(local_[cell]);
    neighbour.receive_first = next;
    neighbour.receive_count = static_cast<std::int32_t>(cells.size());
    next += neighbour.receive_count;
    mesh.neighbours.push_back(std::move(neighbour));
  }
}

namespace {

template <class M, class Visit>
void for_each_part(M& mesh, Visit& visit) {
  for (auto* number : {&mesh.n_owned, &mesh.n_halo, &mesh.n_ghosts, &mesh.n_interior_faces, &mesh.n_halo_faces,
                       &mesh.n_boundary_faces, &mesh.cell_stride})
    visit(*number);
  visit(mesh.dimension);
  visit(mesh.axisymmetric);
  visit(mesh.max_cell_faces);
  visit(mesh.n_global);
  visit(mesh.volume);
  visit(mesh.centroid);
  visit(mesh.section);
  visit(mesh.section_centroid);
  visit(mesh.global_id);
  visit(mesh.cell_type);
  visit(mesh.cell_region);
  visit(mesh.cell_node_begin);
  visit(mesh.cell_nodes);
  visit(mesh.region_names);
  visit(mesh.nodes);
  visit(mesh.node_global_id);
  for (auto* cells : {&mesh.left, &mesh.right, &mesh.cell_faces}) visit(*cells);
  for (auto* numbers : {&mesh.area, &mesh.nx, &mesh.ny, &mesh.nz, &mesh.tx, &mesh.ty, &mesh.tz}) visit(*numbers);
  visit(mesh.face_centroid);
  visit(mesh.face_delta);
}

}  // namespace

std::vector<char> pack(const Mesh& mesh) {
  ByteWriter writer;
  for_each_part(mesh, writer);
  writer(mesh.boundary_groups.size());
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    writer(group.name);
    writer(group.first);
    writer(group.last);
  }
  writer(mesh.neighbours.size());
  for (const Neighbour& neighbour : mesh.neighbours) {
    writer(neighbour.rank);
    writer(neighbour.send);
    writer(neighbour.receive_first);
    writer(neighbour.receive_count);
  }
  return writer.bytes;
}

Mesh unpack(const std::vector<char>& bytes) {
  Mesh mesh;
  ByteReader reader(bytes);
  for_each_part(mesh, reader);
  std::size_t size = 0;
  reader(size);
  mesh.boundary_groups.resize(size);
  for (BoundaryGroup& group : mesh.boundary_groups) {
    reader(group.name);
    reader(group.first);
    reader(group.last);
  }
  reader(size);
  mesh.neighbours.resize(size);
  for (Neighbour& neighbour : mesh.neighbours) {
    reader(neighbour.rank);
    reader(neighbour.send);
    reader(neighbour.receive_first);
    reader(neighbour.receive_count);
  }
  return mesh;
}

}  // namespace cobasis
