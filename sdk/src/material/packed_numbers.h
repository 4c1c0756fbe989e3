// Stores floats in the sections of a file in one of two ways. As half floats with a common exponent, the
// largest lies near a half's maximum and small ones keep their precision. As multiples of a step, small
// numbers take few bits.
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

// Writes numbers as multiples of a step: f32 step, then slabs of `slab` numbers each (the last may be
// shorter). A slab has, in packed bits, the k of map_rows.h and each multiple in its code. So the code adapts
// to each slab; the end is aligned to a byte. All values must be finite, and the step positive. Rounding
// never goes beyond the largest magnitude, which may be at a limit of the format.
void write_multiples(ByteWriter& out, std::span<const float> values, std::size_t slab, float step);
// Returns the smallest number of bytes that count numbers take, at one bit each.
constexpr std::size_t min_multiples_bytes(std::size_t count) {
  return count / 8;
}
// Throws Failure(NOOK_ERROR_BAD_FILE) at a step that is not positive and finite, and at a multiple out of
// range.
// Returns the step.
float read_multiples(ByteReader& in, std::span<float> values, std::size_t slab);

// Reads the f32 step. Throws Failure(NOOK_ERROR_BAD_FILE) if it is not positive and finite.
float read_step(ByteReader& in);

// multiple_of returns the multiple of a step that is nearest to a value, within a limit. The limit of an
// array is the number of steps within its largest magnitude.
std::int32_t multiple_of(float value, float step, std::int32_t limit);
std::int32_t largest_multiple(std::span<const float> values, float step);

// For arrays other than cores, the largest number is this many steps. Such arrays are small, and their
// rounding should not matter beside the cores'.
inline constexpr float steps_of_largest = 511;

// Returns the step at which rounding has the given squared error, relative to the squared norm of the values.
float step_of_error(std::span<const float> values, float share);
// Returns the error of rounding to a step, in the same terms; 0 without values.
float error_of_step(std::span<const float> values, float step);
// Returns the step that fits `multiples` times into the largest magnitude. Both steps are rounded down to
// four binary digits, so that numbers that are already rounded get the same step again.
float step_of_largest(std::span<const float> values, float multiples);

}  // namespace nook::material
