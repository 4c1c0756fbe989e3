#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "bakers/nnao/forms.h"
#include "bakers/nnao/horizon_gradient.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/layers.h"

namespace nook::bake::nnao {
namespace {

// The pass clamps the AO that it writes, so the error is computed from clamped AO. The gradient ignores the
// clamp, so that outputs outside the range still move back.
float error_of(float output, float ao) {
  return std::clamp(output, 0.0f, 1.0f) - ao;
}

// Returns the normal with a small random rotation. Hosts' 24-bit depth and 8-bit normals cause errors of some
// tenths of a degree, and the network should not respond to such errors.
Vec3 rounded_normal(Vec3 normal, Random& random) {
  constexpr float reach = 0.01f;  // radians
  return normalised(normal + Vec3{random.between(-reach, reach), random.between(-reach, reach),
                                  random.between(-reach, reach)});
}

// The loss of two outputs, and its gradient for each of them.
struct PairLoss {
  float loss = 0, g_one = 0, g_two = 0;
};

// Returns the loss of a pair of outputs with independent noise. Points with a dark reference have a larger
// weight, see TrainingSettings.
PairLoss ao_loss(const TrainingSettings& settings, float ao, float output_one, float output_two) {
  const float w = settings.unblurred_weight, weight = 1 + settings.dark_weight * (1 - ao) * (1 - ao);
  const float e_one = error_of(output_one, ao), e_two = error_of(output_two, ao);
  return {weight * ((1 - w) * e_one * e_two + 0.5f * w * (e_one * e_one + e_two * e_two)),
          weight * ((1 - w) * e_two + w * e_one), weight * ((1 - w) * e_one + w * e_two)};
}

Vec3 lane_vector(const Lanes (&from)[3], int lane) {
  return {from[0][lane], from[1][lane], from[2][lane]};
}

// Converts the gradient with respect to a unit vector into the gradient with respect to the vector before
// normalisation.
Vec3 before_normalising(Vec3 gradient, Vec3 unit, float size) {
  return (gradient - dot(gradient, unit) * unit) * (1 / size);
}

// Computes the loss of the bent normal. The error is the squared distance of unit vectors, weighted by 1 -
// AO. The weight is small for nearly open points, because their bent normal hardly differs from the normal.
float bent_loss(const TrainingSettings& settings, const DataPoint& point, const HorizonOutput& one,
                const HorizonOutput& two, int lane, HorizonOutput& g_one, HorizonOutput& g_two) {
  const Vec3 bent_one = lane_vector(one.bent, lane), bent_two = lane_vector(two.bent, lane);
  const float size_one = std::max(length(bent_one), 1e-3f), size_two = std::max(length(bent_two), 1e-3f);
  const Vec3 reference = normalised(point.open_direction);
  const float weight = length(reference) > 0 ? settings.bent_weight * (1 - point.ao) : 0;
  const Vec3 unit_one = bent_one * (1 / size_one), unit_two = bent_two * (1 / size_two);
  const Vec3 e_one = unit_one - reference, e_two = unit_two - reference;
  const float w = settings.unblurred_weight;
  const Vec3 from_one = before_normalising(weight * ((1 - w) * e_two + w * e_one), unit_one, size_one);
  const Vec3 from_two = before_normalising(weight * ((1 - w) * e_one + w * e_two), unit_two, size_two);
  for (const auto& [gradient, from] : {std::pair(&g_one, from_one), std::pair(&g_two, from_two)}) {
    gradient->bent[0][lane] = from.x;
    gradient->bent[1][lane] = from.y;
    gradient->bent[2][lane] = from.z;
  }
  return weight * ((1 - w) * dot(e_one, e_two) + 0.5f * w * (dot(e_one, e_one) + dot(e_two, e_two)));
}

// Evaluates sixteen points with two noise values each. Sets the gradient, and returns the sum of the losses
// of all lanes.
double block_gradient(const Dataset& data, const TrainingSettings& settings, const float* parameters,
                      std::span<const std::uint32_t> points, TapGrid grid, std::uint64_t seed,
                      float* gradient) {
  Random random(seed);
  HorizonBatch one(grid), two(grid);
  for (int lane = 0; lane < lane_count; ++lane) {
    DataPoint point = data.training[points[std::size_t(lane)]];
    point.normal = rounded_normal(point.normal, random);
    const View view = data.views[point.view].view();
    constexpr std::uint32_t count = NOOK_NOISE_COUNT;
    const std::uint32_t rank = random.below(count), other = (rank + 1 + random.below(count - 1)) % count;
    one.set(lane, view, point, nook::nnao::tap_noise_of_rank(rank));
    two.set(lane, view, point, nook::nnao::tap_noise_of_rank(other));
  }
  HorizonTrace trace_one(grid), trace_two(grid);
  HorizonOutput output_one, output_two, g_one, g_two;
  horizon_forward(parameters, one, trace_one, output_one);
  horizon_forward(parameters, two, trace_two, output_two);
  double loss = 0;
  for (int lane = 0; lane < lane_count; ++lane) {
    const DataPoint& point = data.training[points[std::size_t(lane)]];
    const PairLoss of_ao = ao_loss(settings, point.ao, output_one.ao[lane], output_two.ao[lane]);
    g_one.ao[lane] = of_ao.g_one;
    g_two.ao[lane] = of_ao.g_two;
    loss += double(of_ao.loss);
    loss += double(bent_loss(settings, point, output_one, output_two, lane, g_one, g_two));
  }
  LaneArray sums = lane_array(horizon_parameter_count());
  horizon_backward(parameters, one, trace_one, g_one, sums.data());
  horizon_backward(parameters, two, trace_two, g_two, sums.data());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    float sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += sums[i][lane];
    gradient[i] = sum;
  }
  return loss;
}

// Each function initialises one layer, and returns a pointer to the next one.
template <int inputs, int units>
float* start_weights(float* layer, Random& random) {
  // Glorot's initialisation bounds.
  const float reach = std::sqrt(6.0f / float(inputs + units));
  for (int i = 0; i < inputs * units; ++i) layer[i] = random.between(-reach, reach);
  return layer + inputs * units;
}

// Gates start with a factor of 1 for every input.
template <int inputs, int gates, int units>
float* start_gated(float* layer, Random& random) {
  float* const gate = start_weights<inputs, units>(layer, random);
  std::fill_n(gate, gates * units, 0.0f);
  std::fill_n(gate + gates * units, units, 0.25f);
  return layer + GatedOrder<inputs, gates, units>::count;
}

}  // namespace

std::size_t horizon_parameter_count() {
  return sizeof(HorizonNetwork) / sizeof(float);
}

void start_horizon(std::span<float> parameters, Random& random) {
  constexpr int units = HorizonNetwork::units;
  float* next = start_weights<HorizonNetwork::tap_inputs, units>(parameters.data(), random);
  // Taps above the tangent plane occlude. So we initialise all units to respond to such taps, at any
  // distance.
  for (int u = 0; u < units; ++u)
    for (const int input : {0, 2})
      parameters[std::size_t(input * units + u)] = std::abs(parameters[std::size_t(input * units + u)]);
  std::fill_n(next, units, 0.01f);
  next = start_gated<2 * units, HorizonBatch::direction_gates, units>(next + units, random);
  next = start_gated<units, HorizonBatch::join_gates, units>(next, random);
  next = start_weights<units, 1>(next, random);
  // Initially, the bent normal equals the normal.
  std::fill(next, parameters.data() + parameters.size(), 0.0f);
}

void constrain_horizon(std::span<float> parameters) {
  constexpr int first = HorizonNetwork::tap_inputs * HorizonNetwork::units;
  for (float& threshold : parameters.subspan(first, HorizonNetwork::units))
    threshold = std::max(threshold, 0.0f);
}

void export_horizon(std::span<const float> parameters, HorizonNetwork& network) {
  Network wrapper;
  wrapper.form = NetworkForm::horizon;
  const float* next = parameters.data();
  nook::nnao::visit_layers(wrapper, [&](std::span<float> values) {
    std::copy_n(next, values.size(), values.begin());
    next += values.size();
  });
  network = wrapper.horizon;
}

double horizon_step_gradient(const Dataset& data, const TrainingSettings& settings,
                             std::span<const float> parameters, std::span<const std::uint32_t> points,
                             std::uint64_t step_seed, std::span<float> gradient) {
  if (points.empty() || points.size() % lane_count != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the minibatch does not consist of whole blocks (got %zu points, need a multiple of %d)",
                  points.size(), lane_count);
  // We train on the grids for 9, 16 and 64 taps. A fourth grid has the 16 steps of 256 taps, but only 4
  // directions. The number of directions affects only the noise. The smallest grid is drawn twice as often as
  // the others, because it has the largest error.
  constexpr TapGrid grids[] = {{3, 3}, {3, 3}, {4, 4}, {8, 8}, {4, 16}};
  const TapGrid grid = grids[Random(step_seed).below(std::size(grids))];
  const std::size_t blocks = points.size() / lane_count, count = horizon_parameter_count();
  std::vector<float> parts(blocks * count);
  std::vector<double> losses(blocks);
  tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
    losses[b] = block_gradient(data, settings, parameters.data(), points.subspan(b * lane_count, lane_count),
                               grid, mix_bits(step_seed ^ (b + 1)), &parts[b * count]);
  });
  const float scale = 1 / float(points.size());
  std::ranges::fill(gradient, 0.0f);
  for (std::size_t b = 0; b < blocks; ++b)
    for (std::size_t i = 0; i < count; ++i) gradient[i] += scale * parts[b * count + i];
  double loss = 0;
  for (const double part : losses) loss += part;
  return loss * double(scale);
}

}  // namespace nook::bake::nnao
