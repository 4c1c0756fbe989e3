// Neural materials: files, the equations of sdk's material/neural.h, and what lies outside of the samples.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/reflectance.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::material;

namespace {

// A side that is not a multiple of four.
constexpr test::SampleSize small = {.width = 7, .height = 9, .channels = 8};

Material small_neural() {
  return test::sample_material(3, small);
}

MaterialTables tables_of(const Material& material) {
  return make_tables(material, {}, default_memory());
}

// The equations in doubles, from the numbers of the file.
struct Network {
  const Neural& neural;
  NeuralLayout at{neural.shape};

  double weight(std::size_t i) const { return double(from_half(neural.weights[i])); }

  // The signed BC4 of RGTC, rounded to bytes.
  double texel(std::uint32_t channel, long x, long y) const {
    const auto& s = neural.shape;
    const auto wrap = [](long i, std::uint32_t side) {
      return std::size_t((i % long(side) + long(side)) % long(side));
    };
    const std::size_t column = wrap(x, s.width), row = wrap(y, s.height);
    const std::size_t block = (channel * ((s.height + 3) / 4) + row / 4) * ((s.width + 3) / 4) + column / 4;
    const std::uint8_t* const bytes = &neural.blocks[8 * block];
    const std::size_t bit = 3 * (row % 4 * 4 + column % 4);
    const unsigned two =
        unsigned(bytes[2 + bit / 8]) | (bit / 8 < 5 ? unsigned(bytes[3 + bit / 8]) << 8 : 0u);
    const unsigned code = two >> bit % 8 & 7;
    const double upper = std::int8_t(bytes[0]), lower = std::int8_t(bytes[1]);
    const double value = code == 0   ? upper
                         : code == 1 ? lower
                                     : ((8.0 - code) * upper + (code - 1.0) * lower) / 7;
    return std::round(value) / 127;
  }
  double feature(std::uint32_t channel, double u, double v) const {
    const double x = u * neural.shape.width - 0.5, y = v * neural.shape.height - 0.5, fx = x - std::floor(x),
                 fy = y - std::floor(y);
    const long left = long(std::floor(x)), low = long(std::floor(y));
    return (1 - fy) * ((1 - fx) * texel(channel, left, low) + fx * texel(channel, left + 1, low)) +
           fy * ((1 - fx) * texel(channel, left, low + 1) + fx * texel(channel, left + 1, low + 1));
  }
  // Outputs of a layer whose bias stands behind its matrix.
  std::vector<double> layer(std::size_t where, std::vector<double> inputs, std::size_t outputs) const {
    inputs.push_back(1);
    std::vector<double> sums(outputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      for (std::size_t o = 0; o < outputs; ++o) sums[o] += weight(where + i * outputs + o) * inputs[i];
    return sums;
  }
  static void rectify(std::vector<double>& units) {
    for (double& unit : units) unit = std::max(unit, unit / 100);
  }
  std::vector<double> inputs(std::uint32_t first, std::uint32_t count, double u, double v, Vec3 view) const {
    std::vector<double> in;
    for (std::uint32_t c = 0; c < count; ++c) in.push_back(feature(first + c, u, v));
    in.insert(in.end(), {double(view.x), double(view.y), double(view.z)});
    return in;
  }
  std::vector<double> radiance(double u, double v, Vec3 view, Vec3 light) const {
    const auto& s = neural.shape;
    std::vector<double> units =
        layer(at.offset_in, inputs(s.channels, s.offset_channels, u, v, view), s.offset_units);
    rectify(units);
    double height = weight(at.offset_level);
    for (std::size_t i = 0; i < s.offset_units; ++i) height += weight(at.offset_out + i) * units[i];
    REQUIRE(std::abs(height) < 1);
    units = layer(at.position,
                  inputs(0, s.channels, u + double(view.x) / double(view.z) * height,
                         v + double(view.y) / double(view.z) * height, view),
                  s.units);
    const Vec3 half = normalised(view + light);
    const float lit[] = {light.x, light.y, light.z, half.x, half.y, half.z};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t o = 0; o < s.units; ++o)
        units[o] += weight(at.light + i * s.units + o) * double(lit[i]);
    rectify(units);
    for (std::size_t l = 0; l + 1 < s.layers; ++l) {
      units = layer(at.hidden + l * s.units * (s.units + 1), units, s.units);
      rectify(units);
    }
    std::vector<double> rgb = layer(at.out, units, 3);
    for (double& value : rgb) value = std::max(value, 0.0);
    return rgb;
  }
};

}  // namespace

TEST_CASE("a neural material has the same bits after its file, which is of version 4") {
  const Material material = small_neural();
  const std::vector<std::byte> file = write_material(material);
  CHECK(file[8] == std::byte{4});
  const Material read = read_material(file);
  CHECK(read.neural.shape == material.neural.shape);
  CHECK(read.neural.blocks == material.neural.blocks);
  CHECK(read.neural.weights == material.neural.weights);
  CHECK(write_material(read) == file);
  // Files of tensors are as before.
  CHECK(write_material(test::sample_material(3))[8] == std::byte{2});
}

TEST_CASE("a neural material gives what its equations give") {
  for (const std::uint32_t layers : {1u, 3u, 4u}) {
    test::SampleSize size = small;
    size.layers = layers;
    const Material material = test::sample_material(layers, size);
    const MaterialTables tables = tables_of(material);
    const Network network{material.neural};
    test::Numbers numbers(9);
    double brightest = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 view = material.views[numbers.below(8)], light = material.lights[numbers.below(4)];
      Sample sample{numbers.between(-2, 2), numbers.between(-2, 2), 0, view, light};
      if (i % 3 == 0) {  // a texel's centre
        sample.u = (float(numbers.below(7)) + 0.5f) / 7;
        sample.v = (float(numbers.below(9)) + 0.5f) / 9;
      }
      const Radiance got = evaluate_btf(tables, sample);
      const std::vector<double> want = network.radiance(double(sample.u), double(sample.v), view, light);
      // Some hundred products of floats up to about 3, and a place on the tile with the error of floats at 10
      // tiles, 1e-6, times the slope of features.
      CHECK(double(got.red) == Approx(want[0]).margin(2e-4));
      CHECK(double(got.green) == Approx(want[1]).margin(2e-4));
      CHECK(double(got.blue) == Approx(want[2]).margin(2e-4));
      brightest = std::max({brightest, want[0], want[1], want[2]});
    }
    CHECK(brightest > 0.3);
  }
}

TEST_CASE("the levels of a block are sevenths between its ends, rounded") {
  for (const auto& [upper, lower] : {std::pair(127, -127), {100, 93}, {-5, -90}, {3, 3}})
    for (std::uint32_t code = 0; code < 8; ++code) {
      const double down = code == 0 ? 0 : code == 1 ? 7 : code - 1.0;
      CHECK(neural_level(upper, lower, code) == std::lround(((7 - down) * upper + down * lower) / 7));
    }
}

TEST_CASE("the smallest mipmap of a neural material has the means of its features") {
  const Material material = test::sample_material(3, {.width = 16, .height = 8, .channels = 4});
  const NeuralTables tables = tables_of(material).neural;
  const Network network{material.neural};
  const std::size_t last = tables.size.level_offset(tables.size.levels - 1);
  for (std::uint32_t channel = 0; channel < 8; ++channel) {
    double mean = 0;
    for (long x = 0; x < 16; ++x)
      for (long y = 0; y < 8; ++y) mean += network.texel(channel, x, y) / 128;
    // Half of a step: means of means are rounded once.
    CHECK(std::abs(tables.features[last + channel] / 127.0 - mean) < 0.51 / 127);
  }
}

TEST_CASE("views and lights below the samples are taken from the rim, and light fades to the horizon") {
  Material material = small_neural();
  for (auto* set : {&material.views, &material.lights})
    set->assign({Vec3{0, 0, 1}, Vec3{0.6f, 0, 0.8f}, Vec3{0, 0.8f, 0.6f}});
  const MaterialTables tables = tables_of(material);
  // A sum of what is not black at some places.
  const auto seen = [&](Vec3 view, Vec3 light) {
    float sum = 0;
    for (const float u : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f}) {
      const Radiance at = evaluate_btf(tables, {u, 0.2f, 0, view, light});
      sum += at.red + at.green + at.blue;
    }
    return sum;
  };
  const Vec3 rim{0.8f, 0, 0.6f}, low = normalised({0.8f, 0, 0.2f}), up{0, 0, 1};
  REQUIRE(seen(rim, up) > 0.1f);
  CHECK(seen(low, up) == Approx(seen(rim, up)).epsilon(1e-4));
  CHECK(seen({0.9f, 0, -0.4f}, up) == Approx(seen(rim, up)).epsilon(1e-4));
  CHECK(seen(up, low) == Approx(seen(up, rim) * low.z / 0.6f).epsilon(1e-4));
  CHECK(seen(up, {1, 0, 0}) == 0);
  CHECK(seen(up, {0.6f, 0, -0.8f}) == 0);
}

TEST_CASE("a neural material with a fault is not written, and the message names it") {
  const auto refused = [](auto&& damage, const char* text) {
    Material material = small_neural();
    damage(material);
    try {
      write_material(material);
    } catch (const Failure& failure) {
      INFO(failure.what());
      return failure.code() == NOOK_ERROR_INVALID_ARGUMENT &&
             std::string(failure.what()).find(text) != std::string::npos;
    }
    return false;
  };
  CHECK(refused([](Material& m) { m.neural.shape.channels = 6; },
                "channels of the neural material is not a multiple"));
  CHECK(refused([](Material& m) { m.neural.shape.channels = 68; },
                "channels of the neural material is out of range"));
  CHECK(
      refused([](Material& m) { m.neural.shape.units = 0; }, "units of the neural material is out of range"));
  CHECK(refused([](Material& m) { m.neural.shape.layers = 5; }, "layers of the neural material"));
  CHECK(refused([](Material& m) { m.neural.shape.layers = 0; }, "layers of the neural material"));
  CHECK(refused([](Material& m) { m.neural.shape.offset_units = 68; }, "units of the offset"));
  CHECK(refused([](Material& m) { m.neural.shape.width = 0; }, "width in texels of the neural material"));
  CHECK(
      refused([](Material& m) { m.neural.shape.height = 1025; }, "height in texels of the neural material"));
  CHECK(refused([](Material& m) { m.neural.shape.height = 13; }, "blocks of the neural material"));
  CHECK(refused([](Material& m) { m.neural.weights.pop_back(); }, "weights of the neural material"));
  CHECK(refused([](Material& m) { m.neural.weights[7] = 0x7c00; },
                "weight 7 of the neural material is not finite"));
  CHECK(refused([](Material& m) { m.neural.weights[8] = 0xfe01; }, "weight 8"));
  CHECK(refused([](Material& m) { m.neural.blocks[8] = 0x80; }, "end values of block 1"));
  CHECK(refused([](Material& m) { m.neural.blocks[17] = 0x80; }, "end values of block 2"));
  CHECK(refused([](Material& m) { m.btf.cores.push_back(0); }, "cores of the neural material"));
  CHECK(refused([](Material& m) { m.light_basis.push_back(0); }, "light basis of the neural material"));
  CHECK(refused([](Material& m) { m.relief.high = 0.1f; }, "has a relief"));
}

TEST_CASE("the largest weights of a neural material give finite radiances") {
  Material material =
      test::sample_material(3, {.width = 4, .height = 4, .channels = 64, .units = 64, .layers = 4});
  for (std::uint16_t& weight : material.neural.weights) weight = 0x7bff;
  std::fill(material.neural.blocks.begin(), material.neural.blocks.end(), std::uint8_t{127});
  const MaterialTables tables = tables_of(material);
  for (const Vec3 view : material.views) {
    const Radiance got = evaluate_btf(tables, {0.3f, 0.2f, 0, view, material.lights[0]});
    CHECK(std::isfinite(got.red + got.green + got.blue));
  }
}
