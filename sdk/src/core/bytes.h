// Writes little-endian bytes and packed bits to a vector, and reads them back. Reading past the end throws.
// The bytes do not depend on the byte order of the machine.
#pragma once

#include <nook/nook.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook {

class ByteWriter {
 public:
  void u8(std::uint32_t value) { bytes_.push_back(std::byte(value)); }
  void u16(std::uint32_t value) { little(value, 2); }
  void u32(std::uint32_t value) { little(value, 4); }
  void u64(std::uint64_t value) { little(value, 8); }
  void f32(float value) { u32(bit_cast<std::uint32_t>(value)); }
  // Writes seven bits of the value per byte, the lowest first. The top bit of a byte is set if more bytes
  // follow.
  void varint(std::uint32_t value) {
    for (; value >= 128; value >>= 7) u8(value | 128);
    u8(value);
  }
  void text(std::string_view value) {
    for (const char c : value) u8(static_cast<unsigned char>(c));
  }

  // Writes packed bits, low bits first. Call align() before you write bytes again.
  void bits(std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) {
      if (used_bits_ == 0) bytes_.push_back(std::byte{0});
      bytes_.back() |= std::byte(((value >> i) & 1u) << used_bits_);
      used_bits_ = (used_bits_ + 1) % 8;
    }
  }
  void align() { used_bits_ = 0; }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void little(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) u8(static_cast<std::uint32_t>(value >> (8 * i)) & 255u);
  }

  std::vector<std::byte> bytes_;
  int used_bits_ = 0;
};

class ByteReader {
 public:
  // Error messages contain `name`, which must outlive the reader.
  ByteReader(std::span<const std::byte> bytes, const char* name) : bytes_(bytes), name_(name) {}

  const char* name() const { return name_; }
  std::size_t remaining() const { return bytes_.size() - at_; }
  std::uint32_t u8() { return static_cast<std::uint32_t>(little(1)); }
  std::uint32_t u16() { return static_cast<std::uint32_t>(little(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little(4)); }
  std::uint64_t u64() { return little(8); }
  float f32() { return bit_cast<float>(u32()); }
  std::uint32_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint32_t byte = u8();
      value |= std::uint64_t(byte & 127u) << shift;
      if (byte < 128 && value <= UINT32_MAX) return static_cast<std::uint32_t>(value);
    }
    throw Failure(NOOK_ERROR_BAD_FILE, "section %s holds a number of more than 32 bits; bake the file again",
                  name_);
  }
  std::string_view text(std::size_t size) {
    need(size);
    const auto* first = reinterpret_cast<const char*>(bytes_.data() + at_);
    at_ += size;
    return {first, size};
  }

  std::uint32_t bits(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count;) {
      if (left_bits_ == 0) {
        current_ = u8();
        left_bits_ = 8;
      }
      const int take = left_bits_ < count - i ? left_bits_ : count - i;
      value |= (current_ & ((1u << take) - 1)) << i;
      current_ >>= take;
      left_bits_ -= take;
      i += take;
    }
    return value;
  }
  void align() { left_bits_ = 0; }

  // Throws if the rest of the section cannot hold `count` items. Call it before you allocate memory for the
  // items.
  std::uint32_t check_count(std::uint32_t count, std::size_t bits_each, const char* what) const {
    if (count > remaining() * 8 / bits_each)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s is too short for its %s (got %zu bytes for %u); bake the file again", name_,
                    what, remaining(), count);
    return count;
  }
  void check_end() const {
    if (remaining())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s is too long (%zu bytes are left over); bake the file again", name_,
                    remaining());
  }

 private:
  void need(std::size_t size) const {
    if (size > remaining())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s ends early (got %zu more bytes, need %zu); bake the file again", name_,
                    remaining(), size);
  }
  std::uint64_t little(int count) {
    need(static_cast<std::size_t>(count));
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i)
      value |= std::uint64_t(std::to_integer<unsigned>(bytes_[at_ + i])) << (8 * i);
    at_ += static_cast<std::size_t>(count);
    return value;
  }

  std::span<const std::byte> bytes_;
  const char* name_;
  std::size_t at_ = 0;
  std::uint32_t current_ = 0;
  int left_bits_ = 0;
};

// Returns the number of bits that are needed for any index below `count`.
constexpr int index_bits(std::size_t count) {
  return count > 1 ? std::bit_width(count - 1) : 0;
}

}  // namespace nook
