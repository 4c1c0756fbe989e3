#include "sdk/src/transfer/tangent_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook::transfer {
namespace {

constexpr float steps = 65535, angle_steps = 32768;
constexpr float two_pi = 2 * std::numbers::pi_v<float>;

float sign_of(float a) {
  return a < 0 ? -1.0f : 1.0f;
}

// The two axes that are perpendicular to a unit normal.
struct Across {
  Vec3 x, y;
};
Across across(Vec3 n) {
  const float sign = sign_of(n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

std::uint16_t step_of(float value) {
  return std::uint16_t(std::lround(std::clamp(0.5f * value + 0.5f, 0.0f, 1.0f) * steps));
}

Vec3 normal_of(std::uint16_t u, std::uint16_t v) {
  Vec3 n{2 * float(u) / steps - 1, 2 * float(v) / steps - 1, 0};
  n.z = 1 - std::abs(n.x) - std::abs(n.y);
  if (n.z < 0) {
    const float x = n.x;
    n.x = (1 - std::abs(n.y)) * sign_of(x);
    n.y = (1 - std::abs(x)) * sign_of(n.y);
  }
  return normalised(n);
}

}  // namespace

Frame orthonormal_frame(Vec3 normal, Vec3 tangent, float handedness) {
  Frame frame{normalised(normal), {}, handedness < 0 ? -1.0f : 1.0f};
  if (dot(frame.normal, frame.normal) == 0) frame.normal = {0, 0, 1};
  const Vec3 flat = tangent - frame.normal * dot(frame.normal, tangent);
  const float size = length(flat);
  frame.tangent = size > 1e-6f ? flat * (1 / size) : across(frame.normal).x;
  return frame;
}

PackedFrame pack(const Frame& frame) {
  const Vec3 n = frame.normal;
  const float scale = 1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  float x = n.x * scale, y = n.y * scale;
  if (n.z < 0) {
    const float folded = (1 - std::abs(y)) * sign_of(x);
    y = (1 - std::abs(x)) * sign_of(y);
    x = folded;
  }
  PackedFrame packed{step_of(x), step_of(y), 0};
  // The angle is measured from the axis that belongs to the rounded normal, because the decoder knows only
  // the rounded normal.
  const Across axes = across(normal_of(packed.u, packed.v));
  const float angle = std::atan2(dot(frame.tangent, axes.y), dot(frame.tangent, axes.x));
  const auto step = std::lround((angle < 0 ? angle + two_pi : angle) / two_pi * angle_steps);
  packed.angle =
      std::uint16_t(std::uint32_t(step) % std::uint32_t(angle_steps) * 2 + (frame.handedness < 0 ? 1 : 0));
  return packed;
}

Frame unpack(PackedFrame packed) {
  Frame frame;
  frame.normal = normal_of(packed.u, packed.v);
  const Across axes = across(frame.normal);
  const float angle = float(packed.angle / 2) / angle_steps * two_pi;
  frame.tangent = axes.x * std::cos(angle) + axes.y * std::sin(angle);
  frame.handedness = packed.angle & 1 ? -1.0f : 1.0f;
  return frame;
}

}  // namespace nook::transfer
