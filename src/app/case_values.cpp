// Whether a value is what its key may hold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "app/case_table.hpp"
#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

std::optional<double> as_number(const TomlValue& value) {
  if (const auto* x = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*x);
  if (const auto* x = std::get_if<double>(&value.data)) return *x;
  return std::nullopt;
}

class ValueCheck {
 public:
  ValueCheck(const KeyInfo& info, const std::string& name, Mistakes& mistakes)
      : info_(info), name_(name), mistakes_(mistakes) {}

  bool operator()(const TomlValue& value) {
    switch (info_.kind) {
      case KeyKind::integer:
        return number(value, true);
      case KeyKind::number:
        return number(value, false);
      case KeyKind::text:
        return text(value) || refuse(value);
      case KeyKind::word:
        return word(value);
      case KeyKind::words:
        return words(value);
      case KeyKind::names:
        return text(value) || array(value, 1, 1000, [this](const TomlValue& x) { return text(x) || refuse(x); });
      case KeyKind::file_name:
        return file_name(value);
      case KeyKind::expression:
        return text(value) ? formula(value) : refuse(value);
      case KeyKind::field:
        return text(value) ? formula(value) : number(value, false);
      case KeyKind::point:
        return array(value, 2, 3, [this](const TomlValue& x) { return number(x, false); });
      case KeyKind::vector_field:
        return array(value, 2, 3, [this](const TomlValue& x) { return text(x) ? formula(x) : number(x, false); });
      case KeyKind::matrix:
        return array(value, 3, 3, [this](const TomlValue& row) {
          return array(row, 3, 3, [this](const TomlValue& x) { return number(x, false); });
        });
      case KeyKind::table:
        return std::holds_alternative<TomlTable>(value.data) || refuse(value);
      case KeyKind::tables:
        return tables(value);
      case KeyKind::integer_or_table:
        return std::holds_alternative<TomlTable>(value.data) || number(value, true);
      case KeyKind::word_or_table:
        return std::holds_alternative<TomlTable>(value.data) || word(value);
      case KeyKind::number_or_word:
        return text(value) ? word(value) : number(value, false);
    }
    return false;
  }

 private:
  static const std::string* text(const TomlValue& value) { return std::get_if<std::string>(&value.data); }

  bool refuse(const TomlValue& value) {
    mistakes_.add(value.where, fmt::format("{} = {}; allowed: {}", name_, description(value), allowed_values(info_)));
    return false;
  }

  bool number(const TomlValue& value, bool whole) {
    const auto x = as_number(value);
    return (x && info_.range.contains(*x) && (!whole || *x == std::floor(*x))) || refuse(value);
  }

  bool word(const TomlValue& value) {
    if (!text(value)) return refuse(value);
    if (std::ranges::find(info_.words, *text(value)) != info_.words.end()) return true;
    mistakes_.add(value.where,
                  fmt::format("{} = {}; {}", name_, description(value), allowed_names(*text(value), info_.words)));
    return false;
  }

  bool words(const TomlValue& value) {
    if (text(value) && *text(value) == "all") return true;
    const auto* array = std::get_if<TomlArray>(&value.data);
    if (!array || array->empty()) return refuse(value);
    std::set<std::string> seen;
    for (const TomlValue& item : *array) {
      if (array->size() == 1 && text(item) && *text(item) == "all") return true;
      if (!word(item)) return false;
      if (!seen.insert(*text(item)).second) {
        mistakes_.add(item.where, fmt::format("{} has {} twice; allowed: each once", name_, description(item)));
        return false;
      }
    }
    return true;
  }

  bool file_name(const TomlValue& value) {
    const auto safe = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
             c == '.';
    };
    return (text(value) && !text(value)->empty() && text(value)->size() <= 100 && text(value)->front() != '.' &&
            std::ranges::all_of(*text(value), safe)) ||
           refuse(value);
  }

  bool formula(const TomlValue& value) {
    try {
      const Expression expression(*text(value));
      if (!expression.is_constant() || info_.range.contains(expression.constant())) return true;
      return refuse(value);
    } catch (const InputError& error) {
      mistakes_.add(value.where, fmt::format("{}: {}; allowed: {}", name_, error.what(), allowed_values(info_)));
      return false;
    }
  }

  template <class Check>
  bool array(const TomlValue& value, std::size_t least, std::size_t most, Check check) {
    const auto* items = std::get_if<TomlArray>(&value.data);
    if (!items || items->size() < least || items->size() > most) return refuse(value);
    return std::ranges::all_of(*items, check);
  }

  bool tables(const TomlValue& value) {
    const auto* items = std::get_if<TomlArray>(&value.data);
    const auto is_table = [](const TomlValue& item) { return std::holds_alternative<TomlTable>(item.data); };
    return (items && std::ranges::all_of(*items, is_table)) || refuse(value);
  }

  const KeyInfo& info_;
  const std::string& name_;
  Mistakes& mistakes_;
};

}  // namespace

bool check_value(const KeyInfo& info, const std::string& name, const TomlValue& value, Mistakes& mistakes) {
  return ValueCheck(info, name, mistakes)(value);
}

double number_of(const TomlValue& value) { return as_number(value).value(); }

const std::string& text_of(const TomlValue& value) { return std::get<std::string>(value.data); }

}  // namespace cobasis
