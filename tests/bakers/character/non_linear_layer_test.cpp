// The gradient of the non-linear layer against finite differences, and its value against hand-written
// formulas.
#include "bakers/character/non_linear_layer.h"

#include <cmath>
#include <random>

#include "bakers/character/block_descent.h"
#include "bakers/character/rotation.h"
#include "tests/bakers/character/direct_objective.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

struct Problem {
  LayerStructure structure;
  std::vector<float> parameters;
  Pose bones;
};

Problem random_problem(Kernel kernel, std::size_t spheres, std::size_t keys, unsigned seed) {
  std::mt19937 bits(seed);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * float(bits() >> 8) * 0x1p-24f;
  };
  Problem p;
  p.structure.kernel = kernel;
  for (std::size_t h = 0; h < spheres; ++h) p.structure.sphere_bone.push_back(std::uint16_t(bits() % 3));
  for (std::size_t k = 0; k < keys; ++k) p.structure.key_point_bone.push_back({0, 1, 2, 0});
  p.parameters.resize(p.structure.parameter_count());
  for (std::size_t h = 0; h < spheres; ++h) {
    float* q = &p.parameters[p.structure.sphere_offset(h)];
    for (int i = 0; i < 3; ++i) q[i] = uniform(-1, 1);
    q[3] = uniform(-2.5f, -1);
  }
  for (std::size_t k = 0; k < keys; ++k) {
    float* q = &p.parameters[p.structure.key_point_offset(k)];
    for (int i = 0; i < 6; ++i) q[i] = uniform(-1, 1);
    for (int i = 0; i < 3; ++i) q[6 + i] = uniform(0.2f, 1);
    p.parameters[p.structure.saturation_offset(k)] = uniform(-1.5f, 1.5f);
    q[9] = 0;
  }
  for (int b = 0; b < 3; ++b)
    p.bones.push_back(rotation_about({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)},
                                     {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}));
  return p;
}

// A weighted sum of all shadows, so that one gradient touches every parameter.
double loss_of(const Problem& p, const std::vector<float>& parameters) {
  const NonLinearLayer layer(p.structure);
  LayerWorkspace workspace(p.structure);
  std::vector<float> shadow(p.structure.padded_count());
  layer.forward(p.bones, parameters, workspace, shadow.data());
  double sum = 0;
  for (std::size_t k = 0; k < p.structure.key_point_count(); ++k)
    sum += double(shadow[k]) * (1 + 0.1 * double(k));
  return sum;
}

}  // namespace

TEST_CASE("the gradient of the non-linear layer equals finite differences") {
  const KernelForm form = GENERATE(KernelForm::paper, KernelForm::nook, KernelForm::rational);
  const float gamma = GENERATE(1.0f, 1.3f, 1.5f, 2.0f);
  const Problem p = random_problem({form, gamma}, 5, 21, 7);
  const NonLinearLayer layer(p.structure);
  LayerWorkspace workspace(p.structure);
  std::vector<float> shadow(p.structure.padded_count()), slope(shadow.size());
  for (std::size_t k = 0; k < slope.size(); ++k) slope[k] = 1 + 0.1f * float(k);
  std::vector<float> gradient(p.parameters.size(), 0.0f);
  layer.forward(p.bones, p.parameters, workspace, shadow.data());
  layer.backward(p.bones, p.parameters, workspace, slope.data(), 1, gradient);
  for (std::size_t i = 0; i < p.parameters.size(); ++i) {
    // Central differences in float: a step of 2e-3 leaves a rounding error near 1e-6 / 2e-3 on a loss of
    // about 30, and a truncation error of the third derivative, both below 1 % of a typical slope.
    const float step = 2e-3f;
    std::vector<float> up = p.parameters, down = p.parameters;
    up[i] += step;
    down[i] -= step;
    const double expected = (loss_of(p, up) - loss_of(p, down)) / (2 * double(step));
    INFO("parameter " << i << " form " << int(form) << " gamma " << gamma);
    CHECK(std::abs(double(gradient[i]) - expected) < 0.01 + 0.02 * std::abs(expected));
  }
}

TEST_CASE("one sphere casts the closed form of slide 18 on one key point") {
  LayerStructure structure;
  structure.kernel = {KernelForm::paper, 2.0f};
  structure.sphere_bone = {0};
  structure.key_point_bone = {{0, 0, 0, 0}};
  // Sphere of radius 0.5 at distance 2 straight above: delta = 4, xi = 4.
  const std::vector<float> parameters{0, 2, 0, std::log(0.5f), 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0};
  const Pose bones(1);
  const NonLinearLayer layer(structure);
  LayerWorkspace workspace(structure);
  std::vector<float> shadow(structure.padded_count());
  layer.forward(bones, parameters, workspace, shadow.data());
  const double omega = 0.75 - 3.0 * 3.0 / (1 + 4 * 3.0), lambda = 0.5 + 4 / std::sqrt(1 + 4.0 * 16);
  CHECK(std::abs(double(shadow[0]) - omega * lambda) < 1e-6);             // float rounding
  for (std::size_t k = 1; k < shadow.size(); ++k) CHECK(shadow[k] == 0);  // padding
}

TEST_CASE("the cached quadratic form is the direct sum of squares, with the same gradient") {
  const Problem p = random_problem({KernelForm::nook, 1.5f}, 6, 18, 3);
  FitState state;
  state.structure = p.structure;
  state.parameters = p.parameters;
  state.linear.entries = 3;
  std::mt19937 bits(5);
  const std::size_t vertices = 40;
  for (std::size_t i = 0; i < vertices; ++i) {
    state.linear.bias.push_back(0.01f * float(bits() % 30));
    for (int s = 0; s < 3; ++s) {
      state.linear.key_point.push_back(std::uint16_t(bits() % 18));
      state.linear.alpha.push_back(0.01f * float(bits() % 100));
    }
  }
  TrainingSet set;
  set.targets.vertex_count = vertices;
  for (unsigned t = 0; t < 70; ++t) {
    Problem q = random_problem({KernelForm::nook, 1.5f}, 1, 1, 100 + t);
    set.poses.push_back(q.bones);
    for (std::size_t i = 0; i < vertices; ++i) set.targets.value.push_back(std::uint16_t(bits() % 65536));
  }
  for (std::size_t i = 0; i < vertices; ++i) set.vertex_weight.push_back(0.5f + 0.025f * float(i));
  set.held_out = 6;
  const CachedObjective cache = cache_linear_layer(state, set);
  std::vector<double> cached_gradient, direct_gradient;
  const double cached = evaluate_cached(state, set, cache, &cached_gradient);
  const double direct = bake::test::evaluate_direct(state, set, &direct_gradient);
  // Floats inside both; the terms that cancel in the quadratic form are about ten times the result.
  CHECK(std::abs(cached - direct) < 1e-5 * direct);
  REQUIRE(cached_gradient.size() == direct_gradient.size());
  double scale = 0;
  for (double g : direct_gradient) scale = std::max(scale, std::abs(g));
  for (std::size_t i = 0; i < direct_gradient.size(); ++i)
    CHECK(std::abs(cached_gradient[i] - direct_gradient[i]) < 1e-4 * scale);
}
