#include "app/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "math/errors.hpp"

namespace cobasis {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw SystemError(fmt::format("cannot write '{}': {}", path, std::strerror(error)));
}

/// 0 or the error's number.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Makes the names in the directory of a file last through a power failure; some file systems cannot and say so.
void sync_directory_of(const std::string& path) {
  const std::string directory = std::filesystem::path(path).parent_path().string();
  const int descriptor = ::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void write_part(const std::string& path, std::string_view bytes, int flags) {
  const std::string part = path + ".part";
  remove_link(part);
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
  if (descriptor < 0) fail(path, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(part.c_str());
    fail(path, error);
  }
  sync_directory_of(path);
}

}  // namespace

void write_atomically(const std::string& path, std::string_view bytes) { write_part(path, bytes, O_CREAT | O_TRUNC); }

void finish_atomically(const std::string& path, std::string_view first_bytes) { write_part(path, first_bytes, 0); }

void remove_link(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_symlink(path, none)) std::filesystem::remove(path, none);
}

void make_writable_folder(const std::string& path, const std::string& probe_name) {
  std::error_code none;
  if (std::filesystem::is_symlink(path, none))
    throw SystemError(
        fmt::format("'{}' is a link, which may lead anywhere; allowed: a directory, in one that may be a link", path));
  make_writable_directory(path, probe_name);
}

void make_writable_directory(const std::string& path, const std::string& probe_name) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw SystemError(fmt::format("cannot create directory '{}': {}", path, error.message()));
  const std::string probe = (std::filesystem::path(path) / probe_name).string();
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno != EEXIST) {
    throw SystemError(fmt::format("cannot write into directory '{}': {}", path, std::strerror(errno)));
  }
  if (descriptor < 0) return;
  ::close(descriptor);
  ::unlink(probe.c_str());
}

RowFile::RowFile(const std::string& path, std::string_view header) : path_(path) {
  write_atomically(path, header);
  size_ = static_cast<std::int64_t>(header.size());
  checksum_.add(header);
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor_ < 0) fail(path_, errno);
}

RowFile::RowFile(const std::string& path, std::int64_t size, std::uint64_t checksum) : path_(path), size_(size) {
  std::ifstream file(path, std::ios::binary);
  std::error_code none;
  const bool has_all = std::filesystem::file_size(path, none) >= static_cast<std::uintmax_t>(size) && !none;
  std::string rows(has_all ? static_cast<std::size_t>(size) : 0, '\0');
  if (!has_all || !file.read(rows.data(), size))
    throw InputError(
        fmt::format("{}: this table of the run is missing or was cut off: its first {} bytes are needed", path, size));
  checksum_.add(rows);
  if (checksum_.value() != checksum)
    throw InputError(fmt::format("{}: this table of the run has been changed in its first {} bytes", path, size));
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, size) != 0) fail(path_, errno);
}

RowFile::RowFile(RowFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      checksum_(other.checksum_) {}

RowFile::~RowFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RowFile::append(std::string_view row) {
  if (const int error = write_all(descriptor_, row)) {
    // Should the part not go away either, the message below already says that the table is broken.
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, size_);
    fail(path_, error);
  }
  size_ += static_cast<std::int64_t>(row.size());
  checksum_.add(row);
}

void RowFile::flush() {
  if (::fsync(descriptor_) != 0) fail(path_, errno);
}

void RowFile::close() {
  if (descriptor_ < 0) return;
  const int error = ::fsync(descriptor_) == 0 ? 0 : errno;
  const int closed = ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
  if (error || closed) fail(path_, error ? error : closed);
}

}  // namespace cobasis
