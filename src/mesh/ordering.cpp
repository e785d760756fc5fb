#include "mesh/ordering.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cobasis {
namespace {

/// Spreads the low bits of x: one bit of the result in `dimension`.
std::uint64_t spread(std::uint64_t x, int dimension) {
  if (dimension == 2) {
    x = (x | x << 16) & 0x0000ffff0000ffff;
    x = (x | x << 8) & 0x00ff00ff00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
    x = (x | x << 2) & 0x3333333333333333;
    return (x | x << 1) & 0x5555555555555555;
  }
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::vector<std::int32_t> morton_order(const std::vector<Point>& points, int dimension) {
  Point low = points.front(), high = points.front();
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double steps = std::ldexp(1.0, dimension == 2 ? 31 : 21) - 1;
  const double scale = extent > 0 ? steps / extent : 0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = scale * (points[i] - low);
    const auto bits = [&](double x) { return spread(static_cast<std::uint64_t>(x), dimension); };
    const std::uint64_t key = bits(p.x) | bits(p.y) << 1 | (dimension == 3 ? bits(p.z) << 2 : 0);
    keys[i] = {key, static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = keys[i].second;
  return order;
}

RawMesh renumber(const RawMesh& raw, const std::vector<std::int32_t>& order) {
  RawMesh sorted;
  sorted.dimension = raw.dimension;
  sorted.region_names = raw.region_names;
  sorted.group_names = raw.group_names;
  sorted.notices = raw.notices;
  sorted.side_tag = raw.side_tag;
  sorted.side_group = raw.side_group;
  sorted.nodes.reserve(raw.nodes.size());
  sorted.cell_nodes.reserve(raw.cell_nodes.size());
  std::vector<std::int32_t> number(raw.nodes.size(), -1);
  for (const std::int32_t cell : order) {
    for (std::int32_t i = raw.cell_node_begin[cell]; i < raw.cell_node_begin[cell + 1]; ++i) {
      const std::int32_t node = raw.cell_nodes[i];
      if (number[node] < 0) {
        number[node] = static_cast<std::int32_t>(sorted.nodes.size());
        sorted.nodes.push_back(raw.nodes[node]);
      }
      sorted.cell_nodes.push_back(number[node]);
    }
    sorted.cell_node_begin.push_back(static_cast<std::int32_t>(sorted.cell_nodes.size()));
    sorted.cell_type.push_back(raw.cell_type[cell]);
    sorted.cell_tag.push_back(raw.cell_tag[cell]);
    sorted.cell_region.push_back(raw.cell_region[cell]);
  }
  for (std::array<std::int32_t, 4> side : raw.side_nodes) {
    for (std::int32_t& node : side) node = node < 0 ? -1 : number[node];
    sorted.side_nodes.push_back(side);
  }
  return sorted;
}

}  // namespace cobasis
