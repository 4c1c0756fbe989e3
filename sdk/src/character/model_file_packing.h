// Converts the values of a character model to small integers, and back.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/core/bytes.h"

namespace nook {

// The number of bits of each field.
struct CharacterBits {
  static constexpr int sphere_centre = 16;  // per coordinate, relative to the box of all centres: steps of 30
                                            // micrometres in a box of 2 m
  static constexpr int sphere_radius = 16;
  static constexpr int caster_weight = 8;
  static constexpr int key_position = 16;
  // The number of bits of each of the two octahedral coordinates. The error of the normal is at most 0.1
  // degree.
  static constexpr int key_normal = 11;
  static constexpr int surface_offset = 12;  // surface position minus position: steps of 0.1 mm in a range of
                                             // 0.4 m
  static constexpr int surface_normal = 10;
  static constexpr int bone_count = 2;
  // In units of 1/256, so that the weights of a key point sum to exactly 1.
  static constexpr int bone_weight = 8;
  static constexpr int saturation = 8;  // codes are linear in the square root
  static constexpr int entry_count = 3;
  static constexpr int reference = 5;  // selects an earlier vertex, whose key points are reused
  static constexpr int alpha = 7;      // codes are linear in the square root
  static constexpr int bias = 8;
  static constexpr int blend = 5;
  static constexpr int level_scale = 8;
  static constexpr int level_offset = 8;
  static constexpr int world_caster_end = 14;  // steps of 0.1 mm in a range of 2 m
  static constexpr int world_caster_radius = 12;
  static constexpr int world_caster_scale = 8;
  static constexpr int rest_position = 16;
  static constexpr int rest_normal = 7;  // the error is within 2 degrees
  static constexpr int float_bits = 6;   // stores how many low bits of a float changed, 0 to 32
  static constexpr int close_bones = 4;
  static constexpr int close_weight = 16;
};

// A vertex may reuse the key points of one of this many vertices before it.
inline constexpr std::size_t max_references = std::size_t{1} << CharacterBits::reference;

// A bone's name shares at most this many leading bytes with the previous name. Without this limit, the names
// in a small malicious file could fill the memory.
inline constexpr std::uint32_t max_shared_name = 64;

// A range of values that are stored as codes. Codes are evenly spaced from `low` to `high`, and represent
// `low` and `high` exactly.
struct Range {
  float low = 0, high = 0;

  static constexpr std::uint32_t last_code(int bits) { return (1u << bits) - 1; }
  void include(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  std::uint32_t encode(float value, int bits) const {
    if (!(high > low)) return 0;
    const double share = (double(value) - low) / (double(high) - low);
    return static_cast<std::uint32_t>(std::lround(std::min(std::max(share, 0.0), 1.0) * last_code(bits)));
  }
  float decode(std::uint32_t code, int bits) const {
    return static_cast<float>(low + (double(high) - low) * code / last_code(bits));
  }
};

struct Box {
  Range x, y, z;

  static Box around(Vec3 p) { return {{p.x, p.x}, {p.y, p.y}, {p.z, p.z}}; }
  void include(Vec3 p) {
    x.include(p.x);
    y.include(p.y);
    z.include(p.z);
  }
};

inline void write_range(ByteWriter& out, const Range& range) {
  out.f32(range.low);
  out.f32(range.high);
}
// Throws Failure unless low <= high and both are finite and at most `limit` in magnitude, so that all decoded
// values are finite.
Range read_range(ByteReader& in, float limit);

inline void write_box(ByteWriter& out, const Box& box) {
  write_range(out, box.x);
  write_range(out, box.y);
  write_range(out, box.z);
}
Box read_box(ByteReader& in, float limit);

inline void write_point(ByteWriter& out, const Box& box, Vec3 p, int bits) {
  out.bits(box.x.encode(p.x, bits), bits);
  out.bits(box.y.encode(p.y, bits), bits);
  out.bits(box.z.encode(p.z, bits), bits);
}
inline Vec3 read_point(ByteReader& in, const Box& box, int bits) {
  const float x = box.x.decode(in.bits(bits), bits);
  const float y = box.y.decode(in.bits(bits), bits);
  return {x, y, box.z.decode(in.bits(bits), bits)};
}

// The octahedral mapping of unit vectors: Meyer et al. 2010, "On floating-point normal vectors".
void write_normal(ByteWriter& out, Vec3 normal, int bits);
Vec3 read_normal(ByteReader& in, int bits);

// Returns bone weights in units of 1/256 that sum to 256, by the method of largest remainders.
std::array<std::uint32_t, KeyPoint::max_bones> weight_codes(
    const std::array<float, KeyPoint::max_bones>& weight);

// alpha = max_alpha * (code / largest code)^2, so that steps are fine where alpha is small. Code 0 means "no
// entry".
inline float decode_alpha(std::uint32_t code, float max_alpha) {
  const double share = code / double(Range::last_code(CharacterBits::alpha));
  return static_cast<float>(max_alpha * share * share);
}
inline std::uint32_t encode_alpha(float alpha, float max_alpha) {
  const std::uint32_t last = Range::last_code(CharacterBits::alpha);
  const double code = std::round(last * std::sqrt(std::max(0.0, double(alpha) / max_alpha)));
  return static_cast<std::uint32_t>(std::min(std::max(code, 1.0), double(last)));
}

// Blend weights are multiples of 1/16, starting at -8/16. The weights of a vertex sum to exactly 1, so one of
// them is not written.
inline constexpr int blend_one = 16, blend_low = -8;
inline float decode_blend(std::uint32_t code) {
  return static_cast<float>(static_cast<int>(code) + blend_low) / blend_one;
}
inline std::uint32_t encode_blend(float weight) {
  const double last = Range::last_code(CharacterBits::blend);
  return static_cast<std::uint32_t>(
      std::min(std::max(std::round(double(weight) * blend_one) - blend_low, 0.0), last));
}

}  // namespace nook
