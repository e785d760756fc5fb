#include "app/checkpoint_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "app/atomic_file.hpp"
#include "app/checksum.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

constexpr std::size_t head_size = 512;  // the smallest that HDF5 leaves to its users
constexpr int format_version = 1;

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// Before its first use: HDF5 says nothing by itself, and does not try again at exit what has failed.
void prepare_library() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(prepared);
}

/// What the system said, found among what HDF5 says about its last failure; else HDF5's own innermost words.
std::string reason_of_failure() {
  std::string reason;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
        auto& found = *static_cast<std::string*>(data);
        const std::string words = error->desc ? error->desc : "";
        const std::string mark = "error message = '";
        if (const auto at = words.find(mark); at != std::string::npos)
          found = words.substr(at + mark.size(), words.find('\'', at + mark.size()) - at - mark.size());
        else if (found.empty())
          found = words;
        return 0;
      },
      &reason);
  return reason.empty() ? "HDF5 failed" : reason;
}

std::string head_of(std::uint64_t size, std::uint64_t checksum) {
  std::string text = fmt::format("Cobasis checkpoint, format {}\nHDF5 from byte {} on: {} bytes, CRC-64/XZ {:016x}\n",
                                 format_version, head_size, size, checksum);
  text.resize(head_size, '\n');
  return text;
}

struct Content {
  std::uint64_t size = 0, checksum = 0;
};

/// Of what follows the head. Throws SystemError.
Content content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SystemError(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
  file.seekg(head_size);
  Content content;
  Checksum checksum;
  std::vector<char> block(1 << 20);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto n = static_cast<std::size_t>(file.gcount());
    checksum.add({block.data(), n});
    content.size += n;
  }
  if (file.bad()) throw SystemError(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
  content.checksum = checksum.value();
  return content;
}

}  // namespace

CheckpointFileWriter::CheckpointFileWriter(std::string path) : path_(std::move(path)), part_(path_ + ".part") {
  prepare_library();
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, head_size);
  H5Pset_obj_track_times(creation, false);
  file_ = H5Fcreate(part_.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  const std::string reason = file_ >= 0 ? std::string() : reason_of_failure();
  H5Pclose(creation);
  if (file_ < 0) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw SystemError(fmt::format("cannot write '{}': {}", path_, reason));
  }
  values_ = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(values_, false);
}

CheckpointFileWriter::~CheckpointFileWriter() {
  if (values_ >= 0) H5Pclose(values_);
  if (file_ >= 0) H5Fclose(file_);
  std::error_code ignored;
  if (!part_.empty()) std::filesystem::remove(part_, ignored);
}

void CheckpointFileWriter::write(const std::string& name, std::span<const double> values, std::size_t columns) {
  const std::array<hsize_t, 2> sizes{columns > 0 ? values.size() / columns : 0, columns};
  const hid_t space = H5Screate_simple(columns == 1 ? 1 : 2, sizes.data(), nullptr);
  const hid_t set = H5Dcreate2(file_, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, values_, H5P_DEFAULT);
  const bool written = set >= 0 && (values.empty() || H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                                               values.data()) >= 0);
  const std::string reason = written ? std::string() : reason_of_failure();
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  if (!written) throw SystemError(fmt::format("cannot write '{}': {}", path_, reason));
}

void CheckpointFileWriter::write(const std::string& name, const std::string& text) {
  const hsize_t size = text.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t set = H5Dcreate2(file_, name.c_str(), H5T_STD_U8LE, space, H5P_DEFAULT, values_, H5P_DEFAULT);
  const bool written =
      set >= 0 && (text.empty() || H5Dwrite(set, H5T_NATIVE_UCHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0);
  const std::string reason = written ? std::string() : reason_of_failure();
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  if (!written) throw SystemError(fmt::format("cannot write '{}': {}", path_, reason));
}

void CheckpointFileWriter::finish() {
  const bool closed = H5Fclose(std::exchange(file_, -1)) >= 0;
  if (!closed) throw SystemError(fmt::format("cannot write '{}': {}", path_, reason_of_failure()));
  const Content content = content_of(part_);
  finish_atomically(path_, head_of(content.size, content.checksum));
  part_.clear();
}

std::string what_is_wrong_with_checkpoint(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(head_size, '\0');
  if (!file.read(head.data(), head_size)) return "it is cut off, or cannot be read";
  const std::string first = fmt::format("Cobasis checkpoint, format {}\n", format_version);
  const std::string any = first.substr(0, first.find_last_of(' ') + 1);
  if (head.starts_with(any) && !head.starts_with(first))
    return fmt::format("it has format {}; this program reads {}", head.substr(any.size(), head.find('\n') - any.size()),
                       format_version);
  const Content content = content_of(path);
  if (head != head_of(content.size, content.checksum)) return "its checksum is not that of its content";
  return {};
}

CheckpointFileReader::CheckpointFileReader(std::string path) : path_(std::move(path)) {
  prepare_library();
  file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw SystemError(fmt::format("cannot read '{}': {}", path_, reason_of_failure()));
}

CheckpointFileReader::~CheckpointFileReader() { H5Fclose(file_); }

namespace {

/// All elements of a dataset as `type` in memory.
template <class T>
void read_set(hid_t file, const std::string& path, const std::string& name, hid_t type, T& values) {
  const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  hssize_t size = -1;
  if (set >= 0) {
    const hid_t space = H5Dget_space(set);
    size = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
  }
  bool read = size >= 0;
  if (size > 0) {
    values.resize(static_cast<std::size_t>(size));
    read = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
  }
  const std::string reason = read ? std::string() : reason_of_failure();
  if (set >= 0) H5Dclose(set);
  if (!read) throw SystemError(fmt::format("cannot read '{}' in '{}': {}", name, path, reason));
}

}  // namespace

std::vector<double> CheckpointFileReader::read(const std::string& name) const {
  std::vector<double> values;
  read_set(file_, path_, name, H5T_NATIVE_DOUBLE, values);
  return values;
}

std::string CheckpointFileReader::read_text(const std::string& name) const {
  std::string text;
  read_set(file_, path_, name, H5T_NATIVE_UCHAR, text);
  return text;
}

}  // namespace cobasis
