// The keys of a case file in words: for messages and for `cobasis help case`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "app/case_keys.hpp"

namespace cobasis {
namespace {

std::string type_of(const KeyInfo& info) {
  std::string words = fmt::format("{}", fmt::join(info.words, ", "));
  switch (info.kind) {
    case KeyKind::integer:
      return "a whole number";
    case KeyKind::number:
      return "a number";
    case KeyKind::text:
      return "text";
    case KeyKind::word:
      return words;
    case KeyKind::words:
      return fmt::format("\"all\", or an array of: {}", words);
    case KeyKind::names:
      return "text, or an array of texts";
    case KeyKind::file_name:
      return "text of letters, digits, _ - . that does not begin with .";
    case KeyKind::expression:
      return "text: a formula in x, y, z";
    case KeyKind::field:
      return "a number, or a formula in x, y, z";
    case KeyKind::point:
      return "an array of 2 or 3 numbers";
    case KeyKind::vector_field:
      return "an array of 2 or 3 numbers or formulas in x, y, z";
    case KeyKind::matrix:
      return "an array of 3 arrays of 3 numbers";
    case KeyKind::table:
      return "a table";
    case KeyKind::tables:
      return "an array of tables, [[...]]";
    case KeyKind::integer_or_table:
      return "a whole number; or a table";
    case KeyKind::word_or_table:
      return fmt::format("{}; or a table with one of these as type", words);
    case KeyKind::number_or_word:
      return fmt::format("{}, or a number", words);
  }
  return {};
}

std::string range_of(const KeyInfo& info) {
  const Range& range = info.range;
  const bool below = std::isfinite(range.high), above = std::isfinite(range.low);
  if (above && range.low == range.high) return fmt::format("{:.15g}", range.low);
  if (!above && !below) return {};
  return fmt::format("{}{}{}{}", range.or_zero ? "0, or " : "",
                     above ? fmt::format("{:.15g} {} ", range.low, range.low_closed ? "<=" : "<") : "", info.key,
                     below ? fmt::format(" {} {:.15g}", range.high_closed ? "<=" : "<", range.high) : "");
}

}  // namespace

bool Range::contains(double x) const {
  if (or_zero && x == 0) return true;
  return std::isfinite(x) && (low_closed ? x >= low : x > low) && (high_closed ? x <= high : x < high);
}

std::string allowed_values(const KeyInfo& info) {
  const std::string range = range_of(info);
  return type_of(info) + (info.unit.empty() ? "" : fmt::format(" [{}]", info.unit)) +
         (range.empty() ? "" : ", " + range);
}

std::string describe_case_keys() {
  std::string text = "Keys of a case file (TOML)\n";
  for (const KeyTable& table : case_keys()) {
    text += fmt::format("\n{}{}\n", table.title, table.meaning.empty() ? "" : ": " + table.meaning);
    for (const KeyInfo& info : table.keys) {
      text += fmt::format("  {:<16} {}\n", info.key, info.meaning);
      text +=
          fmt::format("  {:<16}   {}; {}\n", "", allowed_values(info),
                      info.fallback.empty() ? (info.required ? "required" : "optional") : "default: " + info.fallback);
    }
  }
  return text;
}

}  // namespace cobasis
