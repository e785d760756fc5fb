// A named number of a struct as plain data: the case reader, its error texts and the help are made from these.
#pragma once

#include <limits>
#include <string_view>

namespace cobasis {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Allowed: low < value < high; a bound belongs to the range if it is marked closed.
template <class Owner>
struct FieldInfo {
  std::string_view key;
  std::string_view unit;
  double Owner::*member;
  double low = -infinity;
  double high = infinity;
  bool low_closed = false;
  bool high_closed = false;
  std::string_view meaning;
};

}  // namespace cobasis
