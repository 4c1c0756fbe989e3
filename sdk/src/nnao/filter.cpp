#include "sdk/src/nnao/filter.h"

#include <algorithm>
#include <cmath>

namespace nook::nnao {
namespace {

// Averages the slopes of both sides, each weighted by the inverse of its square.
float axis_slope(const Neighbours& neighbours, std::size_t first) {
  const float a = neighbours.slope[first], b = neighbours.slope[first + 1];
  const float steep_a = a * a + 1e-12f, steep_b = b * b + 1e-12f;
  return (a * steep_b + b * steep_a) / (steep_a + steep_b);
}

// Each value is 0 to 3.
std::array<float, 4> unpacked(std::uint8_t bits) {
  return {float(bits >> 6), float(bits >> 4 & 3), float(bits >> 2 & 3), float(bits & 3)};
}

// Returns the texel next to another one; at the border of the screen, the nearest texel on it.
std::size_t near_texel(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y, int aside,
                       int up) {
  return std::size_t(std::clamp(int(y) + up, 0, int(height) - 1)) * width +
         std::size_t(std::clamp(int(x) + aside, 0, int(width) - 1));
}

}  // namespace

Neighbours neighbours_of(const View& view, std::uint32_t x, std::uint32_t y, float tolerance) {
  const int column = int(x), row = int(y);
  const bool orthographic = view.rays.orthographic;
  const float depth = view.depth[view.at(x, y)];
  const std::array<float, 4> depths{depth_near(view, column - 1, row), depth_near(view, column + 1, row),
                                    depth_near(view, column, row - 1), depth_near(view, column, row + 1)};
  Neighbours found;
  for (std::size_t i = 0; i < 4; ++i)
    found.slope[i] = (depths[i] - depth) / (orthographic ? 1 : depths[i]) * (i % 2 == 0 ? -1.0f : 1.0f);
  const std::array<bool, 4> inside{x > 0, x + 1 < view.width, y > 0, y + 1 < view.height};
  // Beyond the border of the screen the surface is assumed to continue.
  for (std::size_t i = 0; i < 4; ++i)
    if (!inside[i]) found.slope[i] = found.slope[i ^ 1];
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t axis = i / 2 * 2;
    const float bend = 0.5f * std::abs(found.slope[axis] - found.slope[axis + 1]);
    const float off = std::min(std::abs(found.slope[i]), bend) * (orthographic ? 1 : depth) / tolerance;
    found.connected[i] = inside[i] ? std::clamp(1.25f - off, 0.0f, 1.0f) : 0;
  }
  return found;
}

Vec3 rebuilt_normal(const View& view, std::uint32_t x, std::uint32_t y, const Neighbours& neighbours) {
  // With the depth d(x, y) and the ray (u, v) of a pixel, the plane's normal in a perspective is
  //   (du d / d, dv d / d, 1 + u du d / d + v dv d / d).
  const ScreenRays& rays = view.rays;
  const float along_u = axis_slope(neighbours, 0) / rays.x_scale,
              along_v = axis_slope(neighbours, 2) / rays.y_scale;
  const float u = rays.x_scale * (float(x) + 0.5f) + rays.x_offset,
              v = rays.y_scale * (float(y) + 0.5f) + rays.y_offset;
  return normalised({along_u, along_v, 1 + (rays.orthographic ? 0 : u * along_u + v * along_v)});
}

std::uint8_t packed_edges(const std::array<float, 4>& connected) {
  std::uint32_t bits = 0;
  for (const float edge : connected) bits = bits << 2 | std::uint32_t(std::floor(3 * edge + 0.5f));
  return std::uint8_t(bits);
}

std::array<float, 9> filter_weights(std::span<const float> ao, std::span<const std::uint8_t> edges,
                                    std::uint32_t width, std::uint32_t height, std::uint32_t x,
                                    std::uint32_t y, float range_sharpness) {
  const std::size_t centre = std::size_t(y) * width + x;
  const std::array<float, 4> own = unpacked(edges[centre]);
  std::array<float, 9> weights{};
  weights[4] = 1;
  // aside and up are -1 to 1.
  const auto set = [&](int aside, int up, float connected) {
    const std::size_t texel = near_texel(width, height, x, y, aside, up);
    weights[std::size_t(4 + aside + 3 * up)] =
        connected * std::clamp(2 - range_sharpness * std::abs(ao[texel] - ao[centre]), 0.0f, 1.0f);
  };
  set(-1, 0, own[0] / 3);
  set(1, 0, own[1] / 3);
  set(0, -1, own[2] / 3);
  set(0, 1, own[3] / 3);
  for (const int up : {-1, 1})
    for (const int aside : {-1, 1}) {
      // Two ways lead to a corner: first along x and then along the corner's own edge in y, or first along y.
      const std::array<float, 4> back = unpacked(edges[near_texel(width, height, x, y, aside, up)]);
      const float x_first = own[aside < 0 ? 0 : 1] * back[up < 0 ? 3 : 2],
                  y_first = own[up < 0 ? 2 : 3] * back[aside < 0 ? 1 : 0];
      set(aside, up, std::max(x_first, y_first) / 9);
    }
  return weights;
}

float filtered(std::span<const float> ao, std::span<const std::uint8_t> edges, std::uint32_t width,
               std::uint32_t height, std::uint32_t x, std::uint32_t y, float range_sharpness) {
  const std::array<float, 9> weights = filter_weights(ao, edges, width, height, x, y, range_sharpness);
  float sum = 0, whole = 0;
  for (int up = -1; up <= 1; ++up)
    for (int aside = -1; aside <= 1; ++aside) {
      const float weight = weights[std::size_t(4 + aside + 3 * up)];
      sum += weight * ao[near_texel(width, height, x, y, aside, up)];
      whole += weight;
    }
  return sum / whole;
}

}  // namespace nook::nnao
