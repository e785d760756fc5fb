#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <random>

#include "math/errors.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "mesh/read_mesh.hpp"

using namespace cobasis;

namespace {

const Mpi& mpi() {
  static int argc = 0;
  static char** argv = nullptr;
  static const Mpi ranks(argc, argv);
  return ranks;
}

/// A file that rank 0 writes and removes; only rank 0 reads meshes.
class GeoFile {
 public:
  explicit GeoFile(const std::string& text) {
    if (!mpi().root()) return;
    std::string name = (std::filesystem::temp_directory_path() / "cobasis_parallel_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(path()) << text;
  }
  ~GeoFile() {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  GeoFile(const GeoFile&) = delete;
  GeoFile& operator=(const GeoFile&) = delete;
  std::string path() const { return folder_ + "/a.geo"; }

 private:
  std::string folder_;
};

std::string rectangle(int nx, int ny, bool triangles) {
  return fmt::format(R"(Point(1) = {{0, 0, 0}}; Point(2) = {{1, 0, 0}}; Point(3) = {{1, 1, 0}}; Point(4) = {{0, 1, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = {}; Transfinite Curve {{2, 4}} = {}; Transfinite Surface {{1}}; {}
Physical Curve("bottom") = {{1}}; Physical Curve("right") = {{2}};
Physical Curve("top") = {{3}}; Physical Curve("left") = {{4}};
)",
                     nx + 1, ny + 1, triangles ? "" : "Recombine Surface {1};");
}

const std::string box = R"(SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1}; Mesh.MeshSizeMax = 0.25;
Periodic Surface {2} = {1} Translate {1, 0, 0};
Physical Surface("x0") = {1}; Physical Surface("x1") = {2}; Physical Surface("wall") = {3, 4, 5, 6};
)";

struct Division {
  const char* name;
  std::function<int(std::int64_t, int)> owner;
};

const std::vector<Division> divisions = {
    {"all on the last rank", [](std::int64_t, int n) { return n - 1; }},
    {"METIS", {}},
    {"random", [](std::int64_t cell, int n) { return static_cast<int>(std::mt19937(cell)() % n); }},
    {"stripes", [](std::int64_t cell, int n) { return static_cast<int>(cell % n); }},
};

/// Everything about cells and faces that must not depend on the ranks, by global numbers, on rank 0.
std::vector<double> fingerprint(const Mesh& mesh) {
  const auto id = [&](std::int32_t cell) { return static_cast<double>(mesh.global_id[cell]); };
  std::vector<std::vector<double>> rows;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
    const Point& c = mesh.centroid[i];
    std::vector<double> row{id(i), mesh.volume[i], c.x, c.y, c.z, static_cast<double>(mesh.cell_type[i])};
    for (int j = 0; j < mesh.max_cell_faces; ++j) {
      const std::int32_t entry = mesh.cell_faces[j * mesh.cell_stride + i];
      if (entry < 0) break;
      const std::int32_t f = entry / 2;
      const Point &p = mesh.face_centroid[f], &d = mesh.face_delta[f];
      const double right = f < mesh.first_boundary_face() ? id(mesh.right[f]) : -1;
      row.insert(row.end(), {entry % 2 + 0.0, id(mesh.left[f]), right, mesh.area[f], mesh.nx[f], mesh.ny[f], mesh.nz[f],
                             mesh.tx[f], mesh.ty[f], mesh.tz[f], p.x, p.y, p.z, d.x, d.y, d.z});
      for (std::size_t g = 0; g < mesh.boundary_groups.size(); ++g)
        if (f >= mesh.boundary_groups[g].first && f < mesh.boundary_groups[g].last)
          row.push_back(static_cast<double>(g));
    }
    rows.push_back(std::move(row));
  }
  std::vector<double> flat;
  for (const std::vector<double>& row : rows) {
    flat.push_back(static_cast<double>(row.size()));
    flat.insert(flat.end(), row.begin(), row.end());
  }
  const std::vector<double> all = mpi().gather(flat);
  std::map<double, std::vector<double>> by_id;
  for (std::size_t at = 0; at < all.size();) {
    const auto size = static_cast<std::size_t>(all[at]);
    CHECK(by_id.emplace(all[at + 1], std::vector<double>(&all[at + 1], &all[at + 1] + size)).second);
    at += size + 1;
  }
  std::vector<double> sorted;
  for (const auto& [cell, row] : by_id) sorted.insert(sorted.end(), row.begin(), row.end());
  if (mpi().root()) CHECK(std::ssize(by_id) == mesh.n_global);
  return sorted;
}

Mesh divided(const std::string& file, const Division& division,
             std::vector<std::pair<std::string, std::string>> periodic = {}) {
  MeshRequest request;
  request.file = file;
  request.periodic = std::move(periodic);
  request.partition = division.owner;
  return read_mesh(request, mpi());
}

/// Halo cells carry the global ids that their owners send.
void check_exchange(const Mesh& mesh) {
  std::vector<std::size_t> most;
  for (const Neighbour& neighbour : mesh.neighbours) most.push_back(neighbour.receive_count + 5);
  NeighbourExchange exchange(mpi(), mesh.neighbours, most, 7);
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
      exchange.outgoing(n).clear();
      for (const std::int32_t cell : mesh.neighbours[n].send) {
        CHECK(cell < mesh.n_owned);
        exchange.outgoing(n).push_back(static_cast<double>(mesh.global_id[cell]));
      }
    }
    exchange.start();
    exchange.finish();
    std::int32_t received = 0;
    for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
      const Neighbour& neighbour = mesh.neighbours[n];
      CHECK(neighbour.receive_first == mesh.n_owned + received);
      const std::span<const double> ids = exchange.incoming(n);
      REQUIRE(std::ssize(ids) == neighbour.receive_count);
      for (std::size_t i = 0; i < ids.size(); ++i)
        CHECK(ids[i] == static_cast<double>(mesh.global_id[neighbour.receive_first + i]));
      received += neighbour.receive_count;
    }
    CHECK(received == mesh.n_halo);
  }
}

/// Interior faces join owned cells, halo faces an owned and a halo cell, and every halo cell is needed.
void check_classes(const Mesh& mesh) {
  std::vector<char> needed(mesh.n_halo, 0);
  for (std::int32_t f = 0; f < mesh.first_boundary_face(); ++f) {
    const std::int32_t inner = std::min(mesh.left[f], mesh.right[f]), outer = std::max(mesh.left[f], mesh.right[f]);
    CHECK(inner < mesh.n_owned);
    CHECK((outer >= mesh.n_owned) == (f >= mesh.n_interior_faces));
    if (outer >= mesh.n_owned) needed[outer - mesh.n_owned] = 1;
  }
  CHECK(std::count(needed.begin(), needed.end(), 0) == 0);
  CHECK(std::is_sorted(mesh.global_id.begin(), mesh.global_id.begin() + mesh.n_owned));
}

void check_divisions(const std::string& file, const std::vector<std::pair<std::string, std::string>>& periodic) {
  std::vector<double> reference;
  for (const Division& division : divisions) {
    INFO(division.name);
    const Mesh mesh = divided(file, division, periodic);
    check_classes(mesh);
    check_exchange(mesh);
    const std::vector<double> all = fingerprint(mesh);
    if (reference.empty()) reference = all;
    CHECK(all == reference);
    if (mpi().root()) CHECK(reference.size() > 100);
  }
}

}  // namespace

TEST_CASE("the ranks' parts are the mesh, with the same bits for any division") {
  SECTION("triangles") { check_divisions(GeoFile(rectangle(9, 7, true)).path(), {}); }
  SECTION("squares, periodic both ways") {
    check_divisions(GeoFile(rectangle(8, 5, false)).path(), {{"left", "right"}, {"top", "bottom"}});
  }
  SECTION("a strip one cell high, its own neighbour") {
    check_divisions(GeoFile(rectangle(9, 1, false)).path(), {{"bottom", "top"}});
  }
  SECTION("a ring of two cells") { check_divisions(GeoFile(rectangle(2, 3, false)).path(), {{"right", "left"}}); }
  SECTION("tetrahedra") { check_divisions(GeoFile(box).path(), {}); }
  SECTION("tetrahedra, periodic") { check_divisions(GeoFile(box).path(), {{"x0", "x1"}}); }
}

TEST_CASE("METIS shares the cells out evenly and by weight") {
  const GeoFile file(rectangle(30, 30, false));
  MeshRequest request;
  request.file = file.path();
  Mesh mesh = read_mesh(request, mpi());
  CHECK(mesh.n_owned > 900 / mpi().size() * 0.9);
  CHECK(mesh.n_owned < 900 / mpi().size() * 1.1);
  request.cell_weight = [](const Point& x, const std::string&) { return x.x < 0.5 ? 9 : 1; };
  mesh = read_mesh(request, mpi());
  double load = 0;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) load += request.cell_weight(mesh.centroid[i], "");
  CHECK(load > 4500 / mpi().size() * 0.9);
  CHECK(load < 4500 / mpi().size() * 1.1);
}

TEST_CASE("more ranks than cells leave ranks empty") {
  const GeoFile file(rectangle(1, 1, false));
  const Mesh mesh = divided(file.path(), {});
  CHECK(mpi().sum(mesh.n_owned) == 1);
  CHECK(mesh.n_halo == 0);
  CHECK(mesh.boundary_groups.size() == 4);
  CHECK(mesh.dimension == 2);
  check_exchange(mesh);
}

TEST_CASE("an input error is raised on all ranks alike") {
  const GeoFile file("Point(1) = {0, 0, 0}; Physical Point(\"p\") = {1};");
  const auto text = [&]() -> std::string {
    try {
      divided(file.path(), {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }();
  CHECK_THAT(text, Catch::Contains("a.geo"));
  std::string first = text;
  mpi().broadcast(first);
  CHECK(first == text);
}
