// Every key of a case file as data: the reader checks by this list, and the help is printed from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/field_info.hpp"

namespace cobasis {

enum class KeyKind {
  integer,
  number,
  text,
  word,          ///< text, one of KeyInfo::words
  words,         ///< an array of them, or "all"
  names,         ///< text, or an array of texts
  file_name,     ///< text that can be part of a file name and of a column's header
  expression,    ///< text: a condition in x, y, z
  field,         ///< a number or an expression
  point,         ///< 2 or 3 numbers
  vector_field,  ///< 2 or 3 numbers or expressions
  matrix,        ///< 3 x 3 numbers
  table,
  tables,  ///< [[...]]
  integer_or_table,
  word_or_table,  ///< one of KeyInfo::words, or a table with it as type
  number_or_word,
};

/// low < value < high; a bound belongs to the range if it is closed.
struct Range {
  double low = -infinity;
  double high = infinity;
  bool low_closed = false;
  bool high_closed = false;
  bool or_zero = false;

  bool contains(double x) const;
};

struct KeyInfo {
  std::string key;  ///< in capitals: any name
  KeyKind kind = KeyKind::number;
  std::string unit = {};
  Range range = {};
  std::vector<std::string> words = {};
  bool required = false;
  std::string fallback = {};  ///< the default, in words
  std::string meaning = {};

  bool any_name() const { return !key.empty() && key[0] >= 'A' && key[0] <= 'Z'; }
};

struct KeyTable {
  std::string title;
  std::string meaning = {};
  std::vector<KeyInfo> keys;
};

/// All tables, in the order of the help.
std::span<const KeyTable> case_keys();

/// The table of this title, which must exist.
const KeyTable& keys_of(std::string_view title);

/// "a number [s], 0 < end_time"
std::string allowed_values(const KeyInfo& info);

/// The text of `cobasis help case`.
std::string describe_case_keys();

}  // namespace cobasis
