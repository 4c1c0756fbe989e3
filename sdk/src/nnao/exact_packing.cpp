#include "sdk/src/nnao/exact_packing.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/floats.h"

namespace nook::nnao {
namespace {

constexpr Normalisation normalisations[] = {Normalisation::division, Normalisation::product,
                                            Normalisation::wide_product};
// exact_packing tries the formats in this order, smallest first.
constexpr std::uint8_t packed_bits[] = {8, 10, packed_as_halves.bits, 16, 24};

constexpr bool is_normalised(ExactPacking packing) {
  return packing != packed_as_floats && packing.bits != packed_as_halves.bits;
}

constexpr double largest_of(ExactPacking packing) {
  return double((1u << packing.bits) - 1);
}

// Returns 0 for values outside [0, 1] and for NaN.
std::uint32_t to_integer(float value, ExactPacking packing) {
  return value > 0 && value <= 1 ? std::uint32_t(std::lround(double(value) * largest_of(packing))) : 0;
}

float from_integer(std::uint32_t value, ExactPacking packing) {
  const double largest = largest_of(packing);
  switch (packing.normalisation) {
    case Normalisation::product:
      return float(value) * (1.0f / float(largest));
    case Normalisation::wide_product:
      return float(double(value) * (1.0 / largest));
    case Normalisation::division:
      break;
  }
  return float(value) / float(largest);
}

std::uint32_t packed(float value, ExactPacking packing) {
  if (is_normalised(packing)) return to_integer(value, packing);
  return packing == packed_as_floats ? bit_cast<std::uint32_t>(value) : to_half(value);
}

float unpacked(std::uint32_t bits, ExactPacking packing) {
  if (is_normalised(packing)) return from_integer(bits, packing);
  return packing == packed_as_floats ? bit_cast<float>(bits) : from_half(std::uint16_t(bits));
}

bool holds(ExactPacking packing, std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [&](float value) {
    return bit_cast<std::uint32_t>(unpacked(packed(value, packing), packing)) ==
           bit_cast<std::uint32_t>(value);
  });
}

ExactPacking read_packing(ByteReader& in) {
  const std::uint32_t bits = in.u8(), normalisation = in.u8();
  const ExactPacking packing{std::uint8_t(bits), Normalisation(normalisation)};
  const bool is_known =
      packing == packed_as_floats || packing == packed_as_halves ||
      (normalisation < std::size(normalisations) && (bits == 8 || bits == 10 || bits == 16 || bits == 24));
  if (!is_known)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the packing of section %s is unknown (got %u bits, form %u); record it again", in.name(),
                  bits, normalisation);
  return packing;
}

std::uint32_t read_bits(ByteReader& in, std::size_t bytes) {
  if (bytes == 4) return in.u32();
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value |= in.u8() << (8 * i);
  return value;
}

}  // namespace

ExactPacking exact_packing(std::span<const float> values) {
  for (const std::uint8_t bits : packed_bits)
    for (const Normalisation normalisation : normalisations) {
      const ExactPacking packing{bits, normalisation};
      if (bits == packed_as_halves.bits && packing != packed_as_halves) continue;
      if (holds(packing, values)) return packing;
    }
  return packed_as_floats;
}

void write_exact(ByteWriter& out, std::span<const float> values) {
  const ExactPacking packing = exact_packing(values);
  out.u8(packing.bits);
  out.u8(std::uint32_t(packing.normalisation));
  for (const float value : values) {
    const std::uint32_t bits = packed(value, packing);
    for (std::size_t i = 0; i < packing.bytes(); ++i) out.u8(bits >> (8 * i) & 255u);
  }
}

void read_exact(ByteReader in, std::uint32_t count, Vector<float>& values) {
  const ExactPacking packing = read_packing(in);
  in.check_count(count, 8 * packing.bytes(), "texels");
  values.resize(count);
  for (float& value : values) value = unpacked(read_bits(in, packing.bytes()), packing);
  in.check_end();
}

}  // namespace nook::nnao
