#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "bakers/nnao/forms.h"
#include "bakers/nnao/lanes.h"
#include "bakers/raytrace/clones.h"
#include "sdk/src/nnao/layers.h"

namespace nook::bake::nnao {
namespace {

using nook::nnao::PaperNetwork;
constexpr int units = PaperNetwork::units, tap_inputs = PaperNetwork::tap_inputs;
constexpr std::uint32_t cells = PaperNetwork::grid_size * PaperNetwork::grid_size;
constexpr std::size_t input_count = std::size_t(cells) * tap_inputs;

// The offset of each part in the parameter array.
constexpr std::size_t filters = 0, first_bias = input_count * units, first_negative = first_bias + units,
                      first_positive = first_negative + units, layer_1 = first_positive + units,
                      layer_2 = layer_1 + LayerOrder<units, units>::count,
                      layer_3 = layer_2 + LayerOrder<units, units>::count,
                      parameter_total = layer_3 + LayerOrder<units, 1>::count;

// Gathers all inputs of a point, before normalisation.
void gather(const Dataset& data, const DataPoint& point, float* inputs) {
  using namespace nook::nnao;
  const View view = data.views[point.view].view();
  const float depth = view.depth[view.at(point.x, point.y)];
  const Vec3 position = view_position(view.rays, float(point.x) + 0.5f, float(point.y) + 0.5f, depth);
  const PixelScale scale = pixel_scale(view.rays, depth);
  for (std::uint32_t cell = 0; cell < cells; ++cell, inputs += tap_inputs) {
    const TapOffset offset = paper_tap(cell, cells, {}, point.radius, scale);
    std::array<float, tap_inputs> input;
    if (!paper_tap_input(view, tapped_texel(view, point.x, point.y, offset), position, point.normal,
                         point.radius, input))
      input = {};
    std::memcpy(inputs, input.data(), sizeof input);
  }
}

NOOK_INLINE void dots_plain(const float* weights, const float* inputs, float* sums) {
  for (int u = 0; u < units; ++u) {
    // With sixteen parallel sums, the order of additions does not depend on the register width.
    Lanes sum{};
    const float* w = weights + std::size_t(u) * input_count;
    std::size_t i = 0;
    for (; i + lane_count <= input_count; i += lane_count) {
      Lanes a, b;
      std::memcpy(&a, w + i, sizeof a);
      std::memcpy(&b, inputs + i, sizeof b);
      sum += a * b;
    }
    sums[u] = 0;
    for (int lane = 0; lane < lane_count; ++lane) sums[u] += sum[lane];
    for (; i < input_count; ++i) sums[u] += w[i] * inputs[i];
  }
}

NOOK_CLONED(void, dots, (const float* weights, const float* inputs, float* sums), (weights, inputs, sums))

NOOK_INLINE void add_outer_plain(const float* unit_gradient, const float* inputs, float* gradient) {
  for (int u = 0; u < units; ++u)
    for (std::size_t i = 0; i < input_count; ++i)
      gradient[std::size_t(u) * input_count + i] += unit_gradient[u] * inputs[i];
}

NOOK_CLONED(void, add_outer, (const float* unit_gradient, const float* inputs, float* gradient),
            (unit_gradient, inputs, gradient))

// Returns the loss of one point, and adds its gradient to `gradient`.
double point_gradient(const Dataset& data, const PaperNormalisation& normalisation,
                      const TrainingSettings& settings, const float* parameters, const DataPoint& point,
                      Random& random, std::vector<float>& inputs, float* gradient) {
  gather(data, point, inputs.data());
  const float keep = 1 - settings.dropout, scale = 1 / keep;
  for (std::size_t i = 0; i < input_count; i += 2) {
    // Splits one 64-bit random value into two 32-bit random values.
    const std::uint64_t bits = random.bits();
    for (std::size_t j = 0; j < 2; ++j) {
      const bool kept = float(std::uint32_t(bits >> (32 * j)) >> 8) * 0x1p-24f < keep;
      float& x = inputs[i + j];
      x = kept ? (x - normalisation.mean[i + j]) * normalisation.inverse_deviation[i + j] * scale : 0;
    }
  }
  float before_0[units], hidden_0[units], before_1[units], hidden_1[units], before_2[units], hidden_2[units],
      before_3[1], output[1];
  dots(parameters + filters, inputs.data(), before_0);
  for (int u = 0; u < units; ++u) {
    before_0[u] += parameters[first_bias + std::size_t(u)];
    hidden_0[u] =
        before_0[u] * parameters[(before_0[u] > 0 ? first_positive : first_negative) + std::size_t(u)];
  }
  forward<units, units>(parameters + layer_1, hidden_0, before_1, hidden_1);
  forward<units, units>(parameters + layer_2, hidden_1, before_2, hidden_2);
  forward<units, 1>(parameters + layer_3, hidden_2, before_3, output);
  const float error = output[0] - point.ao, g_output[1] = {2 * error};
  float g_2[units], g_1[units], g_0[units];
  backward<units, 1>(parameters + layer_3, hidden_2, before_3, g_output, gradient + layer_3, g_2);
  backward<units, units>(parameters + layer_2, hidden_1, before_2, g_2, gradient + layer_2, g_1);
  backward<units, units>(parameters + layer_1, hidden_0, before_1, g_1, gradient + layer_1, g_0);
  for (std::size_t u = 0; u < units; ++u) {
    const bool positive = before_0[u] > 0;
    gradient[(positive ? first_positive : first_negative) + u] += g_0[u] * before_0[u];
    g_0[u] *= parameters[(positive ? first_positive : first_negative) + u];
    gradient[first_bias + u] += g_0[u];
  }
  add_outer(g_0, inputs.data(), gradient + filters);
  return double(error) * double(error);
}

}  // namespace

std::size_t paper_parameter_count() {
  return parameter_total;
}

void start_paper(std::span<float> parameters, float mean_ao, Random& random) {
  const auto fill = [&](std::size_t first, std::size_t count, float reach) {
    for (std::size_t i = first; i < first + count; ++i) parameters[i] = random.between(-reach, reach);
  };
  // Glorot's initialisation bounds.
  fill(filters, input_count * units, std::sqrt(6.0f / float(input_count + units)));
  for (std::size_t u = 0; u < units; ++u) {
    parameters[first_bias + u] = 0;
    parameters[first_negative + u] = 0.25f;
    parameters[first_positive + u] = 1;
  }
  const auto small = [&](std::size_t first, std::size_t outputs, float bias) {
    fill(first, units * outputs, std::sqrt(6.0f / float(units + outputs)));
    for (std::size_t u = 0; u < outputs; ++u) {
      parameters[first + units * outputs + u] = bias;
      parameters[first + units * outputs + outputs + u] = 0.25f;
      parameters[first + units * outputs + 2 * outputs + u] = 1;
    }
  };
  small(layer_1, units, 0);
  small(layer_2, units, 0);
  small(layer_3, 1, mean_ao);
}

PaperNormalisation paper_normalisation(const Dataset& data) {
  // About 20,000 points are enough for the mean and the deviation.
  const std::size_t stride = data.training.size() / 20000 + 1, count = data.training.size() / stride;
  std::vector<double> sum(input_count), squares(input_count);
  std::vector<float> inputs(input_count);
  for (std::size_t n = 0; n < count; ++n) {
    gather(data, data.training[n * stride], inputs.data());
    for (std::size_t i = 0; i < input_count; ++i) {
      sum[i] += double(inputs[i]);
      squares[i] += double(inputs[i]) * double(inputs[i]);
    }
  }
  PaperNormalisation normalisation{std::vector<float>(input_count), std::vector<float>(input_count)};
  std::array<double, tap_inputs> largest{};
  const auto variance = [&](std::size_t i) {
    const double mean = sum[i] / double(count);
    return std::max(0.0, squares[i] / double(count) - mean * mean);
  };
  for (std::size_t i = 0; i < input_count; ++i)
    largest[i % tap_inputs] = std::max(largest[i % tap_inputs], variance(i));
  for (std::size_t i = 0; i < input_count; ++i) {
    normalisation.mean[i] = float(sum[i] / double(count));
    // The weight of a tap falls to 0 at the rim of the grid, and so does its deviation. If we divided by it,
    // the rim would dominate the filters. So we raise each deviation to at least a quarter of the largest
    // deviation of the same kind of input.
    const double deviation = std::sqrt(std::max(variance(i), largest[i % tap_inputs] / 16));
    normalisation.inverse_deviation[i] = deviation > 0 ? float(1 / deviation) : 0;
  }
  return normalisation;
}

void export_paper(std::span<const float> parameters, const PaperNormalisation& normalisation,
                  PaperNetwork& network) {
  network.filters.resize(input_count * units);
  std::array<double, units> shift{};
  for (std::size_t i = 0; i < input_count; ++i)
    for (std::size_t u = 0; u < units; ++u) {
      const float weight = parameters[filters + u * input_count + i] * normalisation.inverse_deviation[i];
      network.filters[i * units + u] = weight;
      shift[u] += double(weight) * double(normalisation.mean[i]);
    }
  Network wrapper;
  wrapper.form = NetworkForm::paper;
  const float* next = parameters.data() + first_bias;
  nook::nnao::visit_layers(wrapper, [&](std::span<float> values) {
    std::copy_n(next, values.size(), values.begin());
    next += values.size();
  });
  wrapper.paper.filters = std::move(network.filters);
  for (std::size_t u = 0; u < units; ++u) wrapper.paper.bias[u] -= float(shift[u]);
  network = std::move(wrapper.paper);
}

double paper_step_gradient(const Dataset& data, const PaperNormalisation& normalisation,
                           const TrainingSettings& settings, std::span<const float> parameters,
                           std::span<const std::uint32_t> points, std::uint64_t step_seed,
                           std::span<float> gradient) {
  // Blocks have a fixed size and are summed in order, so that the result does not depend on the number of
  // threads.
  constexpr std::size_t block = 8;
  const std::size_t blocks = (points.size() + block - 1) / block;
  std::vector<float> parts(blocks * parameter_total);
  std::vector<double> losses(blocks);
  tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
    Random random(mix_bits(step_seed ^ (b + 1)));
    std::vector<float> inputs(input_count);
    for (std::size_t i = b * block; i < std::min(points.size(), (b + 1) * block); ++i)
      losses[b] += point_gradient(data, normalisation, settings, parameters.data(), data.training[points[i]],
                                  random, inputs, &parts[b * parameter_total]);
  });
  const float scale = 1 / float(points.size()), decay = settings.gamma / float(parameter_total);
  double loss = 0, magnitude = 0;
  for (std::size_t i = 0; i < parameter_total; ++i) {
    float sum = 0;
    for (std::size_t b = 0; b < blocks; ++b) sum += parts[b * parameter_total + i];
    const float p = parameters[i];
    gradient[i] = scale * sum + decay * float((p > 0) - (p < 0));
    magnitude += double(std::abs(p));
  }
  for (const double part : losses) loss += part;
  return loss * double(scale) + double(decay) * magnitude;
}

}  // namespace nook::bake::nnao
