#include "app/case_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "math/errors.hpp"

namespace cobasis {
namespace {

/// Line and column in the file, or (with set_key) somewhere in the text of a --set.
struct Origin {
  std::string set_key;

  Place operator()(const toml::source_region& source) const {
    return set_key.empty() ? Place{static_cast<int>(source.begin.line), {}} : Place{0, set_key};
  }
};

TomlValue plain(const toml::node& node, const Place& where, const Origin& origin);

TomlTable plain(const toml::table& table, const Origin& origin) {
  std::vector<std::pair<const toml::key*, const toml::node*>> nodes;
  for (const auto& [key, node] : table) nodes.emplace_back(&key, &node);
  // toml++ sorts by name; the order of phases and boundaries is the order in which the user wrote them
  std::ranges::sort(nodes, {}, [](const auto& node) {
    const toml::source_position begin = node.first->source().begin;
    return std::pair(begin.line, begin.column);
  });
  TomlTable entries;
  for (const auto& [key, node] : nodes) {
    const Place where = origin(key->source());
    entries.push_back({std::string(key->str()), where, plain(*node, where, origin)});
  }
  return entries;
}

TomlArray plain(const toml::array& array, const Origin& origin) {
  TomlArray values;
  for (const toml::node& node : array) values.push_back(plain(node, origin(node.source()), origin));
  return values;
}

TomlValue plain(const toml::node& node, const Place& where, const Origin& origin) {
  return {node.visit([&](const auto& value) -> decltype(TomlValue::data) {
            using Node = std::remove_cvref_t<decltype(value)>;
            if constexpr (toml::is_table<Node> || toml::is_array<Node>)
              return plain(value, origin);
            else if constexpr (toml::is_date<Node> || toml::is_time<Node> || toml::is_date_time<Node>)
              return TomlDate{};
            else
              return value.get();
          }),
          where};
}

}  // namespace

namespace {

constexpr std::size_t most_bytes = 16 << 20;
constexpr int most_dots = 20;  ///< in a key; tables in tables, as many as a key has parts, are taken apart by recursion

/// Where a key has too many parts, 0 if none has. A number has one dot at most, and texts are skipped as TOML does.
int line_of_deep_key(std::string_view text) {
  int line = 1, dots = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (c == '"' || c == '\'') {
      const std::string_view three = c == '"' ? R"(""")" : "'''";
      const bool is_long = text.substr(at, 3) == three;
      const std::string_view end = is_long ? three : three.substr(0, 1);
      for (at += end.size(); at < text.size() && text.substr(at, end.size()) != end; ++at) {
        if (text[at] == '\n') ++line;
        if (text[at] == '\\' && c == '"') ++at;
      }
      at += end.size() - 1;
    } else if (c == '.') {
      if (++dots > most_dots) return line;
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      dots = 0;
      line += c == '\n';
    }
  }
  return 0;
}

}  // namespace

TomlTable read_toml(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code none;
  if (!stream || std::filesystem::is_directory(file, none))
    throw InputError(fmt::format("{}: cannot be read; allowed: a case file (TOML)", file));
  std::string text, block(1 << 14, '\0');
  while (stream && text.size() <= most_bytes) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > most_bytes) throw InputError(fmt::format("{}: more than 16 MB; allowed: a case file (TOML)", file));
  if (const int line = line_of_deep_key(text); line > 0)
    throw InputError(
        fmt::format("{}:{}: a key of more than {} parts; allowed: a case file (TOML)", file, line, most_dots + 1));
  try {
    return plain(toml::parse(std::string_view(text), std::string_view(file)), Origin{});
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
  }
}

TomlValue toml_value_of(std::string_view text, const Place& where) {
  if (text.find_first_of("=[{") != std::string_view::npos && line_of_deep_key(text) > 0)
    throw InputError(fmt::format("--set {}: a key of more than {} parts in the value; allowed: keys of a case",
                                 where.set_key, most_dots + 1));
  try {
    const toml::table document = toml::parse("value = " + std::string(text));
    if (document.size() == 1) return plain(*document.get("value"), where, Origin{where.set_key});
  } catch (const toml::parse_error& error) {
    if (!text.empty() && std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
      throw InputError(fmt::format("--set {}: value {}: {}", where.set_key, text, error.description()));
  }
  return {std::string(text), where};
}

const TomlEntry* find_entry(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find(table, key, &TomlEntry::key);
  return found == table.end() ? nullptr : &*found;
}

std::string description(const TomlValue& value) {
  struct Describe {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return fmt::format("{}", x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return fmt::format("\"{}\"", x); }
    std::string operator()(const TomlDate&) const { return "a date or time"; }
    std::string operator()(const TomlArray& x) const { return fmt::format("an array of {}", x.size()); }
    std::string operator()(const TomlTable&) const { return "a table"; }
  };
  return std::visit(Describe{}, value.data);
}

}  // namespace cobasis
