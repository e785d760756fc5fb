// What of a run must outlive it. Every part of the solver names what it keeps, in one function for both ways: a keeper
// that writes reads the references, one that reads sets them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "math/errors.hpp"
#include "math/field_info.hpp"

namespace cobasis {

/// `width` numbers for each of some owned cells, which may come several times and are in ascending order.
struct CellRows {
  int width = 1;
  std::vector<std::int32_t> cells;
  std::vector<double> values;
  double least = -infinity, most = infinity;  ///< what values may be; those of whole numbers lose what they have beyond

  void add(std::int32_t cell, std::initializer_list<double> row) {
    cells.push_back(cell);
    values.insert(values.end(), row);
  }
  std::span<const double> row(std::size_t i) const {
    return {values.data() + i * width, static_cast<std::size_t>(width)};
  }
};

/// All members are collective; names are unique.
class Keeper {
 public:
  virtual ~Keeper() = default;
  virtual bool reads() const = 0;

  /// The same on all ranks.
  virtual void number(const std::string& name, double& value) = 0;
  /// What counts is the sum over ranks; rank 0 gets all of it back.
  virtual void counter(const std::string& name, std::int64_t& value) = 0;
  /// A number per owned cell.
  virtual void cells(const std::string& name, std::span<double> values) = 0;
  /// A number per boundary face.
  virtual void boundary_faces(const std::string& name, std::span<double> values) = 0;
  /// Where reading, `width` is given and the rest is found.
  virtual void some_cells(const std::string& name, CellRows& rows) = 0;
  /// Rank 0's; read on all ranks.
  virtual void text(const std::string& name, std::string& value) = 0;

  void whole_number(const std::string& name, std::int64_t& value) {
    auto x = static_cast<double>(value);
    number(name, x);
    value = whole(name, x);
  }

 protected:
  /// Throws SystemError for what is no whole number that a double holds exactly.
  static std::int64_t whole(const std::string& name, double x) {
    if (!(x >= -0x1p53 && x <= 0x1p53)) throw SystemError("cannot read '" + name + "': no whole number");
    return static_cast<std::int64_t>(x);
  }
};

}  // namespace cobasis
