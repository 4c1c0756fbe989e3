// The linear layer's own layout and its kernels against the sum as the model states it.
#include "sdk/src/character/linear_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/core/failure.h"
#include "shaders/character/constants.h"
#include "tests/catch.h"
#include "tests/character/kernel_reference.h"
#include "tests/character/model_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr std::uint32_t key_points = 40, influences = 7;

// Vertex v uses v % (influences + 1) entries, with the unused ones scattered among them. Weights are such as
// a file holds, which the layer keeps exactly.
CharacterModel random_model(std::uint32_t vertices) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  CharacterModel model;
  model.key_points.resize(key_points);
  model.influences = influences;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto first = static_cast<std::uint32_t>(unit(random) * key_points * 0.999f);
    for (std::uint32_t s = 0; s < influences; ++s) {
      const bool used = (s * 3) % influences < v % (influences + 1);
      const float share = s == 0 ? 1 : std::floor(127 * (0.4f + 0.6f * unit(random))) / 127;
      model.influence.push_back(static_cast<std::uint16_t>((first + 6 * s) % key_points));
      model.alpha.push_back(used ? 0.35f * share * share : 0.0f);
      model.blend.push_back(used ? std::floor(8 * unit(random) - 2) / 16 : 0.0f);
    }
    model.bias.push_back(0.2f * unit(random) - 0.1f);
  }
  for (std::uint32_t i = 0; i < vertices + vertices / 5; ++i)
    model.file_to_welded.push_back(i * 7 % vertices);
  return model;
}

struct Inputs {
  std::vector<float> shadow = std::vector<float>(padded_key_points(key_points));
  std::vector<float> occlusion = shadow;

  explicit Inputs(std::uint32_t seed = 4) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    for (float& s : shadow) s = unit(random);
    for (float& o : occlusion) o = unit(random);
  }
};

// The sum of a vertex' weights times values at its key points.
double shaded(const CharacterModel& model, const std::vector<float>& values, const auto& weights,
              std::uint32_t v) {
  double sum = 0;
  for (std::uint32_t e = v * influences; e < (v + 1) * influences; ++e)
    sum += double(weights[e]) * values[model.influence[e]];
  return sum;
}

double truth(const CharacterModel& model, const Inputs& in, std::uint32_t v, bool added) {
  const double dark = shaded(model, in.occlusion, model.blend, v);
  const double self = std::clamp(1 - shaded(model, in.shadow, model.alpha, v) - model.bias[v], 0.0, 1.0);
  return added ? self * std::clamp(1 - dark, 0.0, 1.0) : self;
}

// The largest change of a vertex' AO by the codes of values that are at most 1.
double code_error(const CharacterModel& model, const LinearView& view, std::uint32_t v, bool added) {
  double alphas = 0, blends = 0;
  for (std::uint32_t e = v * influences; e < (v + 1) * influences; ++e) {
    alphas += std::abs(double(model.alpha[e]));
    blends += std::abs(double(model.blend[e]));
  }
  return 0.5 * (alphas / view.shadow_limit + (added ? blends / view.occlusion_limit : 0));
}

// Returns the AO in file order.
std::vector<float> vertex_ao(const ShadowKernels& kernels, const LinearLayer& layer, const float* shadow,
                             const float* occlusion) {
  const LinearView& view = layer.view();
  constexpr std::uint32_t padded = padded_key_points(key_points);
  std::vector<std::int32_t> words(4 * padded);
  PointCodes dark{words.data(), words.data() + padded, 0},
      added{words.data() + 2 * padded, words.data() + 3 * padded, 0};
  kernels.encode_points(shadow, padded, view.shadow_limit, dark);
  if (occlusion) kernels.encode_points(occlusion, padded, view.occlusion_limit, added);
  std::vector<float> slots(layer.padded_slots()), out;
  kernels.linear_layer(view, dark, occlusion ? &added : nullptr, slots.data());
  for (const std::uint32_t slot : layer.file_to_slot()) out.push_back(slots[slot]);
  return out;
}

}  // namespace

TEST_CASE("the linear layer gives the model's AO in file order") {
  const Inputs in;
  for (const std::uint32_t vertices : {1u, 15u, 16u, 17u, 333u}) {
    const CharacterModel model = random_model(vertices);
    const LinearLayer layer(model);
    for (const ShadowKernels* kernels : available_kernels())
      for (const bool added : {false, true}) {
        INFO(kernels->name << " vertices " << vertices << " added " << added);
        const float* occlusion = added ? in.occlusion.data() : nullptr;
        const auto ao = vertex_ao(*kernels, layer, in.shadow.data(), occlusion);
        REQUIRE(ao.size() == model.file_to_welded.size());
        // Half a step of each code, weighted, and rounding: shadows and occlusions are at most 1.
        for (std::size_t i = 0; i < ao.size(); ++i)
          CHECK(std::abs(ao[i] - truth(model, in, model.file_to_welded[i], added)) <
                code_error(model, layer.view(), model.file_to_welded[i], added) + 1e-6);
      }
  }
}

TEST_CASE("the light of a vertex' shadow is the mean of its key points', in proportion to their shadows") {
  const Inputs in;
  const Inputs other(5);
  // Red takes none of the light, green as much as of all directions, blue twice as much.
  std::vector<float> none(in.shadow.size(), 0.0f), twice = in.shadow;
  for (float& s : twice) s *= 2;
  const float* const coloured[] = {none.data(), in.shadow.data(), twice.data()};
  const float* const occlusion[] = {in.occlusion.data(), other.occlusion.data(), in.occlusion.data()};
  const CharacterModel model = random_model(333);
  const LinearLayer layer(model);
  for (const ShadowKernels* kernels : available_kernels())
    for (const bool added : {false, true}) {
      INFO(kernels->name << " added " << added);
      std::vector<float> slots[3];
      for (auto& channel : slots) channel.resize(layer.padded_slots());
      float* const rgb[] = {slots[0].data(), slots[1].data(), slots[2].data()};
      kernels->directional_linear_layer(layer.view(), in.shadow.data(), coloured, added ? occlusion : nullptr,
                                        rgb);
      for (std::size_t i = 0; i < layer.file_to_slot().size(); ++i) {
        const std::uint32_t v = model.file_to_welded[i], slot = layer.file_to_slot()[i];
        const double sum = shaded(model, in.shadow, model.alpha, v),
                     dark = std::max(sum + model.bias[v], 0.0);
        const double small = NOOK_SMALLEST_SHARE;
        for (int c = 0; c < 3; ++c) {
          const double self = std::clamp(1 - dark * (c * sum + small) / (sum + small), 0.0, 1.0);
          const Inputs& from = c == 1 ? other : in;
          const double left = std::clamp(1 - shaded(model, from.occlusion, model.blend, v), 0.0, 1.0);
          // As for the linear layer of AO, and a quotient.
          CHECK(std::abs(slots[c][slot] - (added ? self * left : self)) < 2e-6);
        }
      }
    }
}

TEST_CASE("vertices that share key points share a block") {
  // 800 vertices in 50 families of 16 that use the same seven key points, in an order that separates them.
  // Each family has a place of its own.
  CharacterModel model;
  model.influences = influences;
  for (std::uint32_t k = 0; k < 50 * influences; ++k) {
    KeyPoint point;
    point.surface_position = {static_cast<float>(k / influences), 0,
                              0.01f * static_cast<float>(k % influences)};
    point.surface_normal = {0, 1, 0};
    model.key_points.push_back(point);
  }
  for (std::uint32_t v = 0; v < 800; ++v) {
    for (std::uint32_t s = 0; s < influences; ++s) {
      model.influence.push_back(static_cast<std::uint16_t>(v % 50 * influences + s));
      model.alpha.push_back(0.1f);
      model.blend.push_back(1.0f / influences);
    }
    model.bias.push_back(0);
    model.file_to_welded.push_back(v);
  }
  const LinearLayer layer(model);
  REQUIRE(layer.view().block_count == 50);
  for (std::uint32_t b = 0; b < 50; ++b) CHECK(layer.view().blocks[b].pairs == (influences + 1) / 2);
}

TEST_CASE("absurd weights still give every vertex a slot") {
  CharacterModel model = random_model(333);
  for (KeyPoint& point : model.key_points) point.surface_position = {1e30f, -1e30f, 1e30f};
  for (std::size_t e = 0; e < model.alpha.size(); e += 5) model.alpha[e] *= 1e37f;
  const LinearLayer layer(model);
  std::vector<bool> taken(layer.padded_slots(), false);
  for (const std::uint32_t slot : layer.file_to_slot()) taken[slot] = true;
  CHECK(std::count(taken.begin(), taken.end(), true) == 333);
}

TEST_CASE("key points without weight have no column") {
  const CharacterModel model = random_model(8);  // vertex 0 uses none, the last all seven
  const LinearLayer layer(model);
  std::vector<bool> used(key_points, false);
  for (std::size_t e = 0; e < model.alpha.size(); ++e)
    if (model.alpha[e] > 0) used[model.influence[e]] = true;
  CHECK(layer.view().blocks[0].pairs ==
        (static_cast<std::uint32_t>(std::count(used.begin(), used.end(), true)) + 1) / 2);
}

TEST_CASE("whatever the shadows, AO is a number between 0 and 1") {
  const CharacterModel model = random_model(64);
  const LinearLayer layer(model);
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float poison : {std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, 1e30f, -5.0f}) {
    const std::vector<float> bad(padded_key_points(key_points), poison);
    for (const ShadowKernels* kernels : available_kernels())
      for (const float* occlusion : {static_cast<const float*>(nullptr), bad.data()})
        for (const float ao : vertex_ao(*kernels, layer, bad.data(), occlusion)) {
          INFO(kernels->name << " poison " << poison);
          CHECK((ao >= 0 && ao <= 1));
        }
  }
}

TEST_CASE("weights that no file holds are rounded to the nearest step") {
  CharacterModel model = random_model(333);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0, 1);
  for (float& alpha : model.alpha) alpha *= unit(random);
  for (float& blend : model.blend) blend *= unit(random);
  const LinearLayer layer(model);
  const float largest = *std::max_element(model.alpha.begin(), model.alpha.end());
  CHECK(layer.view().alpha_step == largest / 32258);
  CHECK(layer.view().blend_step == 1.0f / 16384);
  const Inputs in;
  const auto ao = vertex_ao(best_shadow_kernels(), layer, in.shadow.data(), in.occlusion.data());
  // Half a step of each of seven weights, whose key points are at most 1, and rounding.
  const double bound = 3.5 * (double(largest) / 32258 + 1.0 / 16384) + 1e-6;
  for (std::size_t i = 0; i < ao.size(); ++i)
    CHECK(std::abs(ao[i] - truth(model, in, model.file_to_welded[i], true)) <
          bound + code_error(model, layer.view(), model.file_to_welded[i], true));
}

TEST_CASE("a model with near key points together is the same model in other numbers") {
  CharacterModel model = sample_model(7, {5, 20, 100, 60, 10, 4});
  CharacterLevel level;
  Numbers numbers(8);
  for (std::uint16_t k = 3; k < 100; k = std::uint16_t(k + 4)) level.evaluated.push_back(k);
  for (std::uint32_t k = 0; k < 100; ++k) {
    level.source.push_back(std::uint16_t(numbers.below(std::uint32_t(level.evaluated.size()))));
    level.scale.push_back(numbers.between(0.5f, 2));
    level.offset.push_back(numbers.between(-0.1f, 0.1f));
  }
  model.levels.push_back(level);
  const CharacterModel moved = with_near_key_points_together(CharacterModel(model), default_memory());
  // The old number of each key point, by its position. No two have the same.
  std::vector<std::uint32_t> old(100);
  for (std::uint32_t k = 0; k < 100; ++k)
    while (moved.key_points[k].position.x != model.key_points[old[k]].position.x) ++old[k];
  for (std::size_t e = 0; e < model.influence.size(); ++e)
    if (model.alpha[e] != 0) CHECK(old[moved.influence[e]] == model.influence[e]);
  const CharacterLevel &was = model.levels[0], &now = moved.levels[0];
  CHECK(std::is_sorted(now.evaluated.begin(), now.evaluated.end()));
  for (std::uint32_t k = 0; k < 100; ++k) {
    CHECK(old[now.evaluated[now.source[k]]] == was.evaluated[was.source[old[k]]]);
    CHECK(now.scale[k] == was.scale[old[k]]);
    CHECK(now.offset[k] == was.offset[old[k]]);
  }
  // Groups are smaller than the body, which is a box of a metre.
  double extent = 0;
  for (std::uint32_t g = 0; g + 16 <= 100; g += 16)
    for (std::uint32_t k = g; k < g + 16; ++k)
      extent += double(length(moved.key_points[k].position - moved.key_points[g].position)) / 96;
  CHECK(extent < 0.45);  // 0.66 is the mean distance of two places in the box
}

TEST_CASE("a model that contradicts itself is refused") {
  CharacterModel model = random_model(20);
  SECTION("a key point that is not there") {
    model.influence[influences] = key_points;
  }
  SECTION("weights missing") {
    model.alpha.pop_back();
  }
  SECTION("a welded vertex that is not there") {
    model.file_to_welded[3] = 20;
  }
  CHECK_THROWS_AS(LinearLayer(model), Failure);
}
