#include "sdk/src/material/packed_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sdk/src/core/floats.h"
#include "sdk/src/material/map_rows.h"

namespace nook::material {
namespace {

// The largest magnitude is scaled to [2^14, 2^15). Even if it is rounded up, it stays below 65504, the
// maximum of a half float.
constexpr int top_exponent = 14;
constexpr int max_exponent = 100;

// Rounds down to four binary digits.
float rounded_down(float step) {
  const float coarse = bit_cast<float>(bit_cast<std::uint32_t>(step) & 0xfff00000u);
  return std::isnormal(coarse) ? coarse : 1.0f;
}

}  // namespace

void write_packed(ByteWriter& out, std::span<const float> values) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  const int exponent =
      largest > 0 ? std::clamp(std::ilogb(largest) - top_exponent, -max_exponent, max_exponent) : 0;
  out.u8(static_cast<std::uint8_t>(exponent));
  for (const float value : values) out.u16(to_half(std::ldexp(value, -exponent)));
}

void read_packed(ByteReader& in, std::span<float> values) {
  const int exponent = static_cast<std::int8_t>(in.u8());
  if (std::abs(exponent) > max_exponent)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s holds an exponent out of range (got %d, need -%d to %d); bake the file again",
                  in.name(), exponent, max_exponent, max_exponent);
  for (float& value : values) {
    value = std::ldexp(from_half(std::uint16_t(in.u16())), exponent);
    if (!std::isfinite(value))
      throw Failure(NOOK_ERROR_BAD_FILE, "section %s holds a number that is not finite; bake the file again",
                    in.name());
  }
}

std::int32_t multiple_of(float value, float step, std::int32_t limit) {
  const double multiple = std::nearbyint(double(value) / double(step));
  return std::int32_t(std::clamp(multiple, -double(limit), double(limit)));
}

std::int32_t largest_multiple(std::span<const float> values, float step) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  return std::int32_t(std::min(std::floor(double(largest) / double(step)), double(max_multiple)));
}

void write_multiples(ByteWriter& out, std::span<const float> values, std::size_t slab, float step) {
  out.f32(step);
  const std::int32_t limit = largest_multiple(values, step);
  std::vector<std::int32_t> multiples;
  for (std::size_t first = 0; first < values.size(); first += slab) {
    multiples.clear();
    for (const float value : values.subspan(first, std::min(slab, values.size() - first)))
      multiples.push_back(multiple_of(value, step, limit));
    const std::uint32_t k = best_k(multiples);
    out.bits(k, k_bits);
    for (const std::int32_t multiple : multiples) write_multiple(out, multiple, k);
  }
  out.align();
}

float read_step(ByteReader& in) {
  const float step = in.f32();
  if (step > 0 && std::isfinite(step)) return step;
  throw Failure(NOOK_ERROR_BAD_FILE,
                "section %s holds a step that is not positive (got %g); bake the file again", in.name(),
                double(step));
}

float read_multiples(ByteReader& in, std::span<float> values, std::size_t slab) {
  const float step = read_step(in);
  for (std::size_t first = 0; first < values.size(); first += slab) {
    const std::uint32_t k = read_k(in);
    for (float& value : values.subspan(first, std::min(slab, values.size() - first)))
      value = float(read_multiple(in, k)) * step;
  }
  in.align();
  return step;
}

float step_of_error(std::span<const float> values, float share) {
  double square = 0;
  for (const float value : values) square += double(value) * value;
  // Rounding to a step has the squared error step^2 / 12.
  return values.empty() ? 1.0f
                        : rounded_down(float(std::sqrt(12 * double(share) * square / double(values.size()))));
}

float error_of_step(std::span<const float> values, float step) {
  double square = 0;
  for (const float value : values) square += double(value) * value;
  return square > 0 ? float(double(step) * step / 12 * double(values.size()) / square) : 0;
}

float step_of_largest(std::span<const float> values, float multiples) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  return rounded_down(largest / multiples);
}

}  // namespace nook::material
