// CRC-64 (the polynomial of ECMA-182, as in xz): finds every damage within 64 bits, and any other but one in 2^64.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cobasis {

class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = table()[(value_ ^ static_cast<unsigned char>(c)) & 0xff] ^ (value_ >> 8);
  }
  std::uint64_t value() const { return ~value_; }

 private:
  static const std::array<std::uint64_t, 256>& table() {
    static const std::array<std::uint64_t, 256> table = [] {
      std::array<std::uint64_t, 256> entries{};
      for (std::uint64_t i = 0; i < 256; ++i) {
        std::uint64_t entry = i;
        for (int bit = 0; bit < 8; ++bit) entry = (entry >> 1) ^ (entry & 1 ? 0xC96C5795D7870F42ull : 0);
        entries[i] = entry;
      }
      return entries;
    }();
    return table;
  }
  std::uint64_t value_ = ~std::uint64_t{0};
};

}  // namespace cobasis
