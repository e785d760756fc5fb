#include "app/checkpoint_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>

#include "app/atomic_file.hpp"
#include "app/checksum.hpp"
#include "math/errors.hpp"
#include "mesh/child_process.hpp"

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
  remove_link(part_);
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

namespace {

/// In a child process, since the file may be anybody's: HDF5 crashes on some files, and may ask for any memory.
std::vector<char> open_in_child(const std::string& path, const std::function<std::vector<char>(hid_t file)>& work,
                                const std::string& what) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  ChildLimits limits;
  limits.no_side_effects = true;
  limits.extra_memory = (std::size_t{1} << 30) + 3 * (none ? 0 : size);
  ChildResult result = run_in_child(
      [&] {
        prepare_library();
        H5PLset_loading_state(0);  // no code from elsewhere to decode what we never encode
        const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
        if (file < 0) throw SystemError(reason_of_failure());
        return work(file);
      },
      limits);
  if (!result.error.empty()) throw SystemError(fmt::format("cannot read {}'{}': {}", what, path, result.error));
  return std::move(result.bytes);
}

/// All elements of a dataset that lies in the file as CheckpointFileWriter puts it there: no link to another file, not
/// packed, and not larger than the file.
std::vector<char> read_set(hid_t file, const std::string& name, hid_t stored, hid_t in_memory, std::size_t value_size) {
  H5L_info_t link{};
  if (H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0) throw SystemError("there is none");
  const hid_t set = link.type == H5L_TYPE_HARD ? H5Dopen2(file, name.c_str(), H5P_DEFAULT) : -1;
  if (set < 0) throw SystemError("it is no array of this file");
  const hid_t space = H5Dget_space(set), type = H5Dget_type(set), creation = H5Dget_create_plist(set);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  hsize_t size = 0;
  H5Fget_filesize(file, &size);
  if (n < 0 || H5Tequal(type, stored) <= 0 || H5Pget_layout(creation) != H5D_CONTIGUOUS ||
      H5Pget_nfilters(creation) != 0 || H5Pget_external_count(creation) != 0)
    throw SystemError("it is not as this program writes it");
  if (static_cast<hsize_t>(n) > size / value_size)
    throw SystemError(fmt::format("{} values, more than a file of {} bytes can hold", n, size));
  std::vector<char> bytes(static_cast<std::size_t>(n) * value_size);
  if (n > 0 && H5Dread(set, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw SystemError(reason_of_failure());
  return bytes;
}

}  // namespace

CheckpointFileReader::CheckpointFileReader(std::string path) : path_(std::move(path)) {
  open_in_child(
      path_, [](hid_t) { return std::vector<char>(); }, "");
}

std::vector<double> CheckpointFileReader::read(const std::string& name) const {
  const std::vector<char> bytes = open_in_child(
      path_, [&](hid_t file) { return read_set(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double)); },
      fmt::format("'{}' in ", name));
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

std::string CheckpointFileReader::read_text(const std::string& name) const {
  const std::vector<char> bytes = open_in_child(
      path_, [&](hid_t file) { return read_set(file, name, H5T_STD_U8LE, H5T_NATIVE_UCHAR, 1); },
      fmt::format("'{}' in ", name));
  return {bytes.begin(), bytes.end()};
}

}  // namespace cobasis
