#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <catch2/catch.hpp>

#include "app/output.hpp"
#include "output_scene.hpp"

namespace cobasis::test {
namespace {

/// What ParaView would see of an output.
vtkNew<vtkXMLPUnstructuredGridReader> open(const std::filesystem::path& file) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  REQUIRE(reader->CanReadFile(file.c_str()));
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader;
}

TEST_CASE("fields read back with names, components, units, values and time") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 2, 0.5);
  Setup setup = three_phases(scratch.path);
  setup.output.float64 = GENERATE(false, true);
  Output output(setup, Geometry::plane, mesh, world());
  const Snapshot snapshot = three_phase_state(8, 0.1);
  output.write(snapshot);

  const auto reader = open(scratch.path / "fields/impact_0000.pvtu");
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 8);
  CHECK(grid->GetNumberOfPoints() == 15);
  CHECK(grid->GetCellType(3) == VTK_QUAD);
  double bounds[6];
  grid->GetBounds(bounds);
  CHECK(bounds[1] == 2);
  CHECK(bounds[3] == 1);

  vtkCellData* data = grid->GetCellData();
  const struct {
    const char* name;
    int components;
    const char* unit;
  } expected[] = {{"alpha.copper", 1, "1"},
                  {"density.copper", 1, "kg/m^3"},
                  {"velocity.copper", 3, "m/s"},
                  {"pressure.copper", 1, "Pa"},
                  {"stress.copper", 6, "Pa"},
                  {"cobasis.copper", 9, "1"},
                  {"energy.copper", 1, "J/kg"},
                  {"elastic_energy.copper", 1, "J/kg"},
                  {"alpha.gas", 1, "1"},
                  {"density.gas", 1, "kg/m^3"},
                  {"velocity.gas", 3, "m/s"},
                  {"pressure.gas", 1, "Pa"},
                  {"stress.gas", 6, "Pa"},
                  {"energy.gas", 1, "J/kg"},
                  {"alpha.outside", 1, "1"},
                  {"density", 1, "kg/m^3"},
                  {"velocity", 3, "m/s"},
                  {"pressure", 1, "Pa"},
                  {"stress", 6, "Pa"}};
  CHECK(data->GetNumberOfArrays() == static_cast<int>(std::size(expected)));
  for (const auto& field : expected) {
    CAPTURE(field.name);
    vtkDataArray* array = data->GetArray(field.name);
    REQUIRE(array != nullptr);
    CHECK(array->GetNumberOfComponents() == field.components);
    CHECK(array->GetDataType() == (setup.output.float64 ? VTK_DOUBLE : VTK_FLOAT));
    REQUIRE(array->GetInformation()->Has(vtkDataArray::UNITS_LABEL()));
    CHECK(std::string(array->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) == field.unit);
  }
  // copper lives in the first three cells; multiples of 1/8 are exact in both precisions
  CHECK(data->GetArray("velocity.copper")->GetComponent(1, 2) == snapshot.phases[0].velocity[2][1]);
  CHECK(data->GetArray("stress.copper")->GetComponent(2, 4) == snapshot.phases[0].stress[4][2]);
  CHECK(data->GetArray("cobasis.copper")->GetComponent(2, 8) == snapshot.phases[0].cobasis[8][2]);
  CHECK(data->GetArray("density.gas")->GetComponent(7, 0) == snapshot.phases[1].density[7]);
  CHECK(data->GetArray("density.copper")->GetComponent(7, 0) == 0);
  CHECK(data->GetArray("pressure")->GetComponent(2, 0) == 0.5 * 120.25 + 0.25 * 220.25 + 2.5);
  CHECK(std::string(data->GetArray("stress")->GetComponentName(4)) == "yz");
  CHECK(std::string(data->GetArray("cobasis.copper")->GetComponentName(3)) == "e2.x");

  vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue");
  REQUIRE(time != nullptr);
  CHECK(time->GetComponent(0, 0) == 0.1);
}

TEST_CASE("every cell type keeps its corners") {
  const Scratch scratch;
  Mesh mesh;
  mesh.dimension = 3;
  const std::vector<std::pair<CellType, int>> types = {{CellType::tetrahedron, VTK_TETRA},
                                                       {CellType::hexahedron, VTK_HEXAHEDRON},
                                                       {CellType::prism, VTK_WEDGE},
                                                       {CellType::pyramid, VTK_PYRAMID}};
  const std::vector<std::vector<Point>> corners = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};
  mesh.cell_node_begin = {0};
  mesh.nodes.push_back({99, 99, 99});  // a halo's node: not written
  for (std::size_t t = 0; t < types.size(); ++t) {
    mesh.cell_type.push_back(types[t].first);
    for (const Point& x : corners[t]) {
      mesh.cell_nodes.push_back(static_cast<std::int32_t>(mesh.nodes.size()));
      mesh.nodes.push_back(x);
    }
    mesh.cell_node_begin.push_back(static_cast<std::int32_t>(mesh.cell_nodes.size()));
  }
  mesh.n_owned = 4;

  write_atomically((scratch.path / "all.vtu").string(), VtuWriter(draw(mesh), false).vtu({}, 0, 0));
  write_atomically((scratch.path / "all.pvtu").string(), pvtu({}, {"all.vtu"}, false));
  const auto reader = open(scratch.path / "all.pvtu");
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 4);
  CHECK(grid->GetNumberOfPoints() == 23);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const auto cell = static_cast<vtkIdType>(t);
    CHECK(grid->GetCellType(cell) == types[t].second);
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    grid->GetCellPoints(cell, n, points);
    REQUIRE(n == static_cast<vtkIdType>(corners[t].size()));
    for (vtkIdType p = 0; p < n; ++p) {
      const double* x = grid->GetPoint(points[p]);
      CHECK((x[0] == corners[t][p].x && x[1] == corners[t][p].y && x[2] == corners[t][p].z));
    }
  }
}

TEST_CASE("a rank without cells writes a piece that ParaView joins with the others") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 2, 0.5);
  const Setup setup = three_phases(scratch.path);
  Mesh nothing;
  nothing.dimension = 2;
  nothing.cell_node_begin = {0};
  const auto write = [&](const char* name, const Mesh& part) {
    const Snapshot snapshot = three_phase_state(part.n_owned, 0);
    const Mixture mixture = mix(snapshot, setup.phases);
    const auto fields = output_fields(setup.output.fields, snapshot, mixture);
    write_atomically((scratch.path / name).string(), VtuWriter(draw(part), false).vtu(fields, 0, 0));
    return pvtu(fields, {"0.vtu", "1.vtu", "2.vtu"}, false);
  };
  const std::string whole = write("0.vtu", mesh);
  CHECK(write("1.vtu", nothing) == whole);
  write("2.vtu", mesh);
  write_atomically((scratch.path / "all.pvtu").string(), whole);
  const auto reader = open(scratch.path / "all.pvtu");
  CHECK(reader->GetOutput()->GetNumberOfCells() == 16);
  REQUIRE(reader->GetOutput()->GetCellData()->GetArray("stress.copper") != nullptr);
  CHECK(reader->GetOutput()->GetCellData()->GetArray("stress.copper")->GetComponent(8, 0) == 130);
}

TEST_CASE("names that mean something to XML are written as text") {
  const std::string text = pvtu({{"alpha.a<b&\"c\"", "1", {}, {{}}, {}}}, {"a&b.vtu"}, false);
  CHECK_THAT(text, Catch::Contains("Name=\"alpha.a&lt;b&amp;&quot;c&quot;\"") && Catch::Contains("a&amp;b.vtu"));
}

}  // namespace
}  // namespace cobasis::test
