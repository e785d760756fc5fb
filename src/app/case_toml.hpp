// A TOML document as plain values in the order of their appearance, each with where it was said.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace cobasis {

/// Where a key or value comes from: a line of the case file, or a --set of the command line.
struct Place {
  int line = 0;
  std::string set_key;  ///< not empty: from --set of this key

  bool from_command_line() const { return !set_key.empty(); }
};

struct TomlValue;
struct TomlEntry;
struct TomlDate {};  ///< TOML knows dates and times; a case has none
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;

struct TomlValue {
  std::variant<bool, std::int64_t, double, std::string, TomlDate, TomlArray, TomlTable> data;
  Place where;
};

struct TomlEntry {
  std::string key;
  Place where;  ///< of the key
  TomlValue value;
};

const TomlEntry* find_entry(const TomlTable& table, std::string_view key);

/// 3, "abc", a table: what a message says was found.
std::string description(const TomlValue& value);

/// The document of a file. Throws InputError (file:line) where it cannot be read or is not TOML.
TomlTable read_toml(const std::string& file);

/// The value that text means on the command line: TOML, or else the text itself. Throws InputError on a broken array,
/// table or quotation.
TomlValue toml_value_of(std::string_view text, const Place& where);

/// Puts a value at a dotted key: tables on the way are created, elements of arrays go by their index from 0. Throws
/// InputError where the way leads through something else.
void set_value(TomlTable& document, const std::string& dotted_key, const std::string& value);

}  // namespace cobasis
