// A table of the case next to the list of its keys: what is wrong becomes a mistake, what is right can be read.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/case_keys.hpp"
#include "app/case_mistakes.hpp"
#include "app/case_toml.hpp"
#include "math/expression.hpp"
#include "math/vec3.hpp"

namespace cobasis {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Whether the value is what the key may hold; else a mistake is added. Values of tables are not looked into.
bool check_value(const KeyInfo& info, const std::string& name, const TomlValue& value, Mistakes& mistakes);

// A value that check_value accepted.
double number_of(const TomlValue& value);
const std::string& text_of(const TomlValue& value);

class CaseTable {
 public:
  /// Adds a mistake for every unknown, missing or wrong key. The keys of several lists can be put together.
  CaseTable(const TomlTable& table, const Place& where, std::vector<KeyInfo> keys, std::string title,
            Mistakes& mistakes);
  CaseTable(const TomlTable& table, const Place& where, const KeyTable& keys, Mistakes& mistakes)
      : CaseTable(table, where, keys.keys, keys.title, mistakes) {}

  const Place& where() const { return where_; }
  /// Of the key, or of the table where it is absent.
  Place where(std::string_view key) const;
  Mistakes& mistakes() const { return *mistakes_; }

  /// Of keys that exclude each other: more than one is a mistake, except that the command line's replaces the file's.
  void at_most_one(std::initializer_list<std::string_view> keys);

  /// Whether the key is there, right or wrong: what is there is not missing.
  bool has(std::string_view key) const;

  // Nothing where the key is absent or wrong.
  std::optional<double> number(std::string_view key) const;
  std::optional<std::int64_t> integer(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<std::vector<std::string>> words(std::string_view key) const;
  std::vector<std::string> names(std::string_view key) const;
  std::optional<Point> point(std::string_view key) const;
  std::optional<std::array<Expression, 3>> vector_field(std::string_view key) const;
  std::optional<Expression> expression(std::string_view key) const;
  std::optional<Matrix> matrix(std::string_view key) const;
  const TomlEntry* table(std::string_view key) const;  ///< its value holds a TomlTable
  std::optional<CaseTable> table(std::string_view key, const KeyTable& keys) const;
  std::vector<CaseTable> tables(std::string_view key, const KeyTable& keys) const;
  const TomlEntry* entry(std::string_view key) const;

 private:
  struct Given {
    const TomlEntry* entry;
    bool right;
  };
  const Given* find(std::string_view key) const;

  Place where_;
  std::vector<KeyInfo> keys_;
  std::vector<Given> given_;
  Mistakes* mistakes_;
};

}  // namespace cobasis
