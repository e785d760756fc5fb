// What the fuzz targets share. A target is a function of bytes; libFuzzer (tools/fuzz) makes them up, the ordinary test
// run feeds it the corpus (driver.cpp). Whatever the bytes are: no crash, no leak, no second per input, and no
// exception but those that the user is told of.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace cobasis {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Stops the program where a claim does not hold, which fuzzer and test take for a find.
inline void claim(bool holds) {
  if (!holds) __builtin_trap();
}

/// Numbers from the front of the input, zeros behind its end.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }
  template <class T>
  T take() {
    T value{};
    const std::size_t n = sizeof(T) < size_ ? sizeof(T) : size_;
    if (n > 0) std::memcpy(&value, data_, n);
    data_ += n;
    size_ -= n;
    return value;
  }
  int below(int n) { return take<std::uint8_t>() % n; }
  /// Mostly a multiple of 1/4, at times any double.
  double coordinate() {
    const auto x = take<std::int8_t>();
    return x == -128 ? take<double>() : x / 4.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// A folder in memory, where the system has such, for the time of the process.
class Scratch {
 public:
  Scratch() {
    std::error_code none;
    std::string name = std::filesystem::is_directory("/dev/shm", none) ? "/dev/shm" : "/tmp";
    name += "/cobasis_fuzz_XXXXXX";
    claim(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Scratch() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  /// The path of a file with these bytes.
  std::string write(const std::string& name, std::string_view bytes) const;

 private:
  std::string path_;
};

}  // namespace cobasis
