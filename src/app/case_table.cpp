#include "app/case_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "math/suggestion.hpp"

namespace cobasis {
namespace {

Point point_of(const TomlArray& x) { return {number_of(x[0]), number_of(x[1]), x.size() == 3 ? number_of(x[2]) : 0}; }

Expression expression_of(const TomlValue& value) {
  const auto* text = std::get_if<std::string>(&value.data);
  return text ? Expression(*text) : Expression(number_of(value));
}

}  // namespace

CaseTable::CaseTable(const TomlTable& table, const Place& where, std::vector<KeyInfo> keys, std::string title,
                     Mistakes& mistakes)
    : where_(where), keys_(std::move(keys)), mistakes_(&mistakes) {
  for (const TomlEntry& entry : table) {
    const auto info = std::ranges::find(keys_, entry.key, &KeyInfo::key);
    if (info == keys_.end()) {
      std::vector<std::string> names;
      for (const KeyInfo& known : keys_) names.push_back(known.key);
      mistakes.add(entry.where,
                   fmt::format("unknown key \"{}\" ({}); {}", entry.key, title, allowed_names(entry.key, names)));
    } else {
      given_.push_back({&entry, check_value(*info, entry.key, entry.value, mistakes)});
    }
  }
  for (const KeyInfo& info : keys_)
    if (info.required && !has(info.key))
      mistakes.add(where_, fmt::format("missing key \"{}\" ({}: {}); allowed: {}", info.key, title, info.meaning,
                                       allowed_values(info)));
}

const CaseTable::Given* CaseTable::find(std::string_view key) const {
  assert(std::ranges::find(keys_, key, &KeyInfo::key) != keys_.end());
  const auto found = std::ranges::find_if(given_, [&](const Given& given) { return given.entry->key == key; });
  return found == given_.end() ? nullptr : &*found;
}

bool CaseTable::has(std::string_view key) const { return find(key) != nullptr; }

Place CaseTable::where(std::string_view key) const {
  const Given* given = find(key);
  return given ? given->entry->where : where_;
}

const TomlEntry* CaseTable::entry(std::string_view key) const {
  const Given* given = find(key);
  return given && given->right ? given->entry : nullptr;
}

void CaseTable::at_most_one(std::initializer_list<std::string_view> keys) {
  const auto excluded = [&](const Given& given) {
    return std::ranges::find(keys, given.entry->key) != keys.end() && !given.entry->where.from_command_line();
  };
  if (std::ranges::any_of(keys, [&](auto key) { return has(key) && where(key).from_command_line(); }))
    std::erase_if(given_, excluded);
  std::string first;
  for (const std::string_view key : keys) {
    if (!has(key)) continue;
    if (!first.empty())
      mistakes_->add(where(key), fmt::format("both \"{}\" and \"{}\"; allowed: one of them", first, key));
    first = key;
  }
}

std::optional<double> CaseTable::number(std::string_view key) const {
  const TomlEntry* found = entry(key);
  return found ? std::optional(number_of(found->value)) : std::nullopt;
}

std::optional<std::int64_t> CaseTable::integer(std::string_view key) const {
  const auto x = number(key);
  return x ? std::optional(static_cast<std::int64_t>(*x)) : std::nullopt;
}

std::optional<std::string> CaseTable::text(std::string_view key) const {
  const TomlEntry* found = entry(key);
  return found ? std::optional(text_of(found->value)) : std::nullopt;
}

std::optional<std::vector<std::string>> CaseTable::words(std::string_view key) const {
  const TomlEntry* found = entry(key);
  if (!found) return std::nullopt;
  std::vector<std::string> words;
  if (const auto* array = std::get_if<TomlArray>(&found->value.data))
    for (const TomlValue& item : *array) words.push_back(text_of(item));
  if (words.empty() || words[0] == "all") return std::ranges::find(keys_, key, &KeyInfo::key)->words;
  return words;
}

std::vector<std::string> CaseTable::names(std::string_view key) const {
  const TomlEntry* found = entry(key);
  if (!found) return {};
  const auto* array = std::get_if<TomlArray>(&found->value.data);
  if (!array) return {text_of(found->value)};
  std::vector<std::string> names;
  std::ranges::transform(*array, std::back_inserter(names), text_of);
  return names;
}

std::optional<Point> CaseTable::point(std::string_view key) const {
  const TomlEntry* found = entry(key);
  return found ? std::optional(point_of(std::get<TomlArray>(found->value.data))) : std::nullopt;
}

std::optional<std::array<Expression, 3>> CaseTable::vector_field(std::string_view key) const {
  const TomlEntry* found = entry(key);
  if (!found) return std::nullopt;
  const auto& items = std::get<TomlArray>(found->value.data);
  std::array<Expression, 3> field;
  std::ranges::transform(items, field.begin(), expression_of);
  return field;
}

std::optional<Expression> CaseTable::expression(std::string_view key) const {
  const TomlEntry* found = entry(key);
  return found ? std::optional(expression_of(found->value)) : std::nullopt;
}

std::optional<Matrix> CaseTable::matrix(std::string_view key) const {
  const TomlEntry* found = entry(key);
  if (!found) return std::nullopt;
  Matrix matrix{};
  const auto& rows = std::get<TomlArray>(found->value.data);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) matrix[i][j] = number_of(std::get<TomlArray>(rows[i].data)[j]);
  return matrix;
}

const TomlEntry* CaseTable::table(std::string_view key) const {
  const TomlEntry* found = entry(key);
  return found && std::holds_alternative<TomlTable>(found->value.data) ? found : nullptr;
}

std::optional<CaseTable> CaseTable::table(std::string_view key, const KeyTable& keys) const {
  const TomlEntry* found = table(key);
  if (!found) return std::nullopt;
  return CaseTable(std::get<TomlTable>(found->value.data), found->where, keys, *mistakes_);
}

std::vector<CaseTable> CaseTable::tables(std::string_view key, const KeyTable& keys) const {
  std::vector<CaseTable> tables;
  if (const TomlEntry* found = entry(key))
    for (const TomlValue& item : std::get<TomlArray>(found->value.data))
      tables.emplace_back(std::get<TomlTable>(item.data), item.where, keys, *mistakes_);
  return tables;
}

}  // namespace cobasis
