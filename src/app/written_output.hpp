// What a run had written when a checkpoint was made, as a text that goes into it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cobasis {

/// A file of a series, or the rows of a table.
struct WrittenOutput {
  std::string kind;       ///< fields, slice, line: files; history, probe: rows
  std::size_t which = 0;  ///< of those of the kind
  double time = 0;        ///< of a file [s]
  std::string file = {};  ///< relative to the output directory, in the folder of its kind
  std::int64_t size = 0;  ///< of rows [bytes]
  std::uint64_t checksum = 0;

  bool is_rows() const { return kind == "history" || kind == "probe"; }
};

struct OutputCounts {
  std::size_t slices = 0, lines = 0, probes = 0;
};

/// A line each: kind, which, and time and file or size and checksum.
std::string text_of(const std::vector<WrittenOutput>& written);

/// The reverse, for a run with so many slices, lines and probes. Throws SystemError for a text that such a run has not
/// written: a checkpoint may be anybody's, and no path may lead out of the output directory.
std::vector<WrittenOutput> written_output(const std::string& text, const OutputCounts& counts);

}  // namespace cobasis
