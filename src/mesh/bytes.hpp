// Vectors and numbers to bytes and back, in the machine's own representation: between processes of one run.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace cobasis {

class ByteWriter {
 public:
  std::vector<char> bytes;

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T& value) { append(&value, sizeof(T)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const std::vector<T>& values) {
    (*this)(values.size());
    append(values.data(), values.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    append(text.data(), text.size());
  }
  void operator()(const std::vector<std::string>& texts) {
    (*this)(texts.size());
    for (const std::string& text : texts) (*this)(text);
  }

 private:
  void append(const void* data, std::size_t size) {
    const char* const first = static_cast<const char*>(data);
    bytes.insert(bytes.end(), first, first + size);
  }
};

/// Reads what a ByteWriter wrote, in the same order. Throws std::out_of_range when the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(const std::vector<char>& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { take(&value, sizeof(T)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    take(values.data(), values.size() * sizeof(T));
  }
  void operator()(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size());
  }
  void operator()(std::vector<std::string>& texts) {
    texts.resize(count(1));
    for (std::string& text : texts) (*this)(text);
  }

 private:
  std::size_t count(std::size_t value_size) {
    std::size_t n = 0;
    (*this)(n);
    if (n > (bytes_.size() - at_) / value_size) throw std::out_of_range("message too short");
    return n;
  }
  void take(void* data, std::size_t size) {
    if (size > bytes_.size() - at_) throw std::out_of_range("message too short");
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }

  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

}  // namespace cobasis
