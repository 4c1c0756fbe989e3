// Floats in the sections of a file: as half floats with one common exponent, so that the largest of them lies
// near a half's maximum and small ones keep their precision; or as multiples of a step, which take few bits
// where numbers are small.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"

namespace nook::material {

// All values must be finite.
void write_packed(ByteWriter& out, std::span<const float> values);

constexpr std::size_t packed_bytes(std::size_t count) {
  return 1 + 2 * count;
}
// Throws Failure(NOOK_ERROR_BAD_FILE) at a number that is not finite.
void read_packed(ByteReader& in, std::span<float> values);

// Numbers rounded to multiples of a step: f32 step, then slabs of `slab` numbers each (the last may be
// shorter), in packed bits: the k of map_rows.h, and each multiple in its code. So the code adapts to each
// slab; the end is aligned to a byte. All values must be finite, and the step positive. No number is rounded
// beyond the largest magnitude, which may be at a limit of the format.
void write_multiples(ByteWriter& out, std::span<const float> values, std::size_t slab, float step);
// Returns the smallest number of bytes that count numbers take: one bit each.
constexpr std::size_t min_multiples_bytes(std::size_t count) {
  return count / 8;
}
// Throws Failure(NOOK_ERROR_BAD_FILE) at a step that is not positive and finite, and at a multiple out of
// range.
// Returns the step.
float read_multiples(ByteReader& in, std::span<float> values, std::size_t slab);

// Reads the f32 step. Throws Failure(NOOK_ERROR_BAD_FILE) if it is not positive and finite.
float read_step(ByteReader& in);

// Returns the multiple of a step that is nearest to a value and within a limit, and the limit of values: the
// number of steps within their largest magnitude.
std::int32_t multiple_of(float value, float step, std::int32_t limit);
std::int32_t largest_multiple(std::span<const float> values, float step);

// The steps of the largest number of an array that is no core: such arrays are small, and their rounding
// should not count beside that of the cores.
inline constexpr float steps_of_largest = 511;

// Returns the step at which rounding has the given squared error, relative to the squared norm of the values.
float step_of_error(std::span<const float> values, float share);
// Returns the error of rounding to a step, in the same terms; 0 without values.
float error_of_step(std::span<const float> values, float step);
// Returns the step of which the largest magnitude is `multiples`. Both steps are rounded down to four binary
// digits, so that numbers that are rounded already have the same step.
float step_of_largest(std::span<const float> values, float multiples);

}  // namespace nook::material
