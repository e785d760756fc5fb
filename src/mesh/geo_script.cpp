#include "mesh/geo_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

using std::string_view;

struct Token {
  enum Kind { word, text, symbol } kind;
  string_view value;  ///< without the quotes of a text
  int line;
};

/// Words of Gmsh's language that run programs or read or write files; also every word that ends in FileName.
constexpr std::array<string_view, 20> dangerous{
    "SystemCall",
    "System",
    "NonBlockingSystemCall",
    "NonBlockingSystem",
    "OnelabRun",
    "OnelabAction",
    "Merge",
    "Include",
    "Print",
    "MergeWithBoundingBox",
    "Save",
    "CreateDir",
    "Plugin",
    "Solver",
    "ListFromFile",
    "ShapeFromFile",
    "ExternalProcess",
    "CommandLine",
    "SyncModel",
    "DeleteFile",
};

bool is_dangerous(string_view word) {
  return std::find(dangerous.begin(), dangerous.end(), word) != dangerous.end() || word.ends_with("FileName");
}

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

[[noreturn]] void refuse(const std::string& file, int line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}; --trust-geo lets the script do so", file, line, what));
}

/// Splits a script as Gmsh does: // and /* */ comments, "" and '' texts without escapes.
std::vector<Token> tokens_of(const std::string& script) {
  std::vector<Token> tokens;
  const string_view all = script;
  int line = 1;
  for (std::size_t at = 0; at < all.size();) {
    const char c = all[at];
    const auto take = [&](Token::Kind kind, std::size_t first, std::size_t count, std::size_t next) {
      tokens.push_back({kind, all.substr(first, count), line});
      line += static_cast<int>(std::count(all.begin() + at, all.begin() + std::min(next, all.size()), '\n'));
      at = next;
    };
    if (all.substr(at, 2) == "//") {
      at = std::min(all.find('\n', at), all.size());
    } else if (all.substr(at, 2) == "/*") {
      const std::size_t end = std::min(all.find("*/", at + 2), all.size() - 2) + 2;
      line += static_cast<int>(std::count(all.begin() + at, all.begin() + end, '\n'));
      at = end;
    } else if (c == '"' || c == '\'') {
      const std::size_t end = std::min(all.find(c, at + 1), all.size());
      take(Token::text, at + 1, end - at - 1, end + 1);
    } else if (starts_word(c)) {
      std::size_t end = at;
      while (end < all.size() && in_word(all[end])) ++end;
      take(Token::word, at, end - at, end);
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      if (c == '\n') ++line;
      ++at;
    } else {
      take(Token::symbol, at, 1, at + 1);
    }
  }
  return tokens;
}

void refuse_dangerous_text(const std::string& file, const Token& token) {
  // Where Gmsh skips the branch of an If it does not honour quotes: such texts could hide commands from us.
  if (token.value.find('\n') != string_view::npos || token.value.find("//") != string_view::npos ||
      token.value.find("/*") != string_view::npos || token.value.size() > 1000)
    refuse(file, token.line, "a text with a line break, a comment sign or more than 1000 characters cannot be checked");
  for (std::size_t at = 0; at < token.value.size();) {
    std::size_t end = at;
    while (end < token.value.size() && in_word(token.value[end])) ++end;
    if (const string_view word = token.value.substr(at, end - at); is_dangerous(word))
      refuse(file, token.line, fmt::format("a text with the command '{}' in it cannot be checked", word));
    at = end + 1;
  }
}

void refuse_dangerous(const std::string& file, const std::vector<Token>& tokens) {
  const Token* print = nullptr;  // of whose statement this is
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (token.kind == Token::text) refuse_dangerous_text(file, token);
    if (print && i > 0 && tokens[i - 1].value == ")" && token.kind == Token::symbol && token.value == ">")
      refuse(file, print->line, fmt::format("'{} ... >' writes a file", print->value));
    if (token.kind == Token::symbol && token.value == ";") print = nullptr;
    if (token.kind != Token::word) continue;
    if (is_dangerous(token.value))
      refuse(file, token.line, fmt::format("'{}' runs commands or touches files outside the script", token.value));
    if (token.value == "Printf" || token.value == "Error" || token.value == "Warning") print = &token;
  }
}

std::vector<std::string> constants_of(const std::vector<Token>& tokens) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].kind != Token::word || tokens[i].value != "DefineConstant") continue;
    int depth = 0;
    bool expect_name = false;
    for (++i; i < tokens.size() && tokens[i].value != ";"; ++i) {
      const Token& token = tokens[i];
      const bool symbol = token.kind == Token::symbol;
      if (symbol && string_view("[({").find(token.value) != string_view::npos)
        expect_name = ++depth == 1;
      else if (symbol && string_view("])}").find(token.value) != string_view::npos)
        --depth;
      else if (symbol && token.value == "," && depth == 1)
        expect_name = true;
      else if (expect_name && token.kind == Token::word) {
        names.emplace_back(token.value);
        expect_name = false;
      }
    }
  }
  return names;
}

}  // namespace

GeoScript read_geo_script(const std::string& file, const std::string& script, bool trust) {
  if (script.find('\0') != std::string::npos || script.starts_with("\x1f\x8b"))
    throw InputError(fmt::format("{}: not a text file, expected a Gmsh script", file));
  const std::vector<Token> tokens = tokens_of(script);
  if (!trust) refuse_dangerous(file, tokens);
  return {constants_of(tokens)};
}

void check_parameters(const std::string& file, const GeoScript& script,
                      const std::map<std::string, double>& parameters) {
  for (const auto& [name, value] : parameters) {
    if (std::find(script.constants.begin(), script.constants.end(), name) != script.constants.end()) continue;
    if (script.constants.empty())
      throw InputError(fmt::format("{}: mesh parameter '{}', but the script has no DefineConstant", file, name));
    throw InputError(fmt::format("{}: unknown mesh parameter '{}' of the script's DefineConstant; {}", file, name,
                                 allowed_names(name, script.constants)));
  }
}

}  // namespace cobasis
