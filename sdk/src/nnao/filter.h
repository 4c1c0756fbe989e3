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

// AO values that differ by less than the inverse of this are averaged with full weight; values that differ by
// more than twice as much are not averaged. Fewer taps are noisier.
constexpr float filter_range_sharpness(std::uint32_t taps) {
  return taps < 16 ? 2.0f : taps < 32 ? 2.5f : 4.0f;
}

// Returns the weights of the 3 x 3 pixels around one in its filtered value, row by row from the lower left;
// the pixel's own is 1. edges are packed_edges of every pixel, 0 where there is no surface. A corner takes
// the better of the two ways around. Beyond the border, side weights are 0, and the pixel nearest to a corner
// stands for it.
std::array<float, 9> filter_weights(std::span<const float> ao, std::span<const std::uint8_t> edges,
                                    std::uint32_t width, std::uint32_t height, std::uint32_t x,
                                    std::uint32_t y, float range_sharpness);

// Filters AO over 3 x 3 pixels with these weights.
float filtered(std::span<const float> ao, std::span<const std::uint8_t> edges, std::uint32_t width,
               std::uint32_t height, std::uint32_t x, std::uint32_t y, float range_sharpness);

}  // namespace nook::nnao
