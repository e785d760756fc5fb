// A checkpoint on disk: an HDF5 file behind 512 bytes of text that hold its size and its checksum. The only door to
// HDF5.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cobasis {

/// Written beside its place, and moved there once it is whole and on disk. All members throw SystemError with path and
/// reason; then, and if the file is never finished, nothing remains of it.
class CheckpointFileWriter {
 public:
  explicit CheckpointFileWriter(std::string path);
  ~CheckpointFileWriter();
  CheckpointFileWriter(const CheckpointFileWriter&) = delete;
  CheckpointFileWriter& operator=(const CheckpointFileWriter&) = delete;

  /// Columns > 1: rows of so many.
  void write(const std::string& name, std::span<const double> values, std::size_t columns = 1);
  void write(const std::string& name, const std::string& text);
  void finish();

 private:
  std::string path_, part_;
  std::int64_t file_ = -1, values_ = -1;
};

/// Why the file is none that this program can read, in words; empty: it is whole.
std::string what_is_wrong_with_checkpoint(const std::string& path);

/// Of a file that is anybody's. Every member throws SystemError with path and reason, also where there is no such
/// entry, or one that CheckpointFileWriter has not written.
class CheckpointFileReader {
 public:
  explicit CheckpointFileReader(std::string path);

  std::vector<double> read(const std::string& name) const;
  std::string read_text(const std::string& name) const;

 private:
  std::string path_;
};

}  // namespace cobasis
