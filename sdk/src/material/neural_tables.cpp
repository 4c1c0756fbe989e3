#include "sdk/src/material/neural_tables.h"

#include <cmath>
#include <utility>

#include "sdk/src/core/floats.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/neural.h"

namespace nook::material {

NeuralLayout::NeuralLayout(const NeuralShape& s) {
  std::size_t end = 0;
  const auto take = [&end](std::size_t numbers) { return std::exchange(end, end + numbers); };
  offset_in = take(std::size_t(s.offset_channels + neural_view_inputs) * s.offset_units);
  offset_bias = take(s.offset_units);
  offset_out = take(s.offset_units);
  offset_level = take(1);
  position = take(std::size_t(s.channels + neural_view_inputs) * s.units);
  position_bias = take(s.units);
  light = take(std::size_t(neural_light_inputs) * s.units);
  hidden = take(std::size_t(s.layers - 1) * s.units * (s.units + 1));
  out = take(std::size_t(3) * s.units);
  out_bias = take(3);
  count = end;
}

namespace {

// Decodes level 0 of a channel. Values are 127 times the features.
void decode_channel(const Neural& neural, std::uint32_t channel, std::span<float> image) {
  const NeuralShape& s = neural.shape;
  const std::uint32_t columns = (s.width + 3) / 4;
  const std::uint8_t* block = &neural.blocks[neural_block_bytes * s.blocks() * channel];
  for (std::size_t b = 0; b < s.blocks(); ++b, block += neural_block_bytes) {
    const RgtcBlock read = read_rgtc(block);
    const auto x = std::uint32_t(b % columns * 4), y = std::uint32_t(b / columns * 4);
    for (std::uint32_t i = 0; i < 16; ++i)
      if (x + i % 4 < s.width && y + i / 4 < s.height)
        image[std::size_t(y + i / 4) * s.width + x + i % 4] =
            float(neural_level(read.upper, read.lower, read.code[i]));
  }
}

void add_levels(NeuralTables& tables, std::uint32_t channel, Vector<float>& image, Vector<float>& smaller) {
  const ImageSize& size = tables.size;
  for (std::uint32_t level = 0; level < size.levels; ++level) {
    const std::uint32_t w = level_size(size.width, level), h = level_size(size.height, level);
    std::int8_t* const to =
        &tables.features[size.level_offset(level) + std::size_t(channel / 4) * w * h * 4 + channel % 4];
    for (std::size_t i = 0; i < std::size_t(w) * h; ++i) to[4 * i] = std::int8_t(std::nearbyint(image[i]));
    if (level + 1 == size.levels) return;
    halve(image, w, h, smaller);
    std::swap(image, smaller);
  }
}

float lowest_z(std::span<const Vec3> directions) {
  float lowest = 1;
  for (const Vec3 d : directions) lowest = std::min(lowest, d.z);
  return lowest;
}

// If a direction is lower than the lowest sampled direction, raises it to the same height.
Vec3 raised(Vec3 d, float lowest) {
  if (d.z >= lowest) return d;
  const float scale = std::sqrt(1 - lowest * lowest) / std::max(std::sqrt(d.x * d.x + d.y * d.y), 1e-6f);
  return {d.x * scale, d.y * scale, lowest};
}

// Adds the product of each input with its row of weights to `sums`. Returns a pointer to the weights after
// these rows.
const float* add_products(const float* weights, std::span<const float> inputs, std::span<float> sums) {
  for (const float input : inputs) {
    for (std::size_t u = 0; u < sums.size(); ++u) sums[u] += weights[u] * input;
    weights += sums.size();
  }
  return weights;
}

void rectify(std::span<float> units) {
  for (float& unit : units) unit = std::max(unit, neural_leak * unit);
}

// Adds the terms of a first layer: the channels of the images, beginning at `layer`, the view, and the bias.
void add_first_layer(const NeuralTables& tables, std::size_t weights, std::uint32_t layer,
                     std::uint32_t channels, const Fetches& places, Vec3 view, std::span<float> sums) {
  const float* at = &tables.weights[weights];
  for (std::uint32_t i = 0; i < channels / 4; ++i) {
    const auto feature = [&](const ImagePlace& place) {
      return trilinear(tables.size, tables.features.data(), layer + i, place);
    };
    at = add_products(at, mean_over(places, feature), sums);
  }
  const float rest[] = {view.x, view.y, view.z, 1};
  add_products(at, rest, sums);
}

float height_at(const NeuralTables& tables, const NeuralLayout& at, const ImagePlace& place, Vec3 view) {
  const NeuralShape& s = tables.shape;
  float numbers[max_neural_units] = {};
  const std::span<float> units(numbers, s.offset_units);
  add_first_layer(tables, at.offset_in, s.channels / 4, s.offset_channels, one_fetch(place), view, units);
  rectify(units);
  float height = tables.weights[at.offset_level];
  for (std::size_t u = 0; u < units.size(); ++u) height += tables.weights[at.offset_out + u] * units[u];
  return height;
}

// Returns the shifted place at which a view reads the features.
ImagePlace seen_place(const NeuralTables& tables, const NeuralLayout& at, const ImagePlace& place,
                      Vec3 view) {
  const float wished = neural_shift(height_at(tables, at, place, view), view);
  // The caller's view may not be a unit vector. If it is very long, the shifted place may not be finite.
  const bool is_finite = std::isfinite(view.x * wished) && std::isfinite(view.y * wished);
  const float shift = is_finite ? wished : 0;
  return {place.u + view.x * shift, place.v + view.y * shift, place.level};
}

}  // namespace

NeuralTables make_neural_tables(const Neural& neural, std::span<const Vec3> views,
                                std::span<const Vec3> lights, Memory* memory) {
  NeuralTables tables(memory);
  const NeuralShape& s = neural.shape;
  tables.shape = s;
  tables.lowest_view_z = lowest_z(views);
  tables.lowest_light_z = lowest_z(lights);
  tables.size = {s.width, s.height, (s.channels + s.offset_channels) / 4, level_count(s.width, s.height)};
  tables.features.resize(tables.size.level_offset(tables.size.levels));
  Vector<float> image(s.texels(), memory), smaller(s.texels(), memory);
  for (std::uint32_t channel = 0; channel < s.channels + s.offset_channels; ++channel) {
    decode_channel(neural, channel, image);
    add_levels(tables, channel, image, smaller);
  }
  tables.weights.reserve(neural.weights.size());
  for (const std::uint16_t weight : neural.weights) tables.weights.push_back(from_half(weight));
  return tables;
}

void decode_neural(const NeuralTables& tables, const ImagePlace& place, Vec3 view, std::span<float> decoded) {
  decode_neural_places(tables, one_fetch(place), view, decoded);
}

void decode_neural_places(const NeuralTables& tables, const Fetches& given_places, Vec3 given,
                          std::span<float> decoded) {
  const NeuralShape& s = tables.shape;
  const NeuralLayout at(s);
  const Vec3 view = raised(given, tables.lowest_view_z);
  Fetches places = given_places;
  for (std::uint32_t i = 0; i < places.count; ++i)
    places.place[i] = seen_place(tables, at, places.place[i], view);
  std::fill(decoded.begin(), decoded.end(), 0.0f);
  add_first_layer(tables, at.position, 0, s.channels, places, view, decoded.first(s.units));
  decoded[s.units] = view.x;
  decoded[s.units + 1] = view.y;
  decoded[s.units + 2] = view.z;
}

Vec3 neural_radiance(const NeuralTables& tables, std::span<const float> decoded, Vec3 given) {
  const NeuralShape& s = tables.shape;
  const NeuralLayout at(s);
  const Vec3 view{decoded[s.units], decoded[s.units + 1], decoded[s.units + 2]};
  const Vec3 light = raised(given, tables.lowest_light_z), half = neural_half(view, light);
  const float inputs[neural_light_inputs] = {light.x, light.y, light.z, half.x, half.y, half.z};
  float numbers[2][max_neural_units];
  std::span<float> units(numbers[0], s.units), next(numbers[1], s.units);
  std::copy_n(decoded.begin(), s.units, units.begin());
  add_products(&tables.weights[at.light], inputs, units);
  rectify(units);
  for (std::size_t layer = 1; layer < s.layers; ++layer) {
    const float* const weights = &tables.weights[neural_hidden_layer(s, at, layer)];
    std::copy_n(weights + std::size_t(s.units) * s.units, s.units, next.begin());
    add_products(weights, units, next);
    rectify(next);
    std::swap(units, next);
  }
  float rgb[3];
  std::copy_n(&tables.weights[at.out_bias], 3, rgb);
  add_products(&tables.weights[at.out], units, rgb);
  const float share = given.z < tables.lowest_light_z ? std::max(given.z, 0.0f) / tables.lowest_light_z : 1;
  return Vec3{std::max(rgb[0], 0.0f), std::max(rgb[1], 0.0f), std::max(rgb[2], 0.0f)} * share;
}

}  // namespace nook::material
