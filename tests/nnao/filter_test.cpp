#include "sdk/src/nnao/filter.h"

#include <limits>
#include <vector>

#include "tests/catch.h"

using namespace nook;
using namespace nook::nnao;

namespace {

constexpr float sky = std::numeric_limits<float>::infinity();
constexpr std::uint32_t width = 24, height = 16;

struct Picture {
  ScreenRays rays;
  std::vector<float> depth;
  std::vector<Vec3> normal;
  View view() const { return {width, height, rays, depth, normal}; }
};

ScreenRays test_rays(bool orthographic) {
  const float perspective[16] = {1 / 1.5f, 0, 0, 0, 0, 1, 0, 0, 0.2f, 0, -1, -1, 0, 0, -0.2f, 0};
  const float parallel[16] = {0.5f / 1.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -0.1f, 0, 0, 0, 0, 1};
  return screen_rays(orthographic ? parallel : perspective, width, height);
}

// The plane through (0, 0, -3).
Picture plane(Vec3 normal, bool orthographic) {
  Picture picture{test_rays(orthographic), {}, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const Vec3 at_1 = view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      picture.depth.push_back(orthographic ? 3 + (normal.x * at_1.x + normal.y * at_1.y) / normal.z
                                           : -3 * normal.z / dot(at_1, normal));
      picture.normal.push_back(normal);
    }
  return picture;
}

float degrees_between(Vec3 a, Vec3 b) {
  return std::acos(std::clamp(dot(a, b), -1.0f, 1.0f)) * 57.29578f;
}

std::vector<std::uint8_t> edges_of(const Picture& picture, float tolerance) {
  std::vector<std::uint8_t> edges;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      edges.push_back(picture.view().has_surface(x, y)
                          ? packed_edges(neighbours_of(picture.view(), x, y, tolerance).connected)
                          : 0);
  return edges;
}

}  // namespace

TEST_CASE("on a plane both slopes of an axis agree, nothing is an edge, and the normal comes back") {
  for (const bool orthographic : {false, true})
    for (const Vec3 tilt : {Vec3{0, 0, 1}, Vec3{0.6f, 0.2f, 1}, Vec3{-1.5f, 2, 1}}) {
      const Vec3 normal = normalised(tilt);
      const Picture picture = plane(normal, orthographic);
      for (const auto& [x, y] : {std::pair{0u, 0u}, {12u, 8u}, {23u, 5u}}) {
        if (!(picture.depth[y * width + x] > 0)) continue;
        const Neighbours found = neighbours_of(picture.view(), x, y, 0.05f);
        const std::array<bool, 4> inside{x > 0, x + 1 < width, y > 0, y + 1 < height};
        for (std::size_t i = 0; i < 4; ++i) CHECK(found.connected[i] == float(inside[i]));
        // Depths of a few metres in float, differences of millimetres.
        if (inside[0] && inside[1]) CHECK(std::abs(found.slope[0] - found.slope[1]) < 1e-5f);
        CHECK(degrees_between(rebuilt_normal(picture.view(), x, y, found), normal) < 0.05f);
      }
    }
}

TEST_CASE("a step in depth is an edge on both sides, and the normal does not lean over it") {
  Picture picture = plane({0, 0, 1}, false);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 12; x < width; ++x) picture.depth[y * width + x] = x < 20 ? 3.5f : sky;
  for (const std::uint32_t x : {11u, 12u, 19u}) {
    const Neighbours found = neighbours_of(picture.view(), x, 8, 0.05f);
    CHECK(found.connected[x == 12 ? 0 : 1] == 0);
    CHECK(found.connected[x == 12 ? 1 : 0] == 1);
    CHECK(degrees_between(rebuilt_normal(picture.view(), x, 8, found), {0, 0, 1}) < 0.05f);
  }
}

TEST_CASE("a lone pixel is connected a little to its neighbours, but not to the sky") {
  Picture picture = plane({0, 0, 1}, false);
  const auto connected_at = [&](std::uint32_t x, std::uint32_t y) {
    return neighbours_of(picture.view(), x, y, 0.05f).connected;
  };
  picture.depth[8 * width + 12] = 4;
  CHECK(connected_at(12, 8) == std::array<float, 4>{0.5f, 0.5f, 0.5f, 0.5f});
  picture.depth[8 * width + 11] = 4;  // two pixels have one connection each
  CHECK(connected_at(12, 8)[0] == 1);
  CHECK(std::abs(connected_at(12, 8)[1] - 0.3f) < 1e-6f);
  picture.depth[8 * width + 13] = 4;  // the middle of a line is nearly apart from both sides
  CHECK(std::abs(connected_at(12, 8)[2] - 0.1f) < 1e-6f);
  CHECK(packed_edges(connected_at(12, 8)) == (3 << 6 | 3 << 4));
  picture.depth[8 * width + 11] = picture.depth[8 * width + 13] = sky;
  CHECK(connected_at(12, 8) == std::array<float, 4>{0, 0, 0.5f, 0.5f});
}

TEST_CASE("edges are kept in two bits each") {
  CHECK(packed_edges({0, 0, 0, 0}) == 0);
  CHECK(packed_edges({1, 1, 1, 1}) == 255);
  CHECK(packed_edges({1, 0, 0.34f, 0.6f}) == (3 << 6 | 0 << 4 | 1 << 2 | 2));
}

namespace {

float filtered_at(const std::vector<float>& ao, const std::vector<std::uint8_t>& edges, std::uint32_t x,
                  std::uint32_t y, FilterAxis axis, float range_sharpness) {
  return filtered(ao, edges, width, height, x, y, axis, range_sharpness);
}

std::vector<float> filtered_image(std::vector<float> ao, const std::vector<std::uint8_t>& edges) {
  for (const FilterAxis axis : {FilterAxis::x, FilterAxis::y}) {
    const std::vector<float> before = ao;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) ao[y * width + x] = filtered_at(before, edges, x, y, axis, 0);
  }
  return ao;
}

}  // namespace

TEST_CASE("the filter keeps a constant, averages noise of 3 x 3 pixels, and crosses no edge") {
  Picture picture = plane({0, 0, 1}, false);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 12; x < width; ++x) picture.depth[y * width + x] = 4;
  const std::vector<std::uint8_t> edges = edges_of(picture, 0.05f);
  std::vector<float> ao(width * height, 0.375f);
  for (const float value : filtered_image(ao, edges)) CHECK(std::abs(value - 0.375f) < 1e-6f);
  // Without a range every noise value weighs the same over 7 x 7 pixels: the mean of the nine.
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      ao[y * width + x] = (x < 12 ? 0.2f : 0.7f) + 0.02f * float(x % 3 * 3 + y % 3);
  ao = filtered_image(ao, edges);
  for (std::uint32_t x = 3; x < width - 3; ++x) {
    const bool beside_edge = x >= 9 && x < 15;
    CHECK(std::abs(ao[7 * width + x] - (x < 12 ? 0.28f : 0.78f)) < (beside_edge ? 0.05f : 1e-5f));
  }
}

TEST_CASE("the filter takes no pixel behind an edge, though that one is connected with its own neighbours") {
  FilterLine line{{0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f}, {255, 255, 255, 255, 255, 255, 255}};
  line.edges[3] = packed_edges({0, 1, 1, 1});
  line.edges[4] = packed_edges({1, 0, 1, 1});
  constexpr float near = 6.0f / 7, far = 3.0f / 7, farthest = 1.0f / 7;
  CHECK(filter_weights(line, FilterAxis::x, 0) == FilterWeights{0, 0, 0, 1, near, 0, 0});
  // Along y the same edges do not count.
  CHECK(filter_weights(line, FilterAxis::y, 0) == FilterWeights{farthest, far, near, 1, near, far, farthest});
}

TEST_CASE("the filter does not average values that differ too much") {
  const Picture picture = plane({0, 0, 1}, false);
  const std::vector<std::uint8_t> edges = edges_of(picture, 0.05f);
  std::vector<float> ao(width * height, 0.9f);
  for (std::uint32_t x = 0; x < width; ++x) ao[8 * width + x] = 0.3f;  // a dark line, one pixel wide
  CHECK(std::abs(filtered_at(ao, edges, 12, 8, FilterAxis::y, 4) - 0.3f) < 1e-6f);
  CHECK(std::abs(filtered_at(ao, edges, 12, 7, FilterAxis::y, 4) - 0.9f) < 1e-6f);
  // The weights of six pixels that are 0.6 away add up to 20/7, times 2 - 2.5 x 0.6.
  constexpr float others = 20.0f / 7 * 0.5f;
  CHECK(std::abs(filtered_at(ao, edges, 12, 8, FilterAxis::y, 2.5f) - (0.3f + others * 0.9f) / (1 + others)) <
        1e-5f);
}
