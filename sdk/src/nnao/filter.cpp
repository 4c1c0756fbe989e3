#include "sdk/src/nnao/filter.h"

#include <algorithm>
#include <cmath>

namespace nook::nnao {
namespace {

// Averages the slopes on both sides of a pixel. The weight of a slope is the inverse of its square.
float axis_slope(const Neighbours& neighbours, std::size_t first) {
  const float a = neighbours.slope[first], b = neighbours.slope[first + 1];
  const float steep_a = a * a + 1e-12f, steep_b = b * b + 1e-12f;
  return (a * steep_b + b * steep_a) / (steep_a + steep_b);
}

// Returns the four edges as integers from 0 to 3.
std::array<float, 4> unpacked(std::uint8_t bits) {
  return {float(bits >> 6), float(bits >> 4 & 3), float(bits >> 2 & 3), float(bits & 3)};
}

// Returns the texel at an offset, clamped to the screen.
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
  // The surface is assumed to continue beyond the border of the screen.
  for (std::size_t i = 0; i < 4; ++i)
    if (!inside[i]) found.slope[i] = found.slope[i ^ 1];
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t axis = i / 2 * 2;
    const float bend = 0.5f * std::abs(found.slope[axis] - found.slope[axis + 1]);
    const float off = std::min(std::abs(found.slope[i]), bend) * (orthographic ? 1 : depth) / tolerance;
    found.connected[i] = inside[i] ? std::clamp(1.25f - off, 0.0f, 1.0f) : 0;
  }
  const float least =
      0.5f - 0.2f * (found.connected[0] + found.connected[1] + found.connected[2] + found.connected[3]);
  for (std::size_t i = 0; i < 4; ++i)
    if (inside[i] && depths[i] != sky_depth) found.connected[i] = std::max(found.connected[i], least);
  return found;
}

Vec3 rebuilt_normal(const View& view, std::uint32_t x, std::uint32_t y, const Neighbours& neighbours) {
  // With the depth d(x, y) and the ray (u, v) of a pixel, the plane's normal in a perspective view is
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

FilterWeights filter_weights(const FilterLine& line, FilterAxis axis, float range_sharpness) {
  constexpr float shares[filter_reach_px] = {6.0f / 7, 3.0f / 7, 1.0f / 7};
  const std::size_t back = axis == FilterAxis::x ? 0 : 2, ahead = back + 1;
  FilterWeights weights{};
  weights[filter_reach_px] = 1;
  for (const int side : {-1, 1}) {
    float connected = 1;
    for (int i = 1; i <= filter_reach_px; ++i) {
      const std::size_t at = std::size_t(filter_reach_px + i * side), nearer = std::size_t(int(at) - side);
      connected *= unpacked(line.edges[nearer])[side < 0 ? back : ahead] / 3;
      const float difference = std::abs(line.ao[at] - line.ao[filter_reach_px]);
      weights[at] = shares[i - 1] * connected * std::clamp(2 - range_sharpness * difference, 0.0f, 1.0f);
    }
  }
  return weights;
}

float filtered(std::span<const float> ao, std::span<const std::uint8_t> edges, std::uint32_t width,
               std::uint32_t height, std::uint32_t x, std::uint32_t y, FilterAxis axis,
               float range_sharpness) {
  FilterLine line;
  for (int i = 0; i < filter_size_px; ++i) {
    const int along = i - filter_reach_px;
    const std::size_t texel = axis == FilterAxis::x ? near_texel(width, height, x, y, along, 0)
                                                    : near_texel(width, height, x, y, 0, along);
    line.ao[std::size_t(i)] = ao[texel];
    line.edges[std::size_t(i)] = edges[texel];
  }
  const FilterWeights weights = filter_weights(line, axis, range_sharpness);
  float sum = 0, whole = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * line.ao[i];
    whole += weights[i];
  }
  return sum / whole;
}

}  // namespace nook::nnao
