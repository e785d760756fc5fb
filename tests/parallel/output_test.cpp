#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <set>

#include "../unit/app/output_scene.hpp"
#include "app/atomic_file.hpp"
#include "app/output.hpp"
#include "math/errors.hpp"
#include "mesh/read_mesh.hpp"

namespace cobasis::test {
namespace {

using Partition = std::function<int(std::int64_t, int)>;

/// A directory that all ranks use; rank 0's, gone at the end.
struct SharedScratch {
  std::filesystem::path path;
  SharedScratch() {
    std::string name = (std::filesystem::temp_directory_path() / "cobasis_parallel_XXXXXX").string();
    if (world().root()) name = ::mkdtemp(name.data());
    world().broadcast(name);
    path = name;
  }
  ~SharedScratch() {
    world().barrier();
    if (world().root()) std::filesystem::remove_all(path);
  }
};

/// 9 x 7 squares of side 1/8 as MSH 2.2.
std::string squares_msh() {
  constexpr int nx = 9;
  constexpr int ny = 7;
  std::ostringstream nodes, elements;
  const auto node = [](int i, int j) { return 1 + i + (nx + 1) * j; };
  int n_elements = 0;
  const auto line = [&](int a, int b) { elements << ++n_elements << " 1 2 1 1 " << a << ' ' << b << '\n'; };
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) nodes << node(i, j) << ' ' << 0.125 * i << ' ' << 0.125 * j << " 0\n";
  }
  for (int i = 0; i < nx; ++i) {
    line(node(i, 0), node(i + 1, 0));
    line(node(i, ny), node(i + 1, ny));
  }
  for (int j = 0; j < ny; ++j) {
    line(node(0, j), node(0, j + 1));
    line(node(nx, j), node(nx, j + 1));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      elements << ++n_elements << " 3 2 2 1 " << node(i, j) << ' ' << node(i + 1, j) << ' ' << node(i + 1, j + 1) << ' '
               << node(i, j + 1) << '\n';
    }
  }
  std::ostringstream text;
  text
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"outside\"\n2 2 \"inside\"\n$EndPhysicalNames\n"
      << "$Nodes\n"
      << (nx + 1) * (ny + 1) << '\n'
      << nodes.str() << "$EndNodes\n"
      << "$Elements\n"
      << n_elements << '\n'
      << elements.str() << "$EndElements\n";
  return text.str();
}

Mesh mesh_of(const std::filesystem::path& directory, const Partition& partition) {
  const std::string file = (directory / "squares.msh").string();
  if (world().root()) {
    std::filesystem::create_directories(directory);
    write_atomically(file, squares_msh());
  }
  world().barrier();
  MeshRequest request;
  request.file = file;
  request.partition = partition;
  return read_mesh(request, world());
}

/// Copper below a wavy surface, gas above; every value a function of the place.
Snapshot wavy(const Mesh& mesh) {
  std::vector<double> copper, gas, nothing(static_cast<std::size_t>(mesh.n_owned));
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
    const Point& x = mesh.centroid[i];
    copper.push_back(std::clamp(3 * (0.4 + 0.2 * std::sin(5 * x.x) - x.y) + 0.5, 0.0, 1.0));
    gas.push_back(1 - copper.back());
  }
  Snapshot snapshot;
  snapshot.phases = {phase_state("copper", copper, 0, true), phase_state("gas", gas, 0, false), {}};
  snapshot.phases[2].name = "outside";
  snapshot.phases[2].is_void = true;
  snapshot.phases[2].alpha = nothing;
  for (int k = 0; k < 2; ++k) {
    for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
      snapshot.phases[k].density[i] = std::exp(mesh.centroid[i].x) + k;
      for (auto& u : snapshot.phases[k].velocity) u[i] = std::cos(mesh.centroid[i].y) - k;
      for (auto& s : snapshot.phases[k].stress) s[i] = mesh.centroid[i].x * mesh.centroid[i].y;
      snapshot.phases[k].pressure[i] = 1 / 3.0;
    }
  }
  return snapshot;
}

Setup wavy_setup(const std::filesystem::path& directory) {
  Setup setup = three_phases(directory);
  setup.output.fields = {"alpha", "density", "velocity", "pressure", "stress"};
  setup.lines = {{"across", {0, 0.5, 0}, {1.125, 0.5, 0}, 55}, {"diagonal", {0.01, 0.02, 0}, {1.1, 0.85, 0}, 40}};
  setup.probes = {{"gauge", {0.5, 0.5, 0}}};
  setup.integrals = {{"top", Extent{0, 0.5, Axis::y}},
                     {"low", Extent{0, 0.9, Axis::y}},
                     {"high", Extent{0, 0.1, Axis::y}},
                     {"median", Quantile{0, 0.5, Axis::y}},
                     {"r95", Quantile{0, 0.95, Axis::radial}}};
  return setup;
}

struct Results {
  std::string across, diagonal, gauge, history;
  std::vector<double> integrals;
};

Results run(const std::filesystem::path& directory, const Partition& partition) {
  const Mesh mesh = mesh_of(directory, partition);
  const Setup setup = wavy_setup(directory);
  Output output(setup, Geometry::plane, mesh, world());
  const Snapshot snapshot = wavy(mesh);
  output.write(snapshot);
  output.history(snapshot, {});
  output.finish();
  Results results;
  for (const IntegralSetup& integral : setup.integrals) results.integrals.push_back(output.integral(integral.name));
  world().barrier();
  results.across = read(directory / "across.csv");
  results.diagonal = read(directory / "diagonal.csv");
  results.gauge = read(directory / "gauge.csv");
  results.history = read(directory / "history.csv");
  return results;
}

TEST_CASE("tables and integrals have the same bits however the cells are distributed, ranks without cells included") {
  const SharedScratch scratch;
  const Results whole = run(scratch.path / "whole", [](std::int64_t, int) { return 0; });
  REQUIRE(table(whole.across).size() == 56);
  REQUIRE(whole.integrals.size() == 5);
  for (const double value : whole.integrals) REQUIRE((value > 0 && value < 1.2));
  const std::vector<Partition> partitions = {
      {},
      [](std::int64_t cell, int n) { return static_cast<int>(cell * cell % 7 % n); },
      [](std::int64_t cell, int n) { return static_cast<int>((cell + cell / 9) % n); }};  // every face between ranks
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    CAPTURE(p);
    const Results parts = run(scratch.path / std::to_string(p), partitions[p]);
    CHECK(parts.across == whole.across);
    CHECK(parts.diagonal == whole.diagonal);
    CHECK(parts.gauge == whole.gauge);
    CHECK(parts.history == whole.history);
    CHECK(parts.integrals == whole.integrals);
  }
}

TEST_CASE("every rank writes its piece and the collection names them all") {
  const SharedScratch scratch;
  run(scratch.path, {});
  const std::string joined = read(scratch.path / "fields/impact_0000.pvtu");
  for (int rank = 0; rank < world().size(); ++rank) {
    const std::string piece = "impact_0000_" + std::to_string(rank) + ".vtu";
    CHECK_THAT(joined, Catch::Contains("<Piece Source=\"" + piece + "\"/>"));
    CHECK(std::filesystem::exists(scratch.path / "fields" / piece));
  }
}

/// What ParaView shows of an output, cell by cell: corners, and all values.
std::multiset<std::vector<double>> shown(const std::filesystem::path& file) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  std::multiset<std::vector<double>> cells;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    vtkPoints* corners = grid->GetCell(i)->GetPoints();
    std::vector<double> values{static_cast<double>(grid->GetCellType(i))};
    for (vtkIdType j = 0; j < corners->GetNumberOfPoints(); ++j)
      for (int c = 0; c < 3; ++c) values.push_back(corners->GetPoint(j)[c]);
    for (int a = 0; a < grid->GetCellData()->GetNumberOfArrays(); ++a) {
      vtkDataArray* array = grid->GetCellData()->GetArray(a);
      for (int c = 0; c < array->GetNumberOfComponents(); ++c) values.push_back(array->GetComponent(i, c));
    }
    cells.insert(values);
  }
  return cells;
}

TEST_CASE("some cells and slices hold the same however the cells are distributed, ranks without any included") {
  const SharedScratch scratch;
  const auto outputs = [&](const std::string& name, const Partition& partition) {
    const std::filesystem::path directory = scratch.path / name;
    const Mesh mesh = mesh_of(directory, partition);
    Setup setup = wavy_setup(directory);
    setup.output.only = {0};
    setup.output.only_above = 0.5;
    setup.slices = {{"middle", {0, 0.5, 0}, {0.3, 1, 0}, {}, {}, "case:1"}};
    Output output(setup, Geometry::plane, mesh, world());
    const Snapshot snapshot = wavy(mesh);
    output.write(snapshot);
    output.write_slice(0, snapshot);
    output.write_slice(0, snapshot);
    world().barrier();
    return std::pair(shown(directory / "fields/impact_0000.pvtu"), shown(directory / "slices/middle_0001.pvtu"));
  };
  const auto whole = outputs("whole", [](std::int64_t, int) { return 0; });
  REQUIRE(whole.first.size() > 10);
  REQUIRE(whole.first.size() < 50);
  CHECK(whole.second.size() == 11);  // 9 columns, and twice the line passes to another row
  for (const auto& cell : whole.first) CHECK(cell[1 + 4 * 3] > 0.5);  // copper, the first array
  const Partition mixed = [](std::int64_t cell, int n) { return static_cast<int>(cell * cell % 7 % n); };
  CHECK(outputs("metis", {}) == whole);
  CHECK(outputs("mixed", mixed) == whole);
}

TEST_CASE("a plane beside the mesh is refused by all ranks alike") {
  const SharedScratch scratch;
  const Mesh mesh = mesh_of(scratch.path, {});
  Setup setup = wavy_setup(scratch.path);
  setup.slices = {{"middle", {0, 2, 0}, {0, 1, 0}, {}, {}, "case:1"}};
  CHECK_THROWS_WITH(Output(setup, Geometry::plane, mesh, world()),
                    Catch::Contains("case:1: the plane of [[slice]] 'middle' cuts no cell"));
}

TEST_CASE("what one rank cannot write is an error on all, with that rank's path") {
  const SharedScratch scratch;
  const int last = world().size() - 1;
  const std::string piece = "fields/impact_0000_" + std::to_string(last) + ".vtu";
  const Mesh mesh = mesh_of(scratch.path, {});
  Output output(wavy_setup(scratch.path), Geometry::plane, mesh, world());
  if (world().root()) std::filesystem::create_directories(scratch.path / piece / "in the way");
  world().barrier();
  CHECK_THROWS_AS(output.write(wavy(mesh)), SystemError);
  CHECK_THROWS_WITH(output.write(wavy(mesh)), Catch::Contains(piece) && Catch::Contains("directory"));
  CHECK(!std::filesystem::exists(scratch.path / "impact.pvd"));
}

TEST_CASE("a point outside the mesh is refused by all ranks alike") {
  const SharedScratch scratch;
  const Mesh mesh = mesh_of(scratch.path, {});
  Setup setup = wavy_setup(scratch.path);
  setup.probes = {{"gauge", {2, 2, 0}}};
  CHECK_THROWS_WITH(Output(setup, Geometry::plane, mesh, world()),
                    "impact.toml: [[probe]] 'gauge': the point (2, 2, 0) lies outside the mesh");
}

}  // namespace
}  // namespace cobasis::test
