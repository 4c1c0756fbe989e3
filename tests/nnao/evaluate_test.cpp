#include "sdk/src/nnao/network_evaluate.h"

#include <limits>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/catch.h"
#include "tests/nnao/network_sample.h"

using namespace nook;
using namespace nook::nnao;

namespace {

constexpr float sky = std::numeric_limits<float>::infinity();

// A G-buffer that owns its pixels.
struct Picture {
  std::uint32_t width, height;
  ScreenRays rays;
  std::vector<float> depth;
  std::vector<Vec3> normal;

  View view() const { return {width, height, rays, depth, normal}; }
};

// 90 degrees across the height, or 4 m for an orthographic one.
ScreenRays test_rays(std::uint32_t width, std::uint32_t height, bool orthographic) {
  const float aspect = float(width) / float(height);
  const float perspective[16] = {1 / aspect, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
  const float parallel[16] = {0.5f / aspect, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -0.1f, 0, 0, 0, 0, 1};
  return screen_rays(orthographic ? parallel : perspective, width, height);
}

// The plane through `point` with normal `normal`, both in view space.
Picture plane(Vec3 point, Vec3 normal, bool orthographic) {
  Picture picture{96, 64, test_rays(96, 64, orthographic), {}, {}};
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const Vec3 at_1 = view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      float depth;
      if (orthographic)
        depth = -(point.z - (normal.x * (at_1.x - point.x) + normal.y * (at_1.y - point.y)) / normal.z);
      else
        depth = dot(point, normal) / dot(at_1, normal);
      picture.depth.push_back(depth > 0 ? depth : sky);
      picture.normal.push_back(normal);
    }
  return picture;
}

float unclamped(const Network& network, const View& view, const Sampling& sampling, std::uint32_t x,
                std::uint32_t y, TapNoise noise) {
  return evaluate_unclamped(network, view, view.normal[view.at(x, y)], sampling, x, y, noise);
}

}  // namespace

TEST_CASE("positions and scales agree with the projection matrix, off-centre and orthographic too") {
  for (const bool orthographic : {false, true}) {
    const float p[16] = {1.2f,
                         0,
                         0,
                         orthographic ? 0.0f : 0.0f,
                         0,
                         -1.7f,
                         0,
                         0,
                         orthographic ? 0 : 0.3f,
                         orthographic ? 0 : -0.2f,
                         -1.01f,
                         orthographic ? 0.0f : -1.0f,
                         orthographic ? 0.1f : 0,
                         orthographic ? -0.4f : 0,
                         -0.2f,
                         orthographic ? 1.0f : 0.0f};
    const ScreenRays rays = screen_rays(p, 640, 360);
    REQUIRE(rays.orthographic == orthographic);
    const Vec3 v{0.4f, -0.7f, -3.1f};
    const float w = orthographic ? 1 : 3.1f;
    const float px = ((p[0] * v.x + p[8] * v.z + p[12]) / w + 1) * 320;
    const float py = ((p[5] * v.y + p[9] * v.z + p[13]) / w + 1) * 180;
    // Rounding of a few float operations on numbers up to 640.
    CHECK(length(view_position(rays, px, py, 3.1f) - v) < 1e-5f);
    // Some hundreds of pixels a metre, to float's precision.
    CHECK(std::abs(pixel_scale(rays, 3.1f).x - p[0] * 320 / w) < 1e-3f);
    CHECK(std::abs(pixel_scale(rays, 3.1f).y - p[5] * 180 / w) < 1e-3f);
  }
}

TEST_CASE("sky is exactly 1, and to its neighbours the same as a surface far away") {
  const Picture open = plane({0, 0, -3}, {0, 0, 1}, true);
  Picture holed = open;
  holed.depth[32 * 96 + 10] = sky;
  holed.depth[32 * 96 + 11] = std::numeric_limits<float>::quiet_NaN();
  for (const NetworkForm form : {NetworkForm::paper, NetworkForm::horizon}) {
    const Network network = test::sample_network(form);
    const Sampling sampling{0.5f, 256, 64};
    CHECK(evaluate_pixel(network, holed.view(), sampling, 10, 32) == 1);
    CHECK(evaluate_pixel(network, holed.view(), sampling, 11, 32) == 1);
    const float far = unclamped(network, holed.view(), sampling, 60, 32, {});
    CHECK(far == unclamped(network, open.view(), sampling, 60, 32, {}));
    // 10 km away is as far as the sky, to float's precision: a ten thousandth of the distances to the taps.
    Picture deep = holed;
    deep.depth[32 * 96 + 10] = deep.depth[32 * 96 + 11] = 1e4f;
    const float near_sky = unclamped(network, holed.view(), sampling, 12, 32, {});
    CHECK(std::abs(near_sky - unclamped(network, deep.view(), sampling, 12, 32, {})) < 1e-3f);
    // The paper's form takes neither into account; in the horizon form nothing darkens without a thing that
    // is near and above the plane.
    CHECK(near_sky >= unclamped(network, open.view(), sampling, 12, 32, {}));
  }
}

TEST_CASE("what lies two radii behind a silhouette darkens nothing, whatever the network") {
  // A near plane ends in the middle of the image.
  Picture edge = plane({0, 0, -3}, {0, 0, 1}, true);
  for (std::uint32_t y = 0; y < edge.height; ++y)
    for (std::uint32_t x = 48; x < edge.width; ++x) edge.depth[edge.view().at(x, y)] = 4.5f;
  for (std::uint32_t seed = 1; seed < 6; ++seed) {
    const Network network = test::sample_network(NetworkForm::horizon, seed);
    for (const std::uint32_t taps : {9u, 16u, 64u})
      for (std::uint32_t x = 40; x < 48; ++x)
        CHECK(unclamped(network, edge.view(), {0.5f, 256, taps}, x, 32, tap_noise(x, 32)) >= 1);
  }
}

TEST_CASE("off the screen a tap is the nearest pixel on it, and the distance from the border is an input") {
  const Sampling sampling{0.5f, 256, 64};
  const Network network = test::sample_network(NetworkForm::horizon);
  for (const Vec3 tilt : {Vec3{0, 0, 1}, Vec3{0.3f, 0.5f, 1}}) {
    const Picture open = plane({0, 0, -3}, normalised(tilt), true);
    // The texels beyond the border repeat those at it.
    CHECK(clamped_texel(open.view(), 2, 3, {-10, 0}).x == 0);
    CHECK(clamped_texel(open.view(), 95, 63, {5, 400}).x == 95);
    CHECK(clamped_texel(open.view(), 95, 63, {5, 400}).y == 63);
    // The radius is 8 pixels, and a pixel's centre lies half a pixel inside.
    CHECK(border_distance(open.view(), 48, 0, 8) == 0.5f / 8);
    CHECK(border_distance(open.view(), 93, 30, 8) == 2.5f / 8);
    CHECK(border_distance(open.view(), 48, 32, 8) == 1);
    // An open plane is exactly open, to the border and beyond.
    for (const std::uint32_t y : {0u, 1u, 32u, 63u})
      CHECK(std::abs(unclamped(network, open.view(), sampling, 48, y, {}) - 1) < 1e-3f);
  }
  // The distance from the border is the last value of the third layer's gate.
  Picture ridge = plane({0, 0, -3}, {0, 0, 1}, true);
  for (std::uint32_t y = 0; y < ridge.height; ++y) ridge.depth[y * ridge.width + 50] = 2.8f;
  Network blind = network;
  std::fill_n(blind.horizon.join.gate_weights.end() - HorizonNetwork::units, HorizonNetwork::units, 0.0f);
  const auto seen = [&](std::uint32_t y) {
    return unclamped(network, ridge.view(), sampling, 48, y, {}) -
           unclamped(blind, ridge.view(), sampling, 48, y, {});
  };
  CHECK(seen(0) != seen(32));
  CHECK(seen(30) == seen(32));

  // A screen of one pixel is a plane whose taps all are the pixel.
  const std::vector<float> depth{2};
  const std::vector<Vec3> normal{{0, 0, 1}};
  const View pixel{1, 1, test_rays(1, 1, false), depth, normal};
  const HorizonTapInput input =
      horizon_tap_input(pixel, clamped_texel(pixel, 0, 0, {9, 9}), {0, 0, -2}, {0, 0, 1}, {0, 0, 1}, 0.5f);
  CHECK((input == HorizonTapInput{0, 0, 0, 0}));
  // Where a compiler rounds the position otherwise at the pixel than at the tap, by a few units in the last
  // place of 2 m, the direction between the two is at random. A pixel of one in 1,000 of the depth, as of
  // 1080 rows, is 2 mm.
  const View small{1, 1, {1e-3f, 0, 1e-3f, 0, false}, depth, normal};
  const float unit = 2.4e-7f;
  for (const float x : {-unit, unit})
    for (const float z : {-3 * unit, 3 * unit}) {
      const HorizonTapInput rounded =
          horizon_tap_input(small, clamped_texel(small, 0, 0, {9, 9}), {5e-4f * 2 + x, 5e-4f * 2 - x, -2 + z},
                            {0, 0, 1}, {0, 0, 1}, 0.5f);
      // 7e-7 m over half a pixel of 1 mm.
      for (const float value : rounded) CHECK(std::abs(value) < 1e-3f);
    }
  const float ao = evaluate_pixel(network, pixel, sampling, 0, 0);
  CHECK((ao >= 0 && ao <= 1));
}

TEST_CASE("the units shown in pictures are those that the network goes on with") {
  const Picture picture = plane({0, 0, -3}, normalised({0.2f, 0.6f, 1}), false);
  const Sampling sampling{0.5f, 256, 64};
  // A join that takes one unit through to the output and nothing else.
  for (std::size_t u = 0; u < 3; ++u) {
    Network network = test::sample_network(NetworkForm::horizon);
    HorizonNetwork& h = network.horizon;
    h.join = {};
    h.out = {};
    h.join.weights[u * 4] = h.out[0] = 1;
    h.join.slope.fill(1);
    CHECK(1 + first_units(network, picture.view(), sampling, 40, 30)[u] ==
          unclamped(network, picture.view(), sampling, 40, 30, tap_noise(40, 30)));
    Network paper = test::sample_network(NetworkForm::paper);
    PaperNetwork& p = paper.paper;
    for (auto* layer : {&p.layer_1, &p.layer_2}) {
      *layer = {};
      layer->weights[u * 4 + u] = 1;
      layer->negative_slope.fill(1);
      layer->positive_slope.fill(1);
    }
    p.layer_3 = {};
    p.layer_3.weights[u] = 1;
    p.layer_3.negative_slope.fill(1);
    p.layer_3.positive_slope.fill(1);
    CHECK(first_units(paper, picture.view(), sampling, 40, 30)[u] ==
          unclamped(paper, picture.view(), sampling, 40, 30, tap_noise(40, 30)));
  }
}

TEST_CASE("on a plane that faces the viewer each form has a value that a hand computes") {
  const Picture picture = plane({0, 0, -3}, {0, 0, 1}, true);
  const Sampling sampling{0.5f, 256, 64};

  // Normals agree and depths do not differ: every input of the paper's form is 0, the biases alone speak.
  Network network = test::sample_network(NetworkForm::paper);
  const auto sums = [](const auto& dense, const auto& input) {
    std::vector<double> out(dense.bias.begin(), dense.bias.end());
    for (std::size_t u = 0; u < out.size(); ++u)
      for (std::size_t i = 0; i < input.size(); ++i)
        out[u] += double(dense.weights[i * out.size() + u]) * input[i];
    return out;
  };
  const auto layer = [&](const auto& dense, const auto& input) {
    std::vector<double> out = sums(dense, input);
    for (std::size_t u = 0; u < out.size(); ++u)
      out[u] *= double(out[u] > 0 ? dense.positive_slope[u] : dense.negative_slope[u]);
    return out;
  };
  const auto gated = [](const auto& dense, const std::vector<double>& input,
                        const std::vector<double>& gate) {
    std::vector<double> out(4);
    for (std::size_t u = 0; u < 4; ++u) {
      double factor = 1;
      for (std::size_t i = 0; i < input.size(); ++i) out[u] += double(dense.weights[4 * i + u]) * input[i];
      for (std::size_t i = 0; i < gate.size(); ++i) factor += double(dense.gate_weights[4 * i + u]) * gate[i];
      out[u] *= factor;
      out[u] = std::max(out[u], double(dense.slope[u]) * out[u]);
    }
    return out;
  };
  std::vector<double> hidden(4);
  for (std::size_t u = 0; u < 4; ++u) {
    const float b = network.paper.bias[u];
    hidden[u] = double(b * (b > 0 ? network.paper.positive_slope[u] : network.paper.negative_slope[u]));
  }
  const double paper =
      layer(network.paper.layer_3, layer(network.paper.layer_2, layer(network.paper.layer_1, hidden)))[0];
  CHECK(std::abs(unclamped(network, picture.view(), sampling, 48, 32, {}) - paper) < 1e-5);

  // Every tap of the horizon form sees a wall one metre before the plane: at 45 degrees where it is 1 m away.
  const Sampling wide{1, 256, 64};
  network = test::sample_network(NetworkForm::horizon);
  Picture hole = plane({0, 0, -3}, {0, 0, 1}, true);
  for (float& depth : hole.depth) depth = 2;
  hole.depth[hole.view().at(48, 32)] = 3;
  const TapNoise noise = tap_noise(48, 32);
  std::vector<double> joined(4);
  double bound = 0;
  Vec3 bent{0, 0, 1};
  for (std::uint32_t d = 0; d < 8; ++d) {
    const float angle = direction_angle(d, 8, noise);
    std::vector<double> pooled(8);
    double highest = 0;
    for (std::uint32_t s = 0; s < 8; ++s) {
      // 64 pixels are 4 m, so the radius is 16 pixels.
      const float distance = step_distance_px(s, 8, noise, 16);
      const double x = std::floor(48.5f + distance * std::cos(angle)) - 48;
      const double y = std::floor(32.5f + distance * std::sin(angle)) - 32;
      const double away = std::hypot(x / 16, y / 16, 1.0), elevation = 1 / away;
      const double nearness = std::max(1 - away / 2, 0.0);
      highest = std::max(highest, elevation * nearness);
      const double input[] = {elevation, elevation * elevation, elevation * nearness,
                              elevation * elevation * nearness};
      for (std::size_t u = 0; u < 4; ++u) {
        double h = 0;
        for (std::size_t i = 0; i < 4; ++i) h += double(network.horizon.tap.weights[4 * i + u]) * input[i];
        h = std::max(h - double(network.horizon.tap.threshold[u]), 0.0);
        pooled[u] = std::max(pooled[u], h);
        pooled[4 + u] += h / 8;
      }
    }
    // The normal is the direction to the viewer.
    const std::vector<double> out = gated(network.horizon.direction, pooled, {0, 1});
    for (std::size_t u = 0; u < 4; ++u) joined[u] += out[u] / 8;
    bound += NOOK_HORIZON_BOUND * highest / 8;
    double lean[2] = {};
    for (std::size_t u = 0; u < 2; ++u) {
      for (std::size_t i = 0; i < 8; ++i)
        lean[u] += double(network.horizon.bent.weights[2 * i + u]) * pooled[i];
      lean[u] *= 1 + double(network.horizon.bent.gate_weights[2 + u]);
    }
    bent +=
        float(lean[0] / 8) * Vec3{std::cos(angle), std::sin(angle), 0} + float(lean[1] / 8) * Vec3{0, 0, 1};
  }
  // The border is more than a radius away.
  const std::vector<double> last = gated(network.horizon.join, joined, {1, 1});
  double darkness = 0;
  for (std::size_t u = 0; u < 4; ++u) darkness -= double(network.horizon.out[u]) * last[u];
  const Openness found = evaluate_openness(network, hole.view(), {0, 0, 1}, wide, 48, 32, noise);
  // Sums of some hundred products in float.
  CHECK(std::abs(double(found.ao) - (1 - std::min(darkness, bound))) < 1e-4);
  CHECK(length(found.bent_normal - normalised(bent)) < 1e-4f);
}

TEST_CASE("the embedded network leaves open planes open and darkens a corner") {
  const Network network = read_network(default_network_file());
  for (const std::uint32_t taps : {9u, 16u, 32u, 64u, 128u, 256u})
    for (const Vec3 tilt : {Vec3{0, 0, 1}, Vec3{0.3f, 0.5f, 1}, Vec3{-1, 0.2f, 1}}) {
      const Picture picture = plane({0, 0, -3}, normalised(tilt), false);
      const float ao = evaluate_pixel(network, picture.view(), {0.6f, 256, taps}, 48, 32);
      // 1 by ray tracing; the network was trained to a root mean square error of 0.05.
      CHECK(ao > 0.94f);
    }
  // A floor that meets a wall: half of the hemisphere at the wall's foot is hidden within any radius.
  Picture corner = plane({0, -0.5f, 0}, {0, 1, 0}, true);
  for (std::uint32_t y = 0; y < corner.height; ++y)
    for (std::uint32_t x = 0; x < corner.width; ++x) {
      // Seen at 45 degrees from above: the floor below the middle row, the wall above, both receding from it.
      const Vec3 at = view_position(corner.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      const bool wall = at.y > 0;
      corner.depth[corner.view().at(x, y)] = 5 - std::abs(at.y);
      corner.normal[corner.view().at(x, y)] = normalised(wall ? Vec3{0, -1, 1} : Vec3{0, 1, 1});
    }
  for (const std::uint32_t taps : {9u, 16u, 32u, 64u, 128u, 256u}) {
    // A filter shows the mean over the noise. The network was trained to a root mean square error of 0.06.
    float ao = 0;
    for (std::uint32_t rank = 0; rank < NOOK_NOISE_COUNT; ++rank)
      ao += unclamped(network, corner.view(), {1, 256, taps}, 48, 31, tap_noise_of_rank(rank)) /
            NOOK_NOISE_COUNT;
    CHECK(std::abs(ao - 0.5f) < 0.08f);
  }
}

TEST_CASE("a clamped radius is a smaller radius") {
  const Picture picture = plane({0, 0, -2}, normalised({0.2f, 0.6f, 1}), false);
  for (const NetworkForm form : {NetworkForm::paper, NetworkForm::horizon}) {
    const Network network = test::sample_network(form);
    const PixelScale scale = pixel_scale(picture.rays, picture.depth[32 * 96 + 48]);
    const Sampling clamped{5, 12, 64}, small{12 / std::abs(scale.y), 256, 64};
    // The two radii differ by a rounding.
    CHECK(std::abs(unclamped(network, picture.view(), clamped, 48, 32, {}) -
                   unclamped(network, picture.view(), small, 48, 32, {})) < 1e-5f);
  }
}

TEST_CASE("evaluate refuses what it cannot evaluate") {
  const Picture picture = plane({0, 0, -3}, {0, 0, 1}, true);
  std::vector<float> ao(picture.depth.size());
  const Network horizon = test::sample_network(NetworkForm::horizon);
  evaluate(horizon, picture.view(), {0.5f, 256, 16}, ao);
  for (const float value : ao) CHECK((value >= 0 && value <= 1));
  CHECK_THROWS_AS(evaluate(horizon, picture.view(), {0.5f, 256, 48}, ao), Failure);
  CHECK_THROWS_AS(evaluate(horizon, picture.view(), {0, 256, 64}, ao), Failure);
  CHECK_THROWS_AS(evaluate(horizon, picture.view(), {NAN, 256, 64}, ao), Failure);
  CHECK_THROWS_AS(evaluate(horizon, picture.view(), {1, 0, 64}, ao), Failure);
  CHECK_THROWS_AS(evaluate(test::sample_network(NetworkForm::paper), picture.view(), {1, 256, 962}, ao),
                  Failure);
  ao.pop_back();
  CHECK_THROWS_AS(evaluate(horizon, picture.view(), {0.5f, 256, 16}, ao), Failure);
}
