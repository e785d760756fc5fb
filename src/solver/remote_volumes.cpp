#include "solver/remote_volumes.hpp"

#include <algorithm>
#include <cmath>

namespace cobasis {
namespace {

/// Negative volumes may take away so much of a root that the mean means nothing.
constexpr double least_of_root = 0.5;

}  // namespace

double RemoteVolumes::least_root(CellType type) {
  return type == CellType::triangle || type == CellType::tetrahedron ? 0.1 : 0.03;
}

RemoteVolumes::RemoteVolumes(const Mpi& mpi, const Mesh& mesh, const Fields& fields)
    : exchange_(mpi, mesh.neighbours, halo_capacities(mesh.neighbours, fields.n_phases() * (4 + most_components)), 19),
      at_(fields.n_phases(), std::vector<std::int32_t>(mesh.n_cells(), -1)) {}

RemoteVolumes::Node& RemoteVolumes::node_of(int k, std::int32_t cell) {
  if (at_[k][cell] < 0) {
    at_[k][cell] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({cell, k});
  }
  return nodes_[at_[k][cell]];
}

/// The cells beyond the faces of an owned cell, in the order of its faces, each once.
template <class Visit>
void RemoteVolumes::for_each_neighbour(const Mesh& mesh, const Faces& faces, std::int32_t cell,
                                       const Visit& visit) const {
  std::array<std::int32_t, 8> seen;
  int n_seen = 0;
  for (int f = 0; f < faces.max_cell_faces; ++f) {
    const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell];
    const std::int32_t face = entry >> 1;
    if (face >= mesh.first_boundary_face()) continue;
    const std::int32_t other = entry & 1 ? faces.left[face] : faces.right[face];
    if (other == cell || std::find(seen.begin(), seen.begin() + n_seen, other) != seen.begin() + n_seen) continue;
    seen[n_seen++] = other;
    visit(other);
  }
}

/// What owned nodes tell the ranks that have them as halo.
template <class Choice, class Numbers>
void RemoteVolumes::exchange(const Mesh& mesh, const Choice& chosen, const Numbers& numbers) {
  const int n_phases = static_cast<int>(at_.size());
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    std::vector<double>& out = exchange_.outgoing(n);
    out.clear();
    const std::vector<std::int32_t>& send = mesh.neighbours[n].send;
    for (std::size_t i = 0; i < send.size(); ++i)
      for (int k = 0; k < n_phases; ++k) {
        Node* const node = find(k, send[i]);
        if (!node || !chosen(*node)) continue;
        out.push_back(static_cast<double>(i));
        out.push_back(k);
        numbers(*node, [&](auto& value) { out.push_back(static_cast<double>(value)); });
      }
  }
  exchange_.start();
  exchange_.finish();
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const std::span<const double> in = exchange_.incoming(n);
    for (std::size_t at = 0; at < in.size();) {
      const std::int32_t cell = mesh.neighbours[n].receive_first + static_cast<std::int32_t>(in[at]);
      Node& node = node_of(static_cast<int>(in[at + 1]), cell);
      at += 2;
      numbers(node, [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(in[at++]); });
    }
  }
}

/// Hangs nodes on those of the level before, which have more of the phase; on roots at level 1. What has less between
/// itself and the root is debris: with the root's stress, step after step, it would swell at the root's expense.
void RemoteVolumes::grow(const Mesh& mesh, const Faces& faces, const Fields& fields, int level) {
  const std::size_t n = nodes_.size();
  for (std::size_t i = 0; i < n; ++i) {
    Node& node = nodes_[i];
    if (node.cell >= mesh.n_owned || node.level >= 0) continue;
    const auto& alpha = fields.phases[node.k].alpha;
    std::int32_t parent = -1;
    for_each_neighbour(mesh, faces, node.cell, [&](std::int32_t other) {
      if (level == 1) {
        if (!(alpha[other] > least_root(mesh.cell_type[node.cell]))) return;
      } else {
        const Node* const there = find(node.k, other);
        if (!there || there->level != level - 1 || !(alpha[other] >= std::fabs(alpha[node.cell]))) return;
      }
      if (parent < 0 || alpha[other] > alpha[parent] ||
          (alpha[other] == alpha[parent] && mesh.global_id[other] < mesh.global_id[parent]))
        parent = other;
    });
    if (parent < 0) continue;
    node.level = level, node.parent = parent, node.parent_id = mesh.global_id[parent];
  }
}

/// Adds what hangs on a node of an owned cell.
void RemoteVolumes::collect(const Mesh& mesh, const Faces& faces, const Fields& fields, Node& parent) {
  const Phase& phase = fields.phases[parent.k];
  const double V = fields.volume[parent.cell], alpha = phase.alpha[parent.cell];
  parent.volume = alpha * V;
  for (int c = 0; c < phase.n_conserved(); ++c)
    parent.content[c] = phase.conserved[c][parent.cell] * (c < fields.first_cobasis() ? V : alpha * V);
  for_each_neighbour(mesh, faces, parent.cell, [&](std::int32_t other) {
    const Node* const child = find(parent.k, other);
    if (!child || !child->active || child->level != parent.level + 1 || child->parent_id != mesh.global_id[parent.cell])
      return;
    parent.active = true;
    parent.volume += child->volume;
    for (int c = 0; c < phase.n_conserved(); ++c) parent.content[c] += child->content[c];
  });
}

std::int64_t RemoteVolumes::run(const Mesh& mesh, const Faces& faces, Fields& fields,
                                std::span<const std::pair<std::int32_t, int>> small) {
  nodes_.clear();
  for (const auto& [cell, k] : small) node_of(k, cell);
  const std::size_t n_small = nodes_.size();
  for (int level = 1; level <= deepest; ++level) {
    grow(mesh, faces, fields, level);
    exchange(
        mesh, [&](const Node& node) { return node.level == level; },
        [](Node& node, const auto& visit) { visit(node.level), visit(node.parent_id); });
  }
  std::int64_t alone = 0;
  for (std::size_t i = 0; i < n_small; ++i) {
    alone += nodes_[i].level < 0;
    nodes_[i].active = nodes_[i].level > 1;
  }
  const auto size = [&](int k) { return fields.phases[k].n_conserved(); };
  const auto sums = [&](Node& node, const auto& visit) {
    visit(node.active), visit(node.volume);
    for (int c = 0; c < size(node.k); ++c) visit(node.content[c]);
  };
  for (int level = deepest; level >= 1; --level) {
    for (std::size_t i = 0; i < n_small; ++i)
      if (nodes_[i].level == level) collect(mesh, faces, fields, nodes_[i]);
    exchange(
        mesh, [&](const Node& node) { return node.level == level && node.active; }, sums);
  }
  // roots of own trees, whose branches may be another rank's
  std::vector<std::pair<std::int32_t, int>> roots;
  for (const Node& node : nodes_) {
    if (node.level != 1 || !node.active) continue;
    if (node.cell < mesh.n_owned) {
      if (node.parent < mesh.n_owned) roots.emplace_back(node.parent, node.k);
      continue;
    }
    for (const Neighbour& neighbour : mesh.neighbours) {
      if (node.cell < neighbour.receive_first || node.cell >= neighbour.receive_first + neighbour.receive_count)
        continue;
      const auto parent = std::ranges::lower_bound(neighbour.send, node.parent_id, {},
                                                   [&](std::int32_t cell) { return mesh.global_id[cell]; });
      if (parent != neighbour.send.end() && mesh.global_id[*parent] == node.parent_id)
        roots.emplace_back(*parent, node.k);
    }
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  for (const auto& [cell, k] : roots) {
    Node& root = node_of(k, cell);
    root.level = 0;
    collect(mesh, faces, fields, root);
    root.has_mean = root.volume > least_of_root * fields.phases[k].alpha[cell] * fields.volume[cell];
    for (int c = 0; c < size(k); ++c) root.content[c] /= root.volume;
  }
  const auto means = [&](Node& node, const auto& visit) {
    visit(node.level), visit(node.has_mean);
    for (int c = 0; c < size(node.k); ++c) visit(node.content[c]);
  };
  for (int level = 0; level <= deepest; ++level) {
    const std::size_t n = nodes_.size();
    for (std::size_t i = 0; i < n; ++i) {
      Node& node = nodes_[i];
      if (node.level != level || !node.active || node.cell >= mesh.n_owned) continue;
      if (level > 0) {
        const Node* const parent = find(node.k, node.parent);
        node.has_mean = parent && parent->has_mean;
        if (node.has_mean) node.content = parent->content;
      }
      if (!node.has_mean) continue;
      Phase& phase = fields.phases[node.k];
      const double alpha = phase.alpha[node.cell];
      for (int c = 0; c < phase.n_conserved(); ++c)
        phase.conserved[c][node.cell] = node.content[c] * (c < fields.first_cobasis() ? alpha : 1);
    }
    if (level < deepest)
      exchange(
          mesh, [&](const Node& node) { return node.level == level && node.active; }, means);
  }
  for (const Node& node : nodes_) at_[node.k][node.cell] = -1;
  return alone;
}

}  // namespace cobasis
