// CPU versions of the stages before and after the network: edges between pixels, normals derived from depth,
// and the filter. Each function computes one pixel. Tests compare the OpenGL pass with these functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::nnao {

// A pixel's neighbours in the order left, right, below, above.
struct Neighbours {
  // The change of depth from one pixel to the next along +x (left, right) or +y (below, above), divided by
  // the neighbour's depth (orthographic: not divided). On a plane, the slopes on both sides of a pixel are
  // equal, because 1 / depth (orthographic: depth) is linear on the screen.
  std::array<float, 4> slope{};
  // 1 if the neighbour is on the same surface; 0 at an edge or at the border of the screen. A pixel with
  // hardly any connected neighbours is weakly connected to all neighbours that show a surface. Otherwise its
  // noise would remain, and thin gaps would look like rows of dots.
  std::array<float, 4> connected{};
};

// There is an edge between a pixel and its neighbour if two differences in depth both exceed about
// `tolerance` metres. One is the difference between the two depths. The other is the difference between the
// pixel's depth and the depth of the straight line through the neighbours on both sides.
Neighbours neighbours_of(const View& view, std::uint32_t x, std::uint32_t y, float tolerance);

// Returns the normal derived from the slopes. On each axis, the flatter of the two slopes gets more weight,
// because depth changes more steeply across a silhouette than on the pixel's own surface.
Vec3 rebuilt_normal(const View& view, std::uint32_t x, std::uint32_t y, const Neighbours& neighbours);

// Packs the four values of `connected` into two bits each. Two bits can represent 0, 1/3, 2/3 and 1.
std::uint8_t packed_edges(const std::array<float, 4>& connected);

// The pass filters along x first and then along y.
enum class FilterAxis { x, y };

// Returns the range sharpness of the filter along y. AO values that differ by less than 1 / sharpness are
// averaged with full weight. Values that differ by more than 2 / sharpness are not averaged. With fewer taps
// AO is noisier, so the sharpness is lower. With nine taps, AO is too noisy for this comparison: rows that
// differ only by noise would not be averaged. So the sharpness is 0.
constexpr float filter_range_sharpness(std::uint32_t taps) {
  return taps < 16 ? 0.0f : taps < 32 ? 5.0f : 8.0f;
}

// Returns the range sharpness of the filter along either axis. The filter along x reads unfiltered AO, which
// is noisier, so it has half the sharpness of the filter along y.
constexpr float filter_range_sharpness(std::uint32_t taps, FilterAxis axis) {
  return axis == FilterAxis::y ? filter_range_sharpness(taps) : 0.5f * filter_range_sharpness(taps);
}

// The number of pixels on each side of the filtered one, and the number of pixels in a row or column of the
// filter.
inline constexpr int filter_reach_px = 3, filter_size_px = 2 * filter_reach_px + 1;

// The input of the filter for one pixel: AO and packed_edges of the pixels in a row or column. The middle
// pixel is the one that is filtered. `edges` is 0 where there is no surface.
struct FilterLine {
  std::array<float, filter_size_px> ao{};
  std::array<std::uint8_t, filter_size_px> edges{};
};

using FilterWeights = std::array<float, filter_size_px>;

// Returns the weights of the pixels in the filtered value. The middle pixel has the weight 1. If
// range_sharpness is 0, the weights are 1, 3, 6, 7, 6, 3, 1 divided by 7, each times the product of the
// connections between the pixel and the middle one.
FilterWeights filter_weights(const FilterLine& line, FilterAxis axis, float range_sharpness);

// Filters AO along an axis at one pixel. Pixels beyond the border have the weight 0.
float filtered(std::span<const float> ao, std::span<const std::uint8_t> edges, std::uint32_t width,
               std::uint32_t height, std::uint32_t x, std::uint32_t y, FilterAxis axis,
               float range_sharpness);

}  // namespace nook::nnao
