#include "sdk/src/nnao/exact_packing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/half.h"

namespace nook::nnao {
namespace {

float from_unorm(std::uint32_t value, float largest) {
  return float(value) / largest;
}

// 0 for what is no number in [0, 1].
std::uint32_t to_unorm(float value, float largest) {
  return value > 0 && value <= 1 ? std::uint32_t(std::lround(value * largest)) : 0;
}

std::uint32_t packed(float value, ExactPacking packing) {
  switch (packing) {
    case ExactPacking::half:
      return to_half(value);
    case ExactPacking::unorm8:
      return to_unorm(value, 255);
    case ExactPacking::unorm16:
      return to_unorm(value, 65535);
    case ExactPacking::float32:
      break;
  }
  return bit_cast<std::uint32_t>(value);
}

float unpacked(std::uint32_t bits, ExactPacking packing) {
  switch (packing) {
    case ExactPacking::half:
      return from_half(std::uint16_t(bits));
    case ExactPacking::unorm8:
      return from_unorm(bits, 255);
    case ExactPacking::unorm16:
      return from_unorm(bits, 65535);
    case ExactPacking::float32:
      break;
  }
  return bit_cast<float>(bits);
}

bool holds(ExactPacking packing, std::span<const float> values) {
  return std::ranges::all_of(values, [&](float value) {
    return bit_cast<std::uint32_t>(unpacked(packed(value, packing), packing)) ==
           bit_cast<std::uint32_t>(value);
  });
}

}  // namespace

std::size_t packed_bytes(ExactPacking packing) {
  return packing == ExactPacking::float32 ? 4 : packing == ExactPacking::unorm8 ? 1 : 2;
}

ExactPacking exact_packing(std::span<const float> values) {
  for (const ExactPacking packing : {ExactPacking::unorm8, ExactPacking::half, ExactPacking::unorm16})
    if (holds(packing, values)) return packing;
  return ExactPacking::float32;
}

void write_exact(ByteWriter& out, std::span<const float> values) {
  const ExactPacking packing = exact_packing(values);
  out.u8(std::uint32_t(packing));
  for (const float value : values) {
    const std::uint32_t bits = packed(value, packing);
    if (packing == ExactPacking::float32)
      out.u32(bits);
    else if (packing == ExactPacking::unorm8)
      out.u8(bits);
    else
      out.u16(bits);
  }
}

void read_exact(ByteReader in, std::uint32_t count, Vector<float>& values) {
  const std::uint32_t named = in.u8();
  if (named >= exact_packing_count)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the packing of section %s is unknown (got %u, need less than %u); record it again",
                  in.name(), named, exact_packing_count);
  const auto packing = ExactPacking(named);
  const std::size_t each = packed_bytes(packing);
  in.check_count(count, 8 * each, "texels");
  values.resize(count);
  for (float& value : values)
    value = unpacked(each == 4 ? in.u32() : each == 2 ? in.u16() : in.u8(), packing);
  in.check_end();
}

}  // namespace nook::nnao
