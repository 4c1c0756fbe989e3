#include "sdk/src/material/rice_code.h"

#include <algorithm>
#include <cstddef>

namespace nook::material {
namespace {

constexpr std::uint32_t max_quotient = 24;
constexpr int plain_bits = 26;

std::uint32_t folded(std::int32_t multiple) {
  return multiple >= 0 ? 2 * std::uint32_t(multiple) : 2 * std::uint32_t(-multiple) - 1;
}

std::int32_t unfolded(std::uint32_t n) {
  return n % 2 == 0 ? std::int32_t(n / 2) : -std::int32_t(n / 2) - 1;
}

std::size_t code_bits(std::uint32_t n, std::uint32_t k) {
  return n >> k < max_quotient ? (n >> k) + 1 + k : max_quotient + plain_bits;
}

}  // namespace

std::uint32_t best_k(std::span<const std::int32_t> multiples) {
  std::uint32_t best = 0;
  std::size_t fewest = SIZE_MAX;
  for (std::uint32_t k = 0; k < max_quotient; ++k) {
    std::size_t bits = 0;
    for (const std::int32_t multiple : multiples) bits += code_bits(folded(multiple), k);
    // The sum has a single minimum.
    if (bits >= fewest) break;
    fewest = bits;
    best = k;
  }
  return best;
}

void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k) {
  const std::uint32_t n = folded(multiple), quotient = std::min(n >> k, max_quotient);
  out.bits((1u << quotient) - 1, int(quotient));
  if (quotient == max_quotient) return out.bits(n, plain_bits);
  out.bits(0, 1);
  out.bits(n, int(k));
}

std::uint32_t read_k(ByteReader& in) {
  const std::uint32_t k = in.bits(k_bits);
  if (k >= max_quotient)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s holds a code out of range (got %u, need less than %u); bake the file again",
                  in.name(), k, max_quotient);
  return k;
}

std::int32_t read_multiple(ByteReader& in, std::uint32_t k) {
  std::uint32_t quotient = 0;
  while (quotient < max_quotient && in.bits(1)) ++quotient;
  return unfolded(quotient == max_quotient ? in.bits(plain_bits) : quotient << k | in.bits(int(k)));
}

}  // namespace nook::material
