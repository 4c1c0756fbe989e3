#include "bakers/character/mini_batch_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bakers/character/layer_kernels.h"
#include "sdk/src/character/model.h"

namespace nook::bake {
namespace {

// The Adam optimiser (Kingma & Ba 2015). Each parameter has its own rate, because metres, log radii and
// weights have different scales.
class Adam {
 public:
  explicit Adam(std::size_t count) : first_(count, 0.0f), second_(count, 0.0f) {}

  void step(std::span<float> value, std::span<const float> gradient, const float* rate,
            std::size_t rate_period, float scale, std::size_t t) {
    const float correction1 = 1 / (1 - std::pow(beta1, float(t)));
    const float correction2 = 1 / (1 - std::pow(beta2, float(t)));
    for (std::size_t i = 0; i < value.size(); ++i) {
      first_[i] = beta1 * first_[i] + (1 - beta1) * gradient[i];
      second_[i] = beta2 * second_[i] + (1 - beta2) * gradient[i] * gradient[i];
      value[i] -= scale * rate[rate_period == 1 ? 0 : i % rate_period] * first_[i] * correction1 /
                  (std::sqrt(second_[i] * correction2) + 1e-10f);
    }
  }

 private:
  static constexpr float beta1 = 0.9f, beta2 = 0.99f;
  std::vector<float> first_, second_;
};

// Learning rates in the units of the parameters: metres, log radius, components of unit normals, square roots
// of weights. A step changes each parameter by about its rate. We chose each rate from the typical size of
// its parameter and did not search for the best value.
constexpr float sphere_rate[LayerStructure::sphere_parameters] = {2e-3f, 2e-3f, 2e-3f, 1e-2f};
constexpr float key_point_rate[LayerStructure::key_point_parameters] = {
    2e-3f, 2e-3f, 2e-3f, 2e-2f, 2e-2f, 2e-2f, 1e-2f, 1e-2f, 1e-2f, 1e-2f, 1e-2f};
constexpr float alpha_rate = 5e-3f;
constexpr float bias_rate = 2e-3f;

// Visits every pose once in a random order, then starts over in a new order.
class PoseOrder {
 public:
  PoseOrder(std::size_t count, std::uint64_t seed) : order_(count), random_(seed) {
    for (std::size_t i = 0; i < count; ++i) order_[i] = i;
  }
  std::size_t next() {
    if (at_ == 0) {
      // The Fisher-Yates shuffle. The result of std::shuffle would depend on the standard library.
      for (std::size_t i = order_.size(); i > 1; --i) std::swap(order_[i - 1], order_[random_() % i]);
    }
    const std::size_t pose = order_[at_];
    at_ = (at_ + 1) % order_.size();
    return pose;
  }

 private:
  std::vector<std::size_t> order_;
  std::mt19937_64 random_;
  std::size_t at_ = 0;
};

// Clamps weights to at least their floors, and saturations to at most their bound.
void keep_in_range(FitState& state) {
  LinearLayerFit& linear = state.linear;
  for (std::size_t s = 0; s < linear.alpha.size(); ++s)
    linear.alpha[s] = std::max(linear.floor.empty() ? 0.0f : linear.floor[s], linear.alpha[s]);
  const float max_root = std::sqrt(max_saturation);
  for (std::size_t k = 0; k < state.structure.key_point_count(); ++k) {
    float& root = state.parameters[state.structure.saturation_offset(k)];
    root = std::clamp(root, -max_root, max_root);
  }
}

}  // namespace

void fit_mini_batches(FitState& state, const TrainingSet& set, const MiniBatchSettings& settings,
                      const StepProgress& progress) {
  const LayerStructure& structure = state.structure;
  const NonLinearLayer layer(structure);
  const std::size_t padded = structure.padded_count(), vertices = state.linear.vertex_count();
  const std::size_t parameter_count = structure.parameter_count();
  constexpr std::size_t lanes = batch_poses, vertex_parts = 8;

  std::vector<LayerWorkspace> workspaces(lanes, LayerWorkspace(structure));
  std::vector<float> shadow(padded * lanes), gradient_shadow(padded * lanes);
  std::vector<std::vector<float>> part_gradient_shadow(vertex_parts, std::vector<float>(padded * lanes));
  std::vector<std::vector<float>> lane_gradient(lanes, std::vector<float>(parameter_count));
  std::vector<float> gradient(parameter_count), gradient_alpha(state.linear.alpha.size()),
      gradient_bias(vertices);
  const std::size_t split = structure.key_point_offset(0);
  Adam adam_spheres(split), adam_keys(parameter_count - split);
  Adam adam_alpha(state.linear.alpha.size()), adam_bias(vertices);
  PoseOrder order(set.fitted(), settings.seed);

  for (std::size_t step = 0; step < settings.steps; ++step) {
    std::size_t pose[lanes];
    for (std::size_t& p : pose) p = order.next();
    tbb::parallel_for(std::size_t(0), lanes, [&](std::size_t lane) {
      layer.forward(set.poses[pose[lane]], state.parameters, workspaces[lane], &shadow[lane], lanes);
    });
    const std::uint16_t* target[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) target[lane] = set.targets.row(pose[lane]).data();
    tbb::parallel_for(std::size_t(0), vertex_parts, [&](std::size_t part) {
      std::vector<float>& out = part_gradient_shadow[part];
      std::fill(out.begin(), out.end(), 0.0f);
      linear_layer_gradient(state.linear, set.vertex_weight, target, shadow.data(),
                            vertices * part / vertex_parts, vertices * (part + 1) / vertex_parts, out.data(),
                            gradient_alpha.data(), gradient_bias.data());
    });
    std::fill(gradient_shadow.begin(), gradient_shadow.end(), 0.0f);
    for (const std::vector<float>& part : part_gradient_shadow)
      for (std::size_t i = 0; i < gradient_shadow.size(); ++i) gradient_shadow[i] += part[i];
    tbb::parallel_for(std::size_t(0), lanes, [&](std::size_t lane) {
      std::fill(lane_gradient[lane].begin(), lane_gradient[lane].end(), 0.0f);
      layer.backward(set.poses[pose[lane]], state.parameters, workspaces[lane], &gradient_shadow[lane], lanes,
                     lane_gradient[lane]);
    });
    std::fill(gradient.begin(), gradient.end(), 0.0f);
    for (const std::vector<float>& g : lane_gradient)
      for (std::size_t i = 0; i < parameter_count; ++i) gradient[i] += g[i];

    const float done = float(step) / float(settings.steps);
    const float cosine = 0.5f + 0.5f * std::cos(std::numbers::pi_v<float> * done);
    const float rate = settings.rate * std::min(1.0f, (done + 1e-6f) / settings.warmup) *
                       (settings.final_rate + (1 - settings.final_rate) * cosine);
    const std::span<float> all(state.parameters);
    const std::span<const float> slope(gradient);
    adam_spheres.step(all.first(split), slope.first(split), sphere_rate, LayerStructure::sphere_parameters,
                      rate, step + 1);
    adam_keys.step(all.subspan(split), slope.subspan(split), key_point_rate,
                   LayerStructure::key_point_parameters, rate, step + 1);
    adam_alpha.step(state.linear.alpha, gradient_alpha, &alpha_rate, 1, rate, step + 1);
    adam_bias.step(state.linear.bias, gradient_bias, &bias_rate, 1, rate, step + 1);
    keep_in_range(state);
    if (progress && !progress(step + 1)) break;
  }
}

}  // namespace nook::bake
