// A fixed-size array of plain values on a 64-byte boundary, so that SIMD loads never straddle cache lines.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "sdk/src/core/memory.h"

namespace nook {

template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  static constexpr std::size_t alignment = 64;

  AlignedArray() = default;
  // Sets all bytes to zero.
  AlignedArray(std::size_t count, Memory* memory) : memory_(memory), size_(count) {
    if (count == 0) return;
    data_ = static_cast<T*>(memory->allocate(count * sizeof(T), alignment));
    std::memset(static_cast<void*>(data_), 0, count * sizeof(T));
  }
  AlignedArray(AlignedArray&& other) noexcept { swap(other); }
  AlignedArray& operator=(AlignedArray&& other) noexcept {
    AlignedArray old(std::move(other));
    swap(old);
    return *this;
  }
  ~AlignedArray() {
    if (data_) memory_->deallocate(data_, size_ * sizeof(T), alignment);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  void swap(AlignedArray& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  Memory* memory_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

// Arrays for SIMD loops are padded to a multiple of this many floats, which is one AVX-512 register.
inline constexpr std::size_t simd_width = 16;
constexpr std::size_t padded_count(std::size_t count) {
  return (count + simd_width - 1) / simd_width * simd_width;
}

}  // namespace nook
