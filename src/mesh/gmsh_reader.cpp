#include "mesh/gmsh_reader.hpp"

#include <fmt/format.h>
#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>

#include "math/errors.hpp"
#include "mesh/bytes.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/child_process.hpp"
#include "mesh/geo_script.hpp"
#include "mesh/msh_check.hpp"

namespace cobasis {
namespace {

namespace mesh_api = gmsh::model::mesh;
using Tags = std::vector<std::size_t>;

/// Physical groups of one dimension by name; two numbers of the same name are one group.
struct Groups {
  std::vector<std::string> names;
  std::map<int, std::int32_t> index;  ///< by Gmsh's number
};

Groups groups_of(int dimension) {
  Groups groups;
  gmsh::vectorpair pairs;
  gmsh::model::getPhysicalGroups(pairs, dimension);
  for (const auto& [dim, tag] : pairs) {
    std::string name;
    gmsh::model::getPhysicalName(dim, tag, name);
    if (name.empty()) name = std::to_string(tag);
    const auto at = std::find(groups.names.begin(), groups.names.end(), name);
    groups.index[tag] = static_cast<std::int32_t>(at - groups.names.begin());
    if (at == groups.names.end()) groups.names.push_back(name);
  }
  return groups;
}

/// The group of an entity, -1: none. Throws if there are two.
std::int32_t group_of(const Groups& groups, int dimension, int entity) {
  std::vector<int> tags;
  gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
  std::int32_t group = -1;
  for (const int tag : tags) {
    const std::int32_t other = groups.index.at(std::abs(tag));
    if (group >= 0 && other != group)
      throw InputError(fmt::format("elements of entity {} (dimension {}) are in two physical groups, '{}' and '{}'",
                                   entity, dimension, groups.names[group], groups.names[other]));
    group = other;
  }
  return group;
}

struct ElementKind {
  int n_nodes = 0, n_corners = 0, order = 1;
};

ElementKind kind_of(int type) {
  std::string name;
  int dimension = 0, order = 0, n_nodes = 0, n_corners = 0;
  std::vector<double> coordinates;
  mesh_api::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_corners);
  const bool line = dimension == 1 && n_corners == 2;
  const auto matches = [&](const CellShape& s) { return s.dimension == dimension && s.n_corners == n_corners; };
  if (!line && std::none_of(cell_shapes.begin(), cell_shapes.end(), matches))
    throw InputError(
        fmt::format("unknown kind of element '{}'; read are triangles, quadrilaterals, tetrahedra, "
                    "hexahedra, prisms, pyramids",
                    name));
  return {n_nodes, n_corners, order};
}

CellType cell_type_of(int dimension, int n_corners) {
  const auto at = std::find_if(cell_shapes.begin(), cell_shapes.end(), [&](const CellShape& s) {
    return s.dimension == dimension && s.n_corners == n_corners;
  });
  return static_cast<CellType>(at - cell_shapes.begin());
}

/// Calls visit(group, tag, corner tags) for the elements of a dimension, entity by entity; returns the highest order.
template <class Visit>
int for_each_element(int dimension, const Groups& groups, bool grouped_only, Visit visit) {
  int highest = 1;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (const auto& [dim, entity] : entities) {
    const std::int32_t group = group_of(groups, dim, entity);
    if (grouped_only && group < 0) continue;
    std::vector<int> types;
    std::vector<Tags> tags, nodes;
    mesh_api::getElements(types, tags, nodes, dim, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const ElementKind kind = kind_of(types[t]);
      highest = std::max(highest, kind.order);
      if (nodes[t].size() != tags[t].size() * kind.n_nodes) throw InputError("elements without all of their nodes");
      for (std::size_t e = 0; e < tags[t].size(); ++e)
        visit(group, tags[t][e], std::span(nodes[t]).subspan(e * kind.n_nodes, kind.n_corners));
    }
  }
  return highest;
}

/// Nodes by Gmsh's number, numbered anew in the order in which cells use them.
class NodeTable {
 public:
  NodeTable() {
    std::vector<double> parametric;
    mesh_api::getNodes(tags_, coordinates_, parametric, -1, -1, false, false);
    index_.reserve(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) index_.emplace(tags_[i], i);
    number_.assign(tags_.size(), -1);
  }

  std::int32_t use(std::size_t tag, std::vector<Point>& nodes) {
    const auto at = index_.find(tag);
    if (at == index_.end()) throw InputError(fmt::format("there is no node {}, which an element uses", tag));
    std::int32_t& number = number_[at->second];
    if (number < 0) {
      const double* const x = &coordinates_[3 * at->second];
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        throw InputError(fmt::format("node {} lies at ({}, {}, {})", tag, x[0], x[1], x[2]));
      number = static_cast<std::int32_t>(nodes.size());
      nodes.push_back({x[0], x[1], x[2]});
    }
    return number;
  }

  /// -1 if no cell uses the node.
  std::int32_t find(std::size_t tag) const {
    const auto at = index_.find(tag);
    return at == index_.end() ? -1 : number_[at->second];
  }

 private:
  Tags tags_;
  std::vector<double> coordinates_;
  std::unordered_map<std::size_t, std::size_t> index_;
  std::vector<std::int32_t> number_;
};

/// `drop_ungrouped`: as Gmsh does when it saves, cells outside all physical groups of their dimension are left out.
RawMesh extract(int dimension, bool drop_ungrouped) {
  RawMesh raw;
  raw.dimension = dimension;
  const Groups regions = groups_of(dimension), boundaries = groups_of(dimension - 1);
  raw.region_names = regions.names;
  raw.group_names = boundaries.names;

  NodeTable table;
  const bool some_only = drop_ungrouped && !regions.names.empty();
  const int order =
      for_each_element(dimension, regions, some_only, [&](std::int32_t group, std::size_t tag, auto nodes) {
        for (const std::size_t node : nodes) raw.cell_nodes.push_back(table.use(node, raw.nodes));
        if (raw.cell_nodes.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
          throw InputError("more cells than 32-bit numbers can count");
        raw.cell_node_begin.push_back(static_cast<std::int32_t>(raw.cell_nodes.size()));
        raw.cell_type.push_back(cell_type_of(dimension, static_cast<int>(nodes.size())));
        raw.cell_tag.push_back(static_cast<std::int64_t>(tag));
        raw.cell_region.push_back(group);
      });
  if (raw.n_cells() == 0) throw InputError(fmt::format("no cells of dimension {} in it", dimension));
  if (order > 1) raw.notices.push_back(fmt::format("elements of order {} are read by their corners", order));

  std::int64_t outside = 0;
  for_each_element(dimension - 1, boundaries, true, [&](std::int32_t group, std::size_t tag, auto nodes) {
    std::array<std::int32_t, 4> side{-1, -1, -1, -1};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      side[i] = table.find(nodes[i]);
      if (side[i] < 0) {
        ++outside;
        return;
      }
    }
    raw.side_nodes.push_back(side);
    raw.side_tag.push_back(static_cast<std::int64_t>(tag));
    raw.side_group.push_back(group);
  });
  if (outside > 0) raw.notices.push_back(fmt::format("{} boundary elements touch no cell and are ignored", outside));
  return raw;
}

int dimension_of_elements() {
  std::vector<int> types;
  mesh_api::getElementTypes(types, 3);
  return types.empty() ? 2 : 3;
}

std::string logged_errors() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::string errors;
  for (const std::string& entry : log)
    if (entry.starts_with("Error: ")) errors += (errors.empty() ? "" : "; ") + entry.substr(7);
  return errors;
}

void split(int times) {
  for (int i = 0; i < times; ++i) mesh_api::refine();
}

/// Memory that the system can give [bytes]; 0 if it does not say.
std::size_t free_memory() {
  std::ifstream info("/proc/meminfo");
  for (std::string line; std::getline(info, line);) {
    std::size_t kilobytes = 0;
    if (std::sscanf(line.c_str(), "MemAvailable: %zu kB", &kilobytes) == 1) return kilobytes << 10;
  }
  return 0;
}

/// A file in memory that holds the text, as long as the process lives. Gmsh sees what we have checked, whatever happens
/// to the file on disk meanwhile, and no FILE.opt beside it, which it would run as a script.
std::string file_in_memory(const std::string& text) {
  const int file = memfd_create("mesh", MFD_CLOEXEC);
  std::FILE* const stream = file < 0 ? nullptr : fdopen(file, "w");
  if (!stream || std::fwrite(text.data(), 1, text.size(), stream) != text.size() || std::fflush(stream) != 0)
    throw InputError(fmt::format("no room for a copy of it in memory: {}", std::strerror(errno)));
  return fmt::format("/proc/self/fd/{}", file);
}

/// Gmsh's words, of a copy in memory with the name of the file.
std::string with_name(std::string text, const std::string& copy, const std::string& name) {
  for (std::size_t at = 0; (at = text.find(copy, at)) != std::string::npos; at += name.size())
    text.replace(at, copy.size(), name);
  return text;
}

/// In the child: Gmsh opens the file, meshes it if it is a script, and hands over what the solver needs.
RawMesh work_in_gmsh(const MeshRequest& request, bool script, const std::string& file) {
  std::vector<std::string> arguments{"cobasis"};
  for (const auto& [name, value] : request.parameters)
    arguments.insert(arguments.end(), {"-setnumber", name, fmt::format("{}", value)});
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  try {
    gmsh::initialize(static_cast<int>(argv.size()), argv.data(), false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
    gmsh::open(file);
    if (!script) {
      split(request.splits);
      return extract(request.dimension > 0 ? request.dimension : dimension_of_elements(), false);
    }

    const int dimension = request.dimension > 0 ? request.dimension : std::max(2, gmsh::model::getDimension());
    mesh_api::generate(dimension);
    split(request.splits);
    if (const std::string errors = logged_errors(); !errors.empty()) throw InputError(errors);
    double save_all = 0;
    gmsh::option::getNumber("Mesh.SaveAll", save_all);
    return extract(dimension, save_all == 0);
  } catch (const std::string& text) {
    const std::string errors = logged_errors();
    throw InputError(errors.empty() ? text : errors);
  }
}

}  // namespace

RawMesh read_gmsh(const MeshRequest& request) {
  const bool script = request.file.ends_with(".geo");
  if (!script && !request.file.ends_with(".msh"))
    throw InputError(fmt::format("{}: a mesh file is a .msh or a .geo", request.file));
  if (request.dimension != 0 && request.dimension != 2 && request.dimension != 3)
    throw InputError(fmt::format("{}: dimension {}, allowed are 2 and 3", request.file, request.dimension));

  const bool trusted = script && request.trust_geo;
  std::string text = read_whole_file(request.file);
  ChildLimits limits;
  limits.no_side_effects = !trusted;  // should the check of a script have missed a command
  if (script) {
    check_parameters(request.file, read_geo_script(request.file, text, trusted), request.parameters);
    limits.extra_memory = free_memory();  // a script may ask for any number of cells
  } else {
    if (!request.parameters.empty())
      throw InputError(
          fmt::format("{}: mesh parameters ('{}') need a .geo", request.file, request.parameters.begin()->first));
    text = check_msh(request.file, text);
    // Gmsh needs up to ten times the file (measured), we as much again; a damaged count asks for far more.
    limits.extra_memory = (std::size_t{2} << 30) + (std::size_t{60} << (3 * request.splits)) * text.size();
  }
  const ChildResult result = run_in_child(
      [&] {
        const std::string file = trusted ? request.file : file_in_memory(text);
        try {
          ByteWriter writer;
          const RawMesh raw = work_in_gmsh(request, script, file);
          for_each_member(raw, writer);
          return writer.bytes;
        } catch (const InputError& error) {
          throw InputError(with_name(error.what(), file, request.file));
        }
      },
      limits);
  if (!result.error.empty())
    throw InputError(fmt::format("{}: Gmsh could not {} it: {}", request.file, script ? "mesh" : "read", result.error));
  RawMesh raw;
  ByteReader reader(result.bytes);
  for_each_member(raw, reader);
  std::error_code none;
  if (script && !trusted && std::filesystem::exists(request.file + ".opt", none))
    raw.notices.push_back(
        fmt::format("{}.opt is not read: it is a script, too; --trust-geo lets Gmsh read it", request.file));
  return raw;
}

}  // namespace cobasis
