#include "mesh/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <tuple>

#include "math/errors.hpp"
#include "mesh/cell_shape.hpp"

namespace cobasis {
namespace {

/// One side of a face: its nodes but the lowest, ascending, and the cell (>= 0) or boundary element (-1 - index).
struct HalfFace {
  std::array<std::int32_t, 3> key;
  std::int32_t owner;
  std::int8_t local;
};

/// Sorted nodes of a face; those it lacks are -1, at the end.
std::array<std::int32_t, 4> sorted_nodes(std::array<std::int32_t, 4> nodes) {
  std::sort(nodes.begin(), nodes.end(), [](std::int32_t a, std::int32_t b) {
    return static_cast<std::uint32_t>(a) < static_cast<std::uint32_t>(b);  // -1 last
  });
  return nodes;
}

template <class Visit>  // visit(sorted nodes, owner, local)
void for_each_half_face(const RawMesh& raw, Visit visit) {
  for (std::int32_t cell = 0; cell < raw.n_cells(); ++cell) {
    for (int local = 0; local < shape_of(raw.cell_type[cell]).n_faces; ++local) {
      std::array<std::int32_t, 4> nodes{-1, -1, -1, -1};
      face_nodes(raw, cell, local, nodes.data());
      visit(sorted_nodes(nodes), cell, local);
    }
  }
  for (std::size_t side = 0; side < raw.side_nodes.size(); ++side)
    visit(sorted_nodes(raw.side_nodes[side]), -1 - static_cast<std::int32_t>(side), 0);
}

/// All half faces, those of one lowest node together: a counting sort, then small sorts. `begin`: CSR by lowest node.
std::vector<HalfFace> sorted_half_faces(const RawMesh& raw, std::vector<std::int64_t>& begin) {
  begin.assign(raw.nodes.size() + 1, 0);
  for_each_half_face(raw, [&](const auto& nodes, std::int32_t, int) { ++begin[nodes[0] + 1]; });
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<HalfFace> halves(begin.back());
  std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
  for_each_half_face(raw, [&](const auto& nodes, std::int32_t owner, int local) {
    halves[next[nodes[0]]++] = {{nodes[1], nodes[2], nodes[3]}, owner, static_cast<std::int8_t>(local)};
  });
  for (std::size_t node = 0; node + 1 < begin.size(); ++node)
    std::sort(halves.begin() + begin[node], halves.begin() + begin[node + 1],
              [](const HalfFace& a, const HalfFace& b) { return std::tie(a.key, a.owner) < std::tie(b.key, b.owner); });
  return halves;
}

std::vector<std::int32_t> sorted_cell_nodes(const RawMesh& raw, std::int32_t cell) {
  std::vector<std::int32_t> nodes(raw.cell_nodes.begin() + raw.cell_node_begin[cell],
                                  raw.cell_nodes.begin() + raw.cell_node_begin[cell + 1]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::string at_node(const RawMesh& raw, std::int32_t node) {
  const Point& p = raw.nodes[node];
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

[[noreturn]] void refuse_overlap(const RawMesh& raw, std::int32_t a, std::int32_t b) {
  const std::string where = at_node(raw, raw.cell_nodes[raw.cell_node_begin[a]]);
  if (sorted_cell_nodes(raw, a) == sorted_cell_nodes(raw, b))
    throw InputError(fmt::format("elements {} and {} at {} are the same", raw.cell_tag[a], raw.cell_tag[b], where));
  throw InputError(fmt::format("elements {} and {} overlap: both lie on the same side of a face, at {}",
                               raw.cell_tag[a], raw.cell_tag[b], where));
}

[[noreturn]] void refuse_crowd(const RawMesh& raw, std::span<const HalfFace> cells) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sorted_cell_nodes(raw, cells[i].owner) == sorted_cell_nodes(raw, cells[j].owner))
        refuse_overlap(raw, cells[j].owner, cells[i].owner);
  throw InputError(fmt::format("a face is shared by {} cells, among them elements {}, {} and {}, at {}", cells.size(),
                               raw.cell_tag[cells[0].owner], raw.cell_tag[cells[1].owner], raw.cell_tag[cells[2].owner],
                               at_node(raw, raw.cell_nodes[raw.cell_node_begin[cells[0].owner]])));
}

/// Two cells of a face must run round it in opposite senses.
void check_opposite(const RawMesh& raw, const HalfFace& a, const HalfFace& b) {
  std::array<std::int32_t, 4> first{}, second{};
  const int n = face_nodes(raw, a.owner, a.local, first.data());
  face_nodes(raw, b.owner, b.local, second.data());
  const auto at = std::find(second.begin(), second.begin() + n, first[0]) - second.begin();
  if (n == 2 ? at == 1 : second[(at + n - 1) % n] == first[1] && second[(at + 1) % n] == first[n - 1]) return;
  refuse_overlap(raw, a.owner, b.owner);
}

/// The group of the boundary elements on one face, -1: none.
std::int32_t group_on_face(const RawMesh& raw, std::span<const HalfFace> sides) {
  if (sides.empty()) return -1;
  const std::int32_t side = -1 - sides[0].owner;
  if (sides.size() > 1) {
    const std::int32_t other = -1 - sides[1].owner;
    const auto& names = raw.group_names;
    throw InputError(fmt::format("boundary elements {} and {} at {} are the same, in physical groups '{}' and '{}'",
                                 raw.side_tag[other], raw.side_tag[side], at_node(raw, raw.side_nodes[side][0]),
                                 names[raw.side_group[other]], names[raw.side_group[side]]));
  }
  return raw.side_group[side];
}

}  // namespace

int face_nodes(const RawMesh& raw, std::int32_t cell, int local, std::int32_t* corners) {
  const FaceCorners& face = shape_of(raw.cell_type[cell]).faces[local];
  const std::int32_t* const nodes = &raw.cell_nodes[raw.cell_node_begin[cell]];
  for (int i = 0; i < face.size; ++i) corners[i] = nodes[face.corner[i]];
  return face.size;
}

std::vector<FaceLink> connect(RawMesh& raw) {
  std::vector<std::int64_t> begin;
  const std::vector<HalfFace> halves = sorted_half_faces(raw, begin);
  std::vector<FaceLink> inner, boundary;
  std::map<std::int32_t, std::int64_t> inside, stray;  // boundary elements by group
  for (std::size_t node = 0; node + 1 < begin.size(); ++node) {
    for (std::int64_t first = begin[node], last; first < begin[node + 1]; first = last) {
      for (last = first; last < begin[node + 1] && halves[last].key == halves[first].key; ++last) {
      }
      const std::span<const HalfFace> all(&halves[first], last - first);
      const auto n_sides = static_cast<std::size_t>(
          std::count_if(all.begin(), all.end(), [](const HalfFace& h) { return h.owner < 0; }));
      const std::span<const HalfFace> cells = all.subspan(n_sides);
      if (cells.size() > 2) refuse_crowd(raw, cells);
      const std::int32_t group = group_on_face(raw, all.first(n_sides));
      if (cells.size() == 2) {
        check_opposite(raw, cells[0], cells[1]);
        inner.push_back({cells[0].owner, cells[1].owner, cells[0].local, cells[1].local});
        if (group >= 0) ++inside[group];
      } else if (cells.size() == 1) {
        boundary.push_back({cells[0].owner, -1, cells[0].local, 0, group});
      } else {
        ++stray[group];
      }
    }
  }
  for (const auto& [group, count] : inside)
    raw.notices.push_back(fmt::format("{} elements of physical group '{}' lie between two cells and are ignored", count,
                                      raw.group_names[group]));
  for (const auto& [group, count] : stray)
    raw.notices.push_back(fmt::format("{} elements of physical group '{}' are not the side of any cell and are ignored",
                                      count, raw.group_names[group]));
  inner.insert(inner.end(), boundary.begin(), boundary.end());
  return inner;
}

}  // namespace cobasis
