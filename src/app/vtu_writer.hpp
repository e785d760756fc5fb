// Fields on the mesh as ParaView's files: .vtu per rank, .pvtu per output, .pvd per run. The only door to VTK.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/drawn_cells.hpp"
#include "app/output_fields.hpp"

namespace cobasis {

/// Cells of a rank as VTK sees them.
class VtuWriter {
 public:
  VtuWriter(const DrawnCells& drawn, bool float64);
  ~VtuWriter();

  /// Values of the fields are in the order of the drawn cells. The bytes of a .vtu: appended raw, LZ4. Time [s] and
  /// step travel as field data, units as UNITS_LABEL.
  std::string vtu(const std::vector<OutputField>& fields, double time, std::int64_t step) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

/// The .pvtu that joins the pieces (paths relative to it).
std::string pvtu(const std::vector<OutputField>& fields, const std::vector<std::string>& pieces, bool float64);

/// The .pvd of (time [s], path relative to it).
std::string pvd(const std::vector<std::pair<double, std::string>>& outputs);

}  // namespace cobasis
