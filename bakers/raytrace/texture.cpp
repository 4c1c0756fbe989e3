#include "bakers/raytrace/texture.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// Converts sRGB to linear (IEC 61966-2-1).
float linear_of_srgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

// Wraps a texture coordinate into [0, 2), so that it fits into an integer. Two repetitions also contain a
// mirrored one.
float near_first(float u) {
  return u - 2 * std::floor(u / 2);
}

std::uint32_t wrapped(std::int64_t at, std::uint32_t count, TextureWrap wrap) {
  const auto n = std::int64_t(count);
  if (wrap == TextureWrap::clamped) return std::uint32_t(std::clamp<std::int64_t>(at, 0, n - 1));
  const std::int64_t period = wrap == TextureWrap::mirrored ? 2 * n : n;
  const std::int64_t inside = (at % period + period) % period;
  return std::uint32_t(inside < n ? inside : period - 1 - inside);
}

}  // namespace

Texture::Texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba)
    : width_(width), height_(height), rgba_(std::move(rgba)) {
  if (width_ < 1 || height_ < 1 || rgba_.size() != std::size_t(4) * width_ * height_)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the texture has %u x %u texels and %zu bytes (need one texel or more, and 4 bytes for each)", width_,
        height_, rgba_.size());
  for (std::size_t i = 0; i < linear_.size(); ++i) linear_[i] = linear_of_srgb(float(i) / 255);
}

TextureColour Texture::texel(std::int64_t column, std::int64_t row, const TextureUse& use) const {
  const std::uint32_t x = wrapped(column, width_, use.wrap_u), y = wrapped(row, height_, use.wrap_v);
  const std::uint8_t* p = &rgba_[4 * (std::size_t(y) * width_ + x)];
  return {{linear_[p[0]], linear_[p[1]], linear_[p[2]]}, float(p[3]) / 255};
}

TextureColour Texture::at(const TextureUse& use, TexturePoint p) const {
  const auto& m = use.transform;
  float u = m[0] * p.u + m[1] * p.v + m[2], v = m[3] * p.u + m[4] * p.v + m[5];
  u = use.wrap_u == TextureWrap::clamped ? std::clamp(u, 0.0f, 1.0f) : near_first(u);
  v = use.wrap_v == TextureWrap::clamped ? std::clamp(v, 0.0f, 1.0f) : near_first(v);
  // The result is not finite if products of large coordinates overflow.
  if (!std::isfinite(u) || !std::isfinite(v)) return texel(0, 0, use);
  const float x = u * float(width_), y = v * float(height_);
  if (use.nearest) return texel(std::int64_t(std::floor(x)), std::int64_t(std::floor(y)), use);
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float right_share = x - 0.5f - left, low_share = y - 0.5f - top;
  TextureColour sum{{}, 0};
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1, low = corner >> 1;
    const float share = (right ? right_share : 1 - right_share) * (low ? low_share : 1 - low_share);
    const TextureColour c = texel(std::int64_t(left) + right, std::int64_t(top) + low, use);
    sum.rgb += c.rgb * share;
    sum.alpha += c.alpha * share;
  }
  return sum;
}

}  // namespace nook::bake
