// --set key=value: values put into the case before it is checked.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "app/case_toml.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

/// a.b."c.d" -> a, b, c.d
std::vector<std::string> segments_of(const std::string& dotted_key) {
  std::vector<std::string> segments(1);
  char quote = 0;
  for (const char c : dotted_key) {
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? 0 : c;
    else if (c == '.' && !quote)
      segments.emplace_back();
    else
      segments.back() += c;
  }
  constexpr std::size_t most = 20;
  if (segments.size() > most)
    throw InputError(fmt::format("--set: a key of {} parts; allowed: at most {}", segments.size(), most));
  if (quote || std::ranges::any_of(segments, &std::string::empty))
    throw InputError(
        fmt::format("--set {0}: \"{0}\" is not a key; allowed: names and numbers separated by dots", dotted_key));
  return segments;
}

TomlValue& element(TomlArray& array, const std::string& segment, const std::string& dotted_key) {
  std::size_t index = 0;
  const char* end = segment.data() + segment.size();
  const auto [parsed, error] = std::from_chars(segment.data(), end, index);
  if (error != std::errc() || parsed != end || index >= array.size())
    throw InputError(fmt::format("--set {}: found index \"{}\" of an array; allowed: {}", dotted_key, segment,
                                 array.empty() ? "none, it is empty" : fmt::format("0 to {}", array.size() - 1)));
  return array[index];
}

}  // namespace

void set_value(TomlTable& document, const std::string& dotted_key, const std::string& text) {
  const Place where{0, dotted_key};
  const std::vector<std::string> segments = segments_of(dotted_key);
  TomlTable* table = &document;
  TomlArray* array = nullptr;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    TomlValue* value = nullptr;
    if (array) {
      value = &element(*array, segments[i], dotted_key);
    } else {
      auto entry = std::ranges::find(*table, segments[i], &TomlEntry::key);
      if (entry == table->end())
        entry = table->insert(table->end(), {segments[i], where, TomlValue{TomlTable{}, where}});
      value = &entry->value;
      if (i + 1 == segments.size()) entry->where = where;
    }
    if (i + 1 == segments.size()) {
      *value = toml_value_of(text, where);
      return;
    }
    table = std::get_if<TomlTable>(&value->data);
    array = std::get_if<TomlArray>(&value->data);
    if (!table && !array)
      throw InputError(fmt::format("--set {}: \"{}\" is {}; allowed: keys of tables, indices of arrays", dotted_key,
                                   segments[i], description(*value)));
  }
}

}  // namespace cobasis
