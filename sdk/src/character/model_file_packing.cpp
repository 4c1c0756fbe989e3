#include "sdk/src/character/model_file_packing.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook {

Range read_range(ByteReader& in, float limit) {
  Range range;
  range.low = in.f32();
  range.high = in.f32();
  // The comparison is false for NaN.
  if (!(range.low >= -limit && range.low <= range.high && range.high <= limit))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s holds a bad range (got %g to %g, need within %g); bake the file again",
                  in.name(), double(range.low), double(range.high), double(limit));
  return range;
}

Box read_box(ByteReader& in, float limit) {
  Box box;
  box.x = read_range(in, limit);
  box.y = read_range(in, limit);
  box.z = read_range(in, limit);
  return box;
}

void write_normal(ByteWriter& out, Vec3 normal, int bits) {
  const Vec3 n = normal * (1 / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)));
  float u = n.x, v = n.y;
  if (n.z < 0) {
    u = std::copysign(1 - std::abs(n.y), n.x);
    v = std::copysign(1 - std::abs(n.x), n.y);
  }
  const Range unit{-1, 1};
  out.bits(unit.encode(u, bits), bits);
  out.bits(unit.encode(v, bits), bits);
}

Vec3 read_normal(ByteReader& in, int bits) {
  const Range unit{-1, 1};
  const float u = unit.decode(in.bits(bits), bits);
  const float v = unit.decode(in.bits(bits), bits);
  const float z = 1 - std::abs(u) - std::abs(v);
  if (z >= 0) return normalised({u, v, z});
  return normalised({std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z});
}

std::array<std::uint32_t, KeyPoint::max_bones> weight_codes(
    const std::array<float, KeyPoint::max_bones>& weight) {
  constexpr int n = KeyPoint::max_bones;
  std::array<std::uint32_t, n> code{};
  std::array<float, n> remainder{};
  int left = 256;
  for (int i = 0; i < n; ++i) {
    code[i] = static_cast<std::uint32_t>(std::min(weight[i] * 256, 256.0f));
    remainder[i] = weight[i] * 256 - static_cast<float>(code[i]);
    left -= static_cast<int>(code[i]);
  }
  // The weights sum to 1 except for rounding, so at most n steps are left to distribute. If the sum of the
  // codes is one step too large, one step is subtracted from the largest weight.
  for (; left > 0; --left) {
    const auto most = std::max_element(remainder.begin(), remainder.end()) - remainder.begin();
    ++code[most];
    remainder[most] -= 1;
  }
  for (; left < 0; ++left) --*std::max_element(code.begin(), code.end());
  return code;
}

}  // namespace nook
