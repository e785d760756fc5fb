// Files that are whole or not there: a reader, or a full disk, never meets half of one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/checksum.hpp"

namespace cobasis {

/// Replaces the file by these bytes, on disk when it returns. Throws SystemError with path and reason and then leaves
/// the former file as it was.
void write_atomically(const std::string& path, std::string_view bytes);

/// The same for a file that lies at path + ".part" and waits for its first bytes.
void finish_atomically(const std::string& path, std::string_view first_bytes);

/// Creates the directory and its parents and makes sure that files can be created in it. Throws SystemError.
void make_writable_directory(const std::string& path, const std::string& probe_name);

/// The same for a folder inside the output directory, which must be one itself: no link leads a run out of there.
void make_writable_folder(const std::string& path, const std::string& probe_name);

/// Takes a symbolic link away, so that what is written does not go where it leads.
void remove_link(const std::string& path);

/// A table that grows by whole rows. Throws SystemError with path and reason; a row that fails leaves no part of it.
class RowFile {
 public:
  RowFile(const std::string& path, std::string_view header);
  /// Goes on behind the first `size` bytes, which must have this checksum; what follows them is cut off. Throws
  /// InputError where they have not.
  RowFile(const std::string& path, std::int64_t size, std::uint64_t checksum);
  ~RowFile();
  RowFile(RowFile&& other) noexcept;
  RowFile& operator=(RowFile&&) = delete;

  void append(std::string_view row);
  void flush();  ///< on disk when it returns
  void close();  ///< likewise
  std::int64_t size() const { return size_; }
  std::uint64_t checksum() const { return checksum_.value(); }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;  ///< [bytes]
  Checksum checksum_;
};

}  // namespace cobasis
