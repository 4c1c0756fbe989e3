// Holds the stages around the network, one pixel at a time: edges between pixels, normals derived from depth,
// and the filter. Tests compare the OpenGL pass with them.
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
  // the depth of the neighbour (orthographic: by 1). On a plane both sides of an axis are equal, because 1 /
  // depth (orthographic: depth) is linear on the screen.
  std::array<float, 4> slope{};
  // 1: the neighbour is on the same surface; 0: an edge, or the border of the screen.
  std::array<float, 4> connected{};
};

// An edge is where depth differs by more than about `tolerance` metres both from the neighbour's and from the
// line through the neighbours on both sides.
Neighbours neighbours_of(const View& view, std::uint32_t x, std::uint32_t y, float tolerance);

// Returns the normal that the slopes imply. Of the two sides of an axis the flatter one counts more: past a
// silhouette, depth changes more steeply than on the pixel's own surface.
Vec3 rebuilt_normal(const View& view, std::uint32_t x, std::uint32_t y, const Neighbours& neighbours);

// Packs the four values of `connected` in two bits each: 0, 1/3, 2/3, 1.
std::uint8_t packed_edges(const std::array<float, 4>& connected);

// A filter along x and then one along y make the filter of the pass.
enum class FilterAxis { x, y };

// Along y, AO values that differ by less than the inverse of this are averaged with full weight; values that
// differ by more than twice as much are not averaged. Fewer taps are noisier.
constexpr float filter_range_sharpness(std::uint32_t taps) {
  return taps < 16 ? 4.0f : taps < 32 ? 5.0f : 8.0f;
}

// Returns the same along x. There the filter still reads single pixels: with nine taps it does not compare
// them, and with more it compares half as sharply.
constexpr float filter_range_sharpness(std::uint32_t taps, FilterAxis axis) {
  return axis == FilterAxis::y ? filter_range_sharpness(taps)
         : taps < 16           ? 0
                               : 0.5f * filter_range_sharpness(taps);
}

// AO and packed_edges of five pixels in a row or in a column; the middle one is filtered. edges are 0 where
// there is no surface.
struct FilterLine {
  std::array<float, 5> ao{};
  std::array<std::uint8_t, 5> edges{};
};

// Returns the weights of the five pixels in the middle one's filtered value; the middle one's own is 1.
// Without a range, they are 1, 2, 3, 2, 1 over 3, times the edges on the way.
std::array<float, 5> filter_weights(const FilterLine& line, FilterAxis axis, float range_sharpness);

// Filters AO along an axis. Beyond the border the weights are 0.
float filtered(std::span<const float> ao, std::span<const std::uint8_t> edges, std::uint32_t width,
               std::uint32_t height, std::uint32_t x, std::uint32_t y, FilterAxis axis,
               float range_sharpness);

}  // namespace nook::nnao
