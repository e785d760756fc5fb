// What a run has written so far, for the run that goes on with it; and what lies there of others.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "app/output.hpp"
#include "app/tables.hpp"
#include "app/written_output.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

/// Takes the prefix and the digits behind it away; nothing if the text does not start like this.
std::optional<std::size_t> take_number(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  std::size_t number = 0;
  const char* const first = text.data() + prefix.size();
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
  if (error != std::errc() || end == first) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

template <class Condition>
void remove_files(const std::filesystem::path& directory, const Condition& condition) {
  std::error_code ignored;  // what cannot be removed is in nobody's way
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    if (condition(entry.path().filename().string())) files.push_back(entry.path());
  }
  for (const auto& file : files) std::filesystem::remove(file, ignored);
}

}  // namespace

std::string Output::written() const {
  std::vector<WrittenOutput> all;
  const auto add = [&](const char* kind, std::size_t which, const auto& files) {
    for (const auto& [time, file] : files) all.push_back({.kind = kind, .which = which, .time = time, .file = file});
  };
  const auto add_rows = [&](const char* kind, std::size_t which, const RowFile& rows) {
    all.push_back({.kind = kind, .which = which, .size = rows.size(), .checksum = rows.checksum()});
  };
  add("fields", 0, fields_.files);
  for (std::size_t i = 0; i < slices_.size(); ++i) add("slice", i, slices_[i].series.files);
  for (std::size_t i = 0; i < lines_.size(); ++i) add("line", i, lines_[i].files);
  if (history_) add_rows("history", 0, *history_);
  for (std::size_t i = 0; i < probes_.size(); ++i)
    if (probes_[i].rows) add_rows("probe", i, *probes_[i].rows);
  return text_of(all);
}

void Output::keep(Keeper& keeper) {
  std::string text;
  if (!keeper.reads()) {
    together([&] {
      if (history_) history_->flush();
      for (Table& probe : probes_)
        if (probe.rows) probe.rows->flush();
      text = written();
    });
  }
  keeper.text("output", text);
  if (!keeper.reads()) return;
  std::string mistake;
  try {
    together([&] {
      try {
        go_on_after(text);
      } catch (const InputError& error) {
        mistake = error.what();
      }
    });
    throw_together(mpi_, mistake);
  } catch (const SystemError& error) {
    if (mpi_.any(!mistake.empty())) throw InputError(error.what());
    throw;
  }
}

void Output::go_on_after(const std::string& written) {
  for (const WrittenOutput& it : written_output(written, {slices_.size(), lines_.size(), probes_.size()})) {
    if (it.kind == "fields") fields_.files.emplace_back(it.time, it.file);
    if (it.kind == "slice") slices_[it.which].series.files.emplace_back(it.time, it.file);
    if (it.kind == "line") lines_[it.which].files.emplace_back(it.time, it.file);
    if (!it.is_rows() || !mpi_.root()) continue;
    const bool history = it.kind == "history";
    (history ? history_ : probes_[it.which].rows)
        .emplace(path(history ? "history.csv" : probes_[it.which].name + ".csv"), it.size, it.checksum);
  }
  if (!mpi_.root()) return;
  const auto resume = [&](const Series& series) {
    for (const auto& [time, file] : series.files)
      if (!std::filesystem::exists(path(file)))
        throw InputError(fmt::format("{}: the fields that the run has written there are missing", path(file)));
    if (!series.files.empty()) write_atomically(path(series.name + ".pvd"), pvd(series.files));
    remove_files_from(series, series.files.size(), std::numeric_limits<int>::max());
  };
  resume(fields_);
  for (const Slice& slice : slices_) resume(slice.series);
  for (const Table& line : lines_) {
    remove_files_from(line, line.files.size());
    if (!line.files.empty()) write_list_of(line);
  }
}

void Output::remove_files_from(const Series& series, std::size_t number, int rank_of_first) const {
  remove_files(path(series.folder), [&](const std::string& name) {
    std::string_view rest = name;
    const auto output = take_number(rest, series.name + "_");
    if (!output) return false;
    const bool joined = rest == ".pvtu";
    const auto rank = joined ? std::nullopt : take_number(rest, "_");
    if (!joined && rank && rest == ".vtu.part") return true;  // of a run that was killed
    if (!joined && (!rank || rest != ".vtu")) return false;
    if (*output >= number) return true;
    return *output == 0 && rank && static_cast<int>(*rank) >= rank_of_first;
  });
}

void Output::remove_files_from(const Table& line, std::size_t number) const {
  remove_files(path("lines"), [&](const std::string& name) {
    std::string_view rest = name;
    const auto output = take_number(rest, line.name + "_");
    return output && rest == ".csv" && *output >= number;
  });
}

}  // namespace cobasis
