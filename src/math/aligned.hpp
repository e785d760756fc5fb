// Arrays for sweeps: aligned to cache lines, and raw memory that costs nothing until it is touched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

namespace cobasis {

inline constexpr std::size_t cache_line = 64;

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{cache_line})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{cache_line}); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// Storage for n doubles, at first 0; pages are taken from the system when they are first written.
class RawStorage {
 public:
  RawStorage() = default;
  explicit RawStorage(std::size_t n) {
    if (n == 0) return;
    std::size_t size = n * sizeof(double) + 2 * cache_line;
    block_.reset(std::calloc(size, 1));
    if (!block_) throw std::bad_alloc();
    void* at = block_.get();
    data_ = static_cast<double*>(std::align(cache_line, n * sizeof(double), at, size));
  }
  double* data() { return data_; }
  const double* data() const { return data_; }

 private:
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::unique_ptr<void, Free> block_;
  double* data_ = nullptr;
};

/// A list of fixed capacity with room for a pack beyond its end. What lies there is 0 at first, or an entry of before.
template <class T>
class CompactList {
 public:
  CompactList() = default;
  explicit CompactList(std::size_t capacity) : storage_((capacity + slack) * sizeof(T) / sizeof(double) + 1) {}

  std::int32_t size() const { return size_; }
  T* data() { return reinterpret_cast<T*>(storage_.data()); }
  const T* data() const { return reinterpret_cast<const T*>(storage_.data()); }
  T& operator[](std::int32_t i) { return data()[i]; }
  const T& operator[](std::int32_t i) const { return data()[i]; }
  T* end() { return data() + size_; }
  std::span<const T> span() const { return {data(), static_cast<std::size_t>(size_)}; }
  void clear() { size_ = 0; }
  void cut(std::int32_t n) { size_ = n; }  ///< keeps the first n
  void push(const T& value) { data()[size_++] = value; }
  void grow(std::int32_t n) { size_ += n; }  ///< by what was written at end()
  /// Repeats the last entry up to a multiple of `width`.
  void fill(int width) {
    while (size_ % width != 0) push(data()[size_ - 1]);
  }

 private:
  static constexpr std::size_t slack = 64;
  RawStorage storage_;
  std::int32_t size_ = 0;
};

}  // namespace cobasis
