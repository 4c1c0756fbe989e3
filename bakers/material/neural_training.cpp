#include "bakers/material/neural_training.h"

#include <cmath>
#include <numbers>

#include "bakers/algebra/adam.h"
#include "bakers/material/neural_pass.h"
#include "bakers/material/tile_heights.h"
#include "bakers/raytrace/random.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;

constexpr std::size_t part_positions = 64;  // positions in one part of a batch; a part is evaluated at once
constexpr std::uint32_t warm_steps = 200;   // the learning rate rises during these first steps

// Parameters that are trained. Features are clamped to [-1, 1], because blocks cannot encode other values.
struct Trained {
  std::vector<float> value, gradient;
  Adam adam{0};

  explicit Trained(std::size_t count) : value(count), gradient(count), adam(count) {}

  void step(float rate) {
    adam.step(value, gradient, rate);
    std::fill(gradient.begin(), gradient.end(), 0.0f);
  }
  void clamp() {
    for (float& v : value) v = std::clamp(v, -1.0f, 1.0f);
  }
};

// Radiances divided by their root mean square, in the order view x texel x light x RGB. In this order, the
// values of one position are adjacent.
struct Targets {
  std::vector<float> value;
  float scale = 1;  // the radiance that the value 1 stands for
};

Targets targets_of(const RawMaterial& raw) {
  const std::size_t rows = raw.light_rows(), views = raw.views.size(), texels = raw.texels();
  const double squares =
      tensor::ordered_sum(raw.btf.size(), 1 << 16, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t i = first; i < last; ++i) sum += double(raw.btf[i]) * double(raw.btf[i]);
        return sum;
      });
  Targets targets;
  if (squares > 0) targets.scale = float(std::sqrt(squares / double(raw.btf.size())));
  targets.value.resize(raw.btf.size());
  tensor::for_each_block(views, 1, [&](std::size_t v, std::size_t) {
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t t = 0; t < texels; ++t)
        targets.value[(v * texels + t) * rows + row] =
            raw.btf[(row * views + v) * texels + t] / targets.scale;
  });
  return targets;
}

// The weights of the last layer contain the scale and are stored as half floats. Outside these bounds, they
// would lose digits or overflow.
void check_scale(float scale) {
  constexpr float least = 1.0f / 4096, most = 4096;
  if (!(scale >= least && scale <= most))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the root mean square of the radiance is %g; a neural material needs %g to %g. Scale the radiance",
        double(scale), double(least), double(most));
}

struct Trainer {
  const RawMaterial& raw;
  const NeuralSettings& settings;
  const NeuralShape shape;
  const NeuralLayout at{shape};
  Trained weights{at.count}, features{shape.nodes() * shape.texels() * shape.channels},
      offset_features{shape.texels() * shape.offset_channels};
  std::vector<NeuralPass> parts{(settings.positions + part_positions - 1) / part_positions};
  std::vector<float> rounded_features{}, rounded_offset_features{};

  NeuralNumbers numbers() const { return {shape, features.value, offset_features.value, weights.value}; }
  NeuralNumbers rounded() {
    rounded_features.resize(features.value.size());
    rounded_offset_features.resize(offset_features.value.size());
    round_to_blocks(shape, shape.channels, features.value, rounded_features);
    round_to_blocks(shape, shape.offset_channels, offset_features.value, rounded_offset_features);
    return {shape, rounded_features, rounded_offset_features, weights.value};
  }
};

// Initialises the weights so that a rectified layer preserves the variance of its inputs (K. He and others,
// 2015). All nodes of the map of views start with equal features.
void set_first_numbers(Trainer& t) {
  const NeuralShape& s = t.shape;
  Random random(mix_bits(t.settings.seed));
  const auto fill = [&](std::size_t where, std::size_t count, std::size_t inputs, float scale) {
    const float largest = scale * std::sqrt(6.0f / float(inputs));
    for (std::size_t i = 0; i < count; ++i) t.weights.value[where + i] = random.between(-largest, largest);
  };
  const std::size_t view = neural_view_inputs, light = neural_light_inputs, units = s.units;
  fill(t.at.offset_in, (s.offset_channels + view) * s.offset_units, s.offset_channels + view, 1);
  fill(t.at.position, (s.channels + view) * units, s.channels + view + light, 1);
  fill(t.at.light, light * units, s.channels + view + light, 1);
  for (std::size_t l = 0; l + 1 < s.layers; ++l)
    fill(t.at.hidden + l * units * (units + 1), units * units, units, 1);
  fill(t.at.out, 3 * units, units, 0.3f);
  std::fill_n(&t.weights.value[t.at.out_bias], 3, 0.5f);
  const std::size_t image = s.texels() * s.channels;
  for (std::size_t i = 0; i < t.features.value.size(); ++i)
    t.features.value[i] = i < image ? random.between(-0.1f, 0.1f) : t.features.value[i - image];
  for (float& f : t.offset_features.value) f = random.between(-0.3f, 0.3f);
}

float fall(std::uint32_t step, std::uint32_t steps) {
  return float(0.5 + 0.5 * std::cos(std::numbers::pi * double(step) / double(steps)));
}

// Throws CANCELLED if the callback of the caller returns false.
void report(const StageProgress& progress, const char* stage, std::uint32_t step, std::uint32_t steps) {
  if (progress && !progress(stage, step, steps))
    throw Failure(NOOK_ERROR_CANCELLED, "the training of a neural material was stopped after %u of %u steps",
                  step, steps);
}

// Chooses the positions for a part of a batch. Returns their views.
std::vector<std::uint32_t> choose_positions(const RawMaterial& raw, std::uint64_t seed, std::size_t first,
                                            std::size_t last, NeuralPass& pass) {
  std::vector<std::uint32_t> views(last - first);
  pass.positions.resize(last - first);
  for (std::size_t i = first; i < last; ++i) {
    Random random(mix_bits(seed + i));
    const std::uint32_t view = random.below(std::uint32_t(raw.views.size()));
    views[i - first] = view;
    pass.positions[i - first] = {raw.views[view], random.below(std::uint32_t(raw.texels()))};
  }
  return views;
}

// Adds the gradients of all parts in a fixed order.
void add_gradients(Trainer& t) {
  for (const NeuralPass& pass : t.parts) {
    for (std::size_t i = 0; i < pass.weights.size(); ++i) t.weights.gradient[i] += pass.weights[i];
    pass.scatter(t.shape, t.features.gradient, t.offset_features.gradient);
  }
}

// Trains only the offset network. Its targets are where view rays first hit the relief at which the views
// agree.
void fit_offsets(Trainer& t, const StageProgress& progress) {
  const NeuralShape& s = t.shape;
  const std::vector<float> heights = heights_of_views(t.raw, [&](std::size_t, std::size_t) {
    report(progress, "offset", 0, t.settings.offset_steps);
    return true;
  });
  const HeightMap relief{t.raw.width, t.raw.height, heights};
  const HeightRange range = range_of(relief);
  const std::size_t texels = t.raw.texels();
  std::vector<float> hit(t.raw.views.size() * texels);
  constexpr float lowest_z = 0.01f;
  tensor::for_each_block(t.raw.views.size(), 1, [&](std::size_t v, std::size_t) {
    const Vec3 seen = t.raw.views[v], view{seen.x, seen.y, std::max(seen.z, lowest_z)};
    for (std::size_t i = 0; i < texels; ++i)
      hit[v * texels + i] = first_height(relief, range, (float(i / s.height) + 0.5f) / float(s.width),
                                         (float(i % s.height) + 0.5f) / float(s.height), view);
  });
  constexpr float rate = 1e-2f;
  for (std::uint32_t step = 0; step < t.settings.offset_steps; ++step) {
    const std::uint64_t seed = mix_bits(~t.settings.seed ^ mix_bits(step + 1));
    tensor::for_each_block(t.settings.positions, part_positions, [&](std::size_t first, std::size_t last) {
      NeuralPass& pass = t.parts[first / part_positions];
      const std::vector<std::uint32_t> views = choose_positions(t.raw, seed, first, last, pass);
      pass.lights.clear();
      pass.find_heights(t.numbers());
      for (std::size_t i = 0; i < views.size(); ++i)
        pass.heights(0, Index(i)) -= hit[views[i] * texels + pass.positions[i].texel];
      pass.heights *= 2 / float(t.settings.positions);
      pass.weights.assign(t.at.count, 0);
      pass.heights_backward(t.numbers());
    });
    add_gradients(t);
    const float now = rate * fall(step, t.settings.offset_steps);
    t.weights.step(now);
    t.offset_features.step(now);
    t.offset_features.clamp();
    report(progress, "offset", step + 1, t.settings.offset_steps);
  }
  t.weights.adam = Adam(t.at.count);
  t.offset_features.adam = Adam(t.offset_features.value.size());
}

// Chooses the lights of a position. Splits the list of lights into equal intervals, starting at a random
// light, and takes one light from each.
void choose_lights(const RawMaterial& raw, std::uint64_t seed, std::uint32_t each,
                   std::vector<std::uint32_t>& chosen, std::vector<Vec3>& lights) {
  Random random(seed);
  const auto count = std::uint32_t(raw.lights.size());
  const std::uint32_t start = random.below(count);
  for (std::uint32_t i = 0; i < each; ++i) {
    const std::uint32_t from = i * count / each, to = (i + 1) * count / each;
    chosen.push_back((start + from + random.below(to - from)) % count);
    lights.push_back(raw.lights[chosen.back()]);
  }
}

void part_gradient(const Trainer& t, const Targets& targets, const NeuralNumbers& numbers, std::uint64_t seed,
                   std::size_t first, std::size_t last, NeuralPass& pass) {
  const std::size_t texels = t.raw.texels(), rows = t.raw.light_rows();
  const auto each = std::min(t.settings.lights, std::uint32_t(t.raw.lights.size()));
  const std::vector<std::uint32_t> views = choose_positions(t.raw, seed, first, last, pass);
  std::vector<std::uint32_t> chosen;
  pass.lights.clear();
  for (std::size_t i = first; i < last; ++i)
    choose_lights(t.raw, mix_bits(~seed + i), each, chosen, pass.lights);
  pass.forward(numbers);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::size_t p = i / each;
    const float* target =
        &targets.value[(views[p] * texels + pass.positions[p].texel) * rows + 3 * chosen[i]];
    for (Index c = 0; c < 3; ++c) pass.out(c, Index(i)) -= target[c];
  }
  pass.out *= 2 / (3 * float(each) * float(t.settings.positions));
  pass.backward(numbers);
}

void train(Trainer& t, const Targets& targets, const StageProgress& progress) {
  const NeuralSettings& s = t.settings;
  // The offset features learn at the rate of the other features times this factor.
  constexpr float offset_share = 0.3f;
  for (std::uint32_t step = 0; step < s.steps; ++step) {
    const NeuralNumbers numbers = 2 * step >= s.steps ? t.rounded() : t.numbers();
    const std::uint64_t seed = mix_bits(s.seed ^ mix_bits(step + 1));
    tensor::for_each_block(s.positions, part_positions, [&](std::size_t first, std::size_t last) {
      part_gradient(t, targets, numbers, seed, first, last, t.parts[first / part_positions]);
    });
    add_gradients(t);
    const float now = fall(step, s.steps) * std::min(1.0f, float(step + 1) / float(warm_steps));
    t.weights.step(s.rate * now);
    t.features.step(s.feature_rate * now);
    t.offset_features.step(offset_share * s.feature_rate * now);
    t.features.clamp();
    t.offset_features.clamp();
    report(progress, "network", step + 1, s.steps);
  }
}

NeuralShape shape_of(const RawMaterial& raw, NeuralShape shape) {
  shape.width = raw.width;
  shape.height = raw.height;
  shape.widest_view_z = 1;
  for (const Vec3 view : raw.views) shape.widest_view_z = std::min(shape.widest_view_z, view.z);
  return shape;
}

}  // namespace

NeuralShape filling_neural_shape(const RawMaterial& raw, std::size_t bytes) {
  constexpr std::uint32_t enough_channels = 16, most_channels = 64;
  NeuralShape shape = shape_of(raw, {});
  for (shape.view_side = std::uint32_t(std::lround(std::sqrt(double(raw.views.size())))); shape.view_side > 1;
       --shape.view_side) {
    shape.channels = enough_channels;
    if (neural_bytes(shape) <= bytes) break;
  }
  for (shape.channels = most_channels; shape.channels > 2 && neural_bytes(shape) > bytes;)
    shape.channels -= 2;
  return shape;
}

NeuralTile fit_neural_tile(const RawMaterial& raw, const NeuralSettings& settings,
                           const StageProgress& progress) {
  Trainer t{raw, settings, shape_of(raw, settings.shape)};
  const Targets targets = targets_of(raw);
  check_scale(targets.scale);
  set_first_numbers(t);
  fit_offsets(t, progress);
  train(t, targets, progress);
  t.rounded();
  for (std::size_t i = t.at.out; i < t.at.count; ++i) t.weights.value[i] *= targets.scale;
  for (float& weight : t.weights.value) weight = from_half(to_half(weight));
  return {t.shape, std::move(t.rounded_features), std::move(t.rounded_offset_features),
          std::move(t.weights.value)};
}

}  // namespace nook::bake::material
