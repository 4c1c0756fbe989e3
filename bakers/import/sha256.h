// SHA-256, written from FIPS 180-4. Keys of bakes and checksums of a cache use it, because two different
// inputs must never share a key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nook::bake {

// Hashes bytes that are passed in pieces. The hash does not depend on the sizes of the pieces.
class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  // Returns 64 hexadecimal digits. Call it once, after the last piece.
  std::string hex();

 private:
  static constexpr std::size_t block_size = 64;
  void add_block(const std::byte* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::uint64_t size_ = 0;                    // number of bytes so far
  std::array<std::byte, block_size> rest_{};  // the last size_ % block_size bytes
};

std::string sha256(std::span<const std::byte> bytes);
std::string sha256(std::string_view text);

}  // namespace nook::bake
