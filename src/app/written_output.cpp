#include "app/written_output.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "math/errors.hpp"

namespace cobasis {
namespace {

template <class T>
bool read(std::string_view word, T& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// Away from the front, without the blank behind it.
std::string_view take_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

bool is_file_in(std::string_view path, std::string_view folder) {
  if (!path.starts_with(folder)) return false;
  const std::string_view name = path.substr(folder.size());
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos;
}

}  // namespace

std::string text_of(const std::vector<WrittenOutput>& written) {
  std::string text;
  for (const WrittenOutput& it : written)
    text += it.is_rows() ? fmt::format("{} {} {} {}\n", it.kind, it.which, it.size, it.checksum)
                         : fmt::format("{} {} {} {}\n", it.kind, it.which, it.time, it.file);
  return text;
}

std::vector<WrittenOutput> written_output(const std::string& text, const OutputCounts& counts) {
  struct Kind {
    std::size_t count;
    const char* folder;  // null: a table
  };
  const std::map<std::string, Kind, std::less<>> kinds{{"fields", {1, "fields/"}},
                                                       {"slice", {counts.slices, "slices/"}},
                                                       {"line", {counts.lines, "lines/"}},
                                                       {"history", {1, nullptr}},
                                                       {"probe", {counts.probes, nullptr}}};
  std::vector<WrittenOutput> written;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::string_view rest = line;
    WrittenOutput it;
    const auto kind = kinds.find(take_word(rest));
    bool right = kind != kinds.end() && read(take_word(rest), it.which) && it.which < kind->second.count;
    if (right) {
      it.kind = kind->first;
      const std::string_view first = take_word(rest);
      if (it.is_rows()) {
        right = read(first, it.size) && it.size >= 0 && read(rest, it.checksum);
      } else {
        it.file = rest;
        right = read(first, it.time) && std::isfinite(it.time) && is_file_in(rest, kind->second.folder);
      }
    }
    if (!right)
      throw SystemError(fmt::format("the checkpoint's list of output is not that of this case: found '{}'", line));
    written.push_back(std::move(it));
  }
  return written;
}

}  // namespace cobasis
