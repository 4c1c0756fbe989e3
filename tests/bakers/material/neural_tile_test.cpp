#include "bakers/material/neural_tile.h"

#include <tbb/task_arena.h>

#include <cmath>

#include "bakers/material/btf_error.h"
#include "bakers/material/neural_pass.h"
#include "bakers/material/neural_training.h"
#include "bakers/material/raw_material.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;

namespace {

struct Numbers {
  NeuralShape shape;
  std::vector<float> features, offset_features, weights;
  NeuralNumbers view() const { return {shape, features, offset_features, weights}; }
};

Numbers random_numbers() {
  Numbers n;
  n.shape = {{6, 5, 3, 5, 3, 2, 3}, 2, 0.3f};
  Random random(5);
  const auto fill = [&](std::vector<float>& values, std::size_t count, float scale) {
    values.resize(count);
    for (float& v : values) v = random.between(-scale, scale);
  };
  fill(n.features, n.shape.nodes() * n.shape.texels() * n.shape.channels, 1);
  fill(n.offset_features, n.shape.texels() * n.shape.offset_channels, 1);
  const NeuralLayout at(n.shape);
  fill(n.weights, at.count, 0.7f);
  for (std::size_t i = at.offset_out; i <= at.offset_level; ++i) n.weights[i] *= 0.3f;  // within a tile
  return n;
}

NeuralPass random_pass() {
  const std::vector<Vec3> directions = spiral_directions(12, 69);
  NeuralPass pass;
  for (std::uint32_t i = 0; i < 7; ++i) {
    pass.positions.push_back({directions[i + 3], 4 * i + 1});
    for (std::uint32_t l = 0; l < 3; ++l) pass.lights.push_back(directions[(5 * i + l) % 12]);
  }
  return pass;
}

// A sum of the output with random shares.
double loss_of(const Numbers& n, NeuralPass& pass, const Eigen::MatrixXf& shares) {
  pass.forward(n.view());
  return pass.out.cast<double>().cwiseProduct(shares.cast<double>()).sum();
}

// The length of the difference between a gradient and central differences, over the gradient's length.
double difference(Numbers& n, std::vector<float> Numbers::*values, const std::vector<float>& gradient,
                  NeuralPass& pass, const Eigen::MatrixXf& shares, float step) {
  double off = 0, length = 0;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    float& value = (n.*values)[i];
    const float before = value;
    value = before + step;
    const double above = loss_of(n, pass, shares);
    value = before - step;
    const double slope = (above - loss_of(n, pass, shares)) / (2 * double(step));
    value = before;
    off += std::pow(slope - double(gradient[i]), 2);
    length += std::pow(double(gradient[i]), 2);
  }
  CHECK(length > 0);
  return std::sqrt(off / length);
}

}  // namespace

TEST_CASE("the gradient of a neural tile equals finite differences") {
  Numbers n = random_numbers();
  NeuralPass pass = random_pass();
  const Eigen::MatrixXf shares = Eigen::MatrixXf::Random(3, Eigen::Index(pass.lights.size()));
  pass.forward(n.view());
  pass.out = shares;
  pass.backward(n.view());
  const std::vector<float> weights = pass.weights;
  std::vector<float> features(n.features.size()), offset_features(n.offset_features.size());
  pass.scatter(n.shape, features, offset_features);
  // Rounding of floats over the step gives 1e-3, and 5e-3 for the small gradient of offsets over a larger
  // step; a unit whose sign changes within a step gives more.
  CHECK(difference(n, &Numbers::weights, weights, pass, shares, 1e-3f) < 0.01);
  CHECK(difference(n, &Numbers::features, features, pass, shares, 1e-3f) < 0.01);
  CHECK(difference(n, &Numbers::offset_features, offset_features, pass, shares, 1e-2f) < 0.01);
}

TEST_CASE("a neural tile changes little between views that differ little") {
  const Numbers n = random_numbers();
  const NeuralTile tile{n.shape, n.features, n.offset_features, n.weights};
  const std::vector<Vec3> lights = spiral_directions(4, 69);
  const auto seen = [&](int step) {  // 3,000 steps of 0.12 degrees around, at a tilt of 46 degrees
    const float azimuth = 6.2831853f * float(step) / 3000;
    return draw_neural_tile(tile, {0.72f * std::cos(azimuth), 0.72f * std::sin(azimuth), 0.694f}, lights);
  };
  tensor::Matrix before = seen(0);
  float smallest = before.minCoeff(), largest = before.maxCoeff(), jump = 0;
  for (int step = 1; step <= 3000; ++step) {
    const tensor::Matrix now = seen(step);
    jump = std::max(jump, (now - before).cwiseAbs().maxCoeff());
    smallest = std::min(smallest, now.minCoeff());
    largest = std::max(largest, now.maxCoeff());
    before = now;
  }
  // A step is a five hundredth of the radius; another node of the map of views would be the whole range.
  CHECK(jump < 0.05f * (largest - smallest));
}

TEST_CASE("blocks round to eight levels between the ends of each channel") {
  NeuralShape shape;
  shape.width = 6;  // blocks of two texels at the rim
  shape.height = 9;
  constexpr std::uint32_t channels = 2;
  Random random(3);
  std::vector<float> features(3 * shape.texels() * channels), rounded(features.size());
  for (std::size_t i = 0; i < features.size(); ++i)
    features[i] = i % channels ? 0.25f : random.between(-1, 1);
  round_to_blocks(shape, channels, features, rounded);
  for (std::size_t i = 0; i < features.size(); ++i)
    // Half of a level of the widest block, and half of a step at its ends and at the level.
    REQUIRE(std::abs(rounded[i] - features[i]) <= (i % channels ? 0.0f : 1.0f / 7) + 1.0f / 127 + 1e-6f);
  std::vector<float> again(features.size());
  round_to_blocks(shape, channels, rounded, again);
  for (std::size_t i = 0; i < again.size(); ++i) REQUIRE(again[i] == Approx(rounded[i]).margin(1e-6));
}

namespace {

// A matt plane of two colours with a broad lobe around the mirrored light.
RawMaterial planted() {
  RawMaterial raw;
  raw.lights = raw.views = spiral_directions(16, 69);
  raw.width = raw.height = 8;
  raw.btf.resize(raw.light_rows() * raw.views.size() * raw.texels());
  for (std::size_t l = 0; l < 16; ++l)
    for (std::size_t v = 0; v < 16; ++v)
      for (std::size_t t = 0; t < raw.texels(); ++t) {
        const float stripes = 0.5f + 0.4f * std::cos(0.7853982f * (float(t / 8) + 0.5f));
        const float gloss = std::pow(normalised(raw.lights[l] + raw.views[v]).z, 12.0f);
        const float colour[] = {stripes, 0.3f, 1 - stripes};
        for (std::size_t c = 0; c < 3; ++c)
          raw.btf[((3 * l + c) * 16 + v) * raw.texels() + t] =
              raw.lights[l].z * (0.3f * colour[c] + 0.1f * gloss);
      }
  return raw;
}

NeuralSettings few_steps(std::uint32_t steps) {
  NeuralSettings s;
  s.shape.channels = 4;
  s.shape.units = 16;
  s.offset_steps = std::min(steps, 100u);
  s.steps = steps;
  s.positions = 192;
  return s;
}

}  // namespace

TEST_CASE("a neural tile finds a planted material") {
  const RawMaterial raw = planted();
  const NeuralTile tile = fit_neural_tile(raw, few_steps(1500));
  // The mean of all texels has 8 dB, the best matt plane 16 dB.
  CHECK(measure_neural_tile(raw, tile).se_db() > 23);
  // Four blocks of eight bytes for each channel.
  CHECK(tile.bytes() == 4 * 8 * (4 + 8) + 2 * tile.weights.size());
}

TEST_CASE("a file draws the neural tile that was trained") {
  const RawMaterial raw = planted();
  NeuralSettings settings = few_steps(60);
  settings.shape.offset_channels = settings.shape.offset_units = 4;
  const NeuralTile tile = fit_neural_tile(raw, settings);
  nook::material::Material material;
  material.lights.assign(raw.lights.begin(), raw.lights.end());
  material.views.assign(raw.views.begin(), raw.views.end());
  material.neural = encoded(tile);
  const nook::material::Material read = nook::material::quantise(material);
  // The same features and weights; sums in another order.
  CHECK(measure_btf(raw, read).se_db() == Approx(measure_neural_tile(raw, tile).se_db()).margin(1e-3));
  for (std::size_t view : {0u, 7u, 15u}) {
    const tensor::Matrix trained = draw_neural_tile(tile, raw.views[view], raw.lights),
                         drawn = decode_btf_view(read, view);
    CHECK((trained - drawn).cwiseAbs().maxCoeff() < 1e-4f);
    CHECK(trained.maxCoeff() > 0.05f);
  }
}

TEST_CASE("a bake by the method neural has a network, and the visibility of K-CTA") {
  RawMaterial raw = planted();
  raw.mask.assign(raw.views.size() * raw.texels(), 1);
  for (std::size_t i = 0; i < raw.mask.size(); i += 3) raw.mask[i] = 0;
  CompressionSettings s;
  s.method = Method::neural;
  s.neural_channels = 8;
  s.neural_steps = 20;
  s.rank_view = 8;
  s.rank_x = s.rank_y = s.votf_rank_x = s.votf_rank_y = 8;
  s.map_side = 6;
  s.mixture = 2;
  s.bits = 8;
  const nook::material::Material material = nook::material::quantise(compress(raw, s));
  CHECK(material.neural.shape.channels == 8);
  CHECK(material.btf.cores.empty());
  CHECK(material.visibility == nook::material::VisibilityForm::distance);
  CHECK(material.votf.map.side == 6);
  for (const std::uint32_t channels : {0u, 6u, 68u}) {
    s.neural_channels = channels;
    CHECK_THROWS_AS(check_settings(s, raw), Failure);
  }
  s.neural_channels = 8;
  s.relief = ReliefSource::estimated;
  CHECK_THROWS_AS(check_settings(s, raw), Failure);
}

TEST_CASE("a neural tile has the same bits on any number of threads") {
  const RawMaterial raw = planted();
  NeuralTile tiles[2];
  for (const int threads : {1, 3})
    tbb::task_arena(threads).execute([&] { tiles[threads / 2] = fit_neural_tile(raw, few_steps(40)); });
  CHECK(tiles[0].weights == tiles[1].weights);
  CHECK(tiles[0].features == tiles[1].features);
  CHECK(tiles[0].offset_features == tiles[1].offset_features);
}

TEST_CASE("radiance that half floats cannot hold is refused before the training") {
  for (const float factor : {1e-6f, 1e8f}) {
    RawMaterial raw = planted();
    for (float& value : raw.btf) value *= factor;
    std::size_t calls = 0;
    const auto count = [&](const char*, std::size_t, std::size_t) { return ++calls > 0; };
    CHECK_THROWS_AS(fit_neural_tile(raw, few_steps(40), count), Failure);
    CHECK(calls == 0);
  }
}

TEST_CASE("the training of a neural tile can be stopped") {
  const RawMaterial raw = planted();
  for (const std::size_t last : {50u, 120u}) {
    std::size_t calls = 0;
    CHECK_THROWS_AS(fit_neural_tile(raw, few_steps(1000),
                                    [&](const char*, std::size_t, std::size_t) { return ++calls < last; }),
                    Failure);
    CHECK(calls == last);
  }
}

TEST_CASE("the shape of a neural tile fills the bytes of a file") {
  RawMaterial raw = planted();
  for (const std::size_t bytes : {6000u, 20000u, 60000u}) {
    const NeuralShape shape = filling_neural_shape(raw, bytes);
    CHECK(neural_bytes(shape) <= bytes);
    NeuralShape larger = shape;
    larger.channels += 2;
    CHECK((shape.channels == 64 || neural_bytes(larger) > bytes));
    CHECK(shape.view_side <= 4);
  }
}
