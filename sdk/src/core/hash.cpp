#include "sdk/src/core/hash.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace nook {
namespace {

constexpr std::uint64_t prime1 = 0x9e3779b185ebca87, prime2 = 0xc2b2ae3d27d4eb4f, prime3 = 0x165667b19e3779f9,
                        prime4 = 0x85ebca77c2b2ae63, prime5 = 0x27d4eb2f165667c5;

// Reads a little-endian number.
template <typename Number>
std::uint64_t little(const std::byte* at) {
  Number value = 0;
  if constexpr (std::endian::native == std::endian::little)
    std::memcpy(&value, at, sizeof value);
  else
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = Number(value | std::to_integer<Number>(at[i]) << (8 * i));
  return value;
}

std::uint64_t mixed(std::uint64_t lane, std::uint64_t input) {
  return std::rotl(lane + input * prime2, 31) * prime1;
}

}  // namespace

Hash64::Hash64(std::uint64_t seed)
    : seed_(seed), lanes_{seed + prime1 + prime2, seed + prime2, seed, seed - prime1} {}

void Hash64::add_stripe(const std::byte* stripe) {
  for (std::size_t i = 0; i < 4; ++i) lanes_[i] = mixed(lanes_[i], little<std::uint64_t>(stripe + 8 * i));
}

void Hash64::add(std::span<const std::byte> bytes) {
  const std::size_t kept = size_ % stripe_size;
  size_ += bytes.size();
  if (kept > 0) {
    const std::size_t taken = std::min(stripe_size - kept, bytes.size());
    std::copy_n(bytes.begin(), taken, rest_.begin() + std::ptrdiff_t(kept));
    bytes = bytes.subspan(taken);
    if (kept + taken < stripe_size) return;
    add_stripe(rest_.data());
  }
  for (; bytes.size() >= stripe_size; bytes = bytes.subspan(stripe_size)) add_stripe(bytes.data());
  std::copy(bytes.begin(), bytes.end(), rest_.begin());
}

std::uint64_t Hash64::value() const {
  std::uint64_t hash = seed_ + prime5;
  if (size_ >= stripe_size) {
    hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) +
           std::rotl(lanes_[3], 18);
    for (const std::uint64_t lane : lanes_) hash = (hash ^ mixed(0, lane)) * prime1 + prime4;
  }
  hash += size_;

  const std::byte* at = rest_.data();
  std::size_t left = size_ % stripe_size;
  for (; left >= 8; at += 8, left -= 8)
    hash = std::rotl(hash ^ mixed(0, little<std::uint64_t>(at)), 27) * prime1 + prime4;
  if (left >= 4) {
    hash = std::rotl(hash ^ little<std::uint32_t>(at) * prime1, 23) * prime2 + prime3;
    at += 4;
    left -= 4;
  }
  for (; left > 0; ++at, --left)
    hash = std::rotl(hash ^ std::to_integer<std::uint64_t>(*at) * prime5, 11) * prime1;

  hash = (hash ^ hash >> 33) * prime2;
  hash = (hash ^ hash >> 29) * prime3;
  return hash ^ hash >> 32;
}

std::uint64_t hash64(std::span<const std::byte> bytes, std::uint64_t seed) {
  Hash64 hash(seed);
  hash.add(bytes);
  return hash.value();
}

}  // namespace nook
