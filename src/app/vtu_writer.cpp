#include "app/vtu_writer.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cassert>

#include "math/errors.hpp"

namespace cobasis {
namespace {

int vtk_type(CellType type) {
  switch (type) {
    case CellType::triangle:
      return VTK_TRIANGLE;
    case CellType::quadrilateral:
      return VTK_QUAD;
    case CellType::tetrahedron:
      return VTK_TETRA;
    case CellType::hexahedron:
      return VTK_HEXAHEDRON;
    case CellType::prism:
      return VTK_WEDGE;
    case CellType::pyramid:
      return VTK_PYRAMID;
  }
  return VTK_EMPTY_CELL;
}

template <class Array>
void add_cell_data(vtkUnstructuredGrid& grid, const OutputField& field) {
  vtkNew<Array> array;
  array->SetName(field.name.c_str());
  const auto n_components = static_cast<int>(field.values.size());
  array->SetNumberOfComponents(n_components);
  for (std::size_t c = 0; c < field.components.size(); ++c) {
    array->SetComponentName(static_cast<vtkIdType>(c), field.components[c].c_str());
  }
  const vtkIdType n = grid.GetNumberOfCells();
  array->SetNumberOfTuples(n);
  auto* const to = array->GetPointer(0);
  using Value = std::remove_reference_t<decltype(*to)>;
  for (int c = 0; c < n_components; ++c) {
    const auto from = field.values[static_cast<std::size_t>(c)];
    assert(static_cast<vtkIdType>(from.size()) == n);
    for (vtkIdType i = 0; i < n; ++i) {
      to[i * n_components + c] = static_cast<Value>(from[static_cast<std::size_t>(i)]);
    }
  }
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
  grid.GetCellData()->AddArray(array);
}

template <class Array, class Value>
void add_field_data(vtkUnstructuredGrid& grid, const char* name, Value value) {
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  grid.GetFieldData()->AddArray(array);
}

std::string escape(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

struct VtuWriter::Grid {
  vtkNew<vtkUnstructuredGrid> vtk;
  bool float64 = false;
};

VtuWriter::VtuWriter(const DrawnCells& drawn, bool float64) : grid_(std::make_unique<Grid>()) {
  grid_->float64 = float64;
  vtkNew<vtkPoints> points;
  if (float64) points->SetDataTypeToDouble();
  for (const Point& x : drawn.points) points->InsertNextPoint(x.x, x.y, x.z);
  vtkUnstructuredGrid& grid = *grid_->vtk;
  grid.Allocate(static_cast<vtkIdType>(drawn.cell.size()));
  for (std::size_t i = 0; i < drawn.cell.size(); ++i) {
    const std::vector<vtkIdType> corners(drawn.corners.begin() + drawn.begin[i],
                                         drawn.corners.begin() + drawn.begin[i + 1]);
    const int type = !drawn.type.empty() ? vtk_type(drawn.type[i]) : corners.size() == 2 ? VTK_LINE : VTK_POLYGON;
    grid.InsertNextCell(type, static_cast<vtkIdType>(corners.size()), corners.data());
  }
  grid.SetPoints(points);
}

VtuWriter::~VtuWriter() = default;

std::string VtuWriter::vtu(const std::vector<OutputField>& fields, double time, std::int64_t step) const {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->CopyStructure(grid_->vtk);
  grid->GetPoints()
      ->GetData()
      ->GetInformation()
      ->Clear();  // ranges that writing leaves there would be written next time
  for (const OutputField& field : fields) {
    if (grid_->float64) {
      add_cell_data<vtkDoubleArray>(*grid, field);
    } else {
      add_cell_data<vtkFloatArray>(*grid, field);
    }
  }
  add_field_data<vtkDoubleArray>(*grid, "TimeValue", time);
  add_field_data<vtkTypeInt64Array>(*grid, "step", step);

  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0) throw SystemError("VTK could not encode the output");
  return writer->GetOutputString();
}

std::string pvtu(const std::vector<OutputField>& fields, const std::vector<std::string>& pieces, bool float64) {
  const char* type = float64 ? "Float64" : "Float32";
  std::string text = "<?xml version=\"1.0\"?>\n";
  text += "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
  text += "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  text += "    <PFieldData>\n";
  text += "      <PDataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"/>\n";
  text += "      <PDataArray type=\"Int64\" Name=\"step\" NumberOfTuples=\"1\"/>\n";
  text += "    </PFieldData>\n";
  text += "    <PCellData>\n";
  for (const OutputField& field : fields) {
    text += fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, escape(field.name),
                        field.values.size());
    for (std::size_t c = 0; c < field.components.size(); ++c) {
      text += fmt::format(" ComponentName{}=\"{}\"", c, field.components[c]);
    }
    text +=
        fmt::format(">\n        <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n",
                    escape(field.unit));
    text += "      </PDataArray>\n";
  }
  text += "    </PCellData>\n";
  text +=
      fmt::format("    <PPoints>\n      <PDataArray type=\"{}\" Name=\"Points\" NumberOfComponents=\"3\"/>\n", type);
  text += "    </PPoints>\n";
  for (const std::string& piece : pieces) text += fmt::format("    <Piece Source=\"{}\"/>\n", escape(piece));
  text += "  </PUnstructuredGrid>\n</VTKFile>\n";
  return text;
}

std::string pvd(const std::vector<std::pair<double, std::string>>& outputs) {
  std::string text = "<?xml version=\"1.0\"?>\n";
  text += "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& [time, file] : outputs) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, escape(file));
  }
  text += "  </Collection>\n</VTKFile>\n";
  return text;
}

}  // namespace cobasis
