// Stores arrays of floats in the sections of a file in one of two formats. The first is half floats with a
// common exponent. This exponent brings the largest value close to the maximum of a half float, so that small
// values keep their precision. The second format is multiples of a step, in which small values take few bits.
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
// Throws Failure(NOOK_ERROR_BAD_FILE) if a value is not finite.
void read_packed(ByteReader& in, std::span<float> values);

// Writes values as multiples of a step: the step as f32, then slabs of `slab` values each (the last slab may
// be shorter). A slab consists of k and the multiples in the Golomb-Rice code of map_rows.h, as packed bits.
// Each slab has its own k, so the code adapts to the slab. The end is aligned to a byte. All values must be
// finite, and the step must be positive. A value is never rounded beyond the largest magnitude of the array,
// because that magnitude may already be at the limit of valid values.
void write_multiples(ByteWriter& out, std::span<const float> values, std::size_t slab, float step);
// Returns the minimum number of bytes for `count` values, at one bit each.
constexpr std::size_t min_multiples_bytes(std::size_t count) {
  return count / 8;
}
// Reads the output of write_multiples and returns the step. Throws Failure(NOOK_ERROR_BAD_FILE) if the step
// is not positive and finite, or if a multiple is out of range.
float read_multiples(ByteReader& in, std::span<float> values, std::size_t slab);

// Reads the f32 step. Throws Failure(NOOK_ERROR_BAD_FILE) if it is not positive and finite.
float read_step(ByteReader& in);

// multiple_of returns the integer m for which m * step is nearest to the value, clamped to [-limit, limit].
// For an array, the limit is the number of whole steps in its largest magnitude.
std::int32_t multiple_of(float value, float step, std::int32_t limit);
std::int32_t largest_multiple(std::span<const float> values, float step);

// For all arrays except cores, the step is the largest magnitude divided by this number. These arrays are
// small, so a fine step costs little, and their rounding error is small compared with the error of the cores.
inline constexpr float steps_of_largest = 511;

// Returns the step at which rounding has the given squared error, relative to the squared norm of the values.
float step_of_error(std::span<const float> values, float share);
// Returns the relative squared error of rounding to a step, or 0 if there are no values.
float error_of_step(std::span<const float> values, float step);
// Returns the largest magnitude divided by `multiples`. This function and step_of_error round the step down
// to four binary digits, so that values that are already rounded get the same step again.
float step_of_largest(std::span<const float> values, float multiples);

}  // namespace nook::material
