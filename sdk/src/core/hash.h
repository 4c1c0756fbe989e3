// The 64-bit hash XXH64, written from its specification (github.com/Cyan4973/xxHash, doc/xxhash_spec.md).
// Checksums of .nook files and fingerprints of sources use this hash, so it must never change.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nook {

// Hashes bytes that are added in pieces. The result does not depend on how the bytes are divided into pieces.
class Hash64 {
 public:
  explicit Hash64(std::uint64_t seed = 0);
  void add(std::span<const std::byte> bytes);
  // Returns the hash of all bytes so far. You may add more bytes afterwards.
  std::uint64_t value() const;

 private:
  static constexpr std::size_t stripe_size = 32;
  void add_stripe(const std::byte* stripe);

  std::uint64_t seed_;
  std::array<std::uint64_t, 4> lanes_;
  std::uint64_t size_ = 0;                     // number of bytes so far
  std::array<std::byte, stripe_size> rest_{};  // the last size_ % stripe_size bytes
};

std::uint64_t hash64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace nook
