#include "bakers/material/neural_pass.h"

#include <cmath>
#include <numbers>

namespace nook::bake::material {
namespace {

using Eigen::Index;
using Columns = NeuralPass::Columns;
using Weights = Eigen::Map<const Columns>;
using WeightGradient = Eigen::Map<Columns>;

using nook::material::neural_hidden_layer, nook::material::neural_leak;

void rectify(Columns& values) {
  values = values.cwiseMax(neural_leak * values);
}

// Converts the gradient after the rectifier to the gradient before it.
void rectify_back(const Columns& after, Columns& gradient) {
  gradient.array() *=
      (after.array() > 0).select(Eigen::ArrayXXf::Ones(after.rows(), after.cols()), neural_leak);
}

// The place of a direction on the square map of views. The directions up to the widest view are mapped to a
// disc, so that equal solid angles have equal areas. The disc is mapped to the square by the concentric map
// (P. Shirley and K. Chiu 1997).
struct Place {
  float x, y;
};
Place place_of(Vec3 view, float widest_z) {
  const float radius = std::min(std::sqrt(std::max(1 - view.z, 0.0f) / std::max(1 - widest_z, 1e-6f)), 1.0f);
  const float wide = std::max(std::abs(view.x), std::abs(view.y)),
              narrow = std::min(std::abs(view.x), std::abs(view.y));
  const float turn = wide > 0 ? 4 / std::numbers::pi_v<float> * std::atan(narrow / wide) : 0;
  const bool along_x = std::abs(view.x) > std::abs(view.y);
  return {0.5f + 0.5f * std::copysign(along_x ? radius : radius * turn, view.x),
          0.5f + 0.5f * std::copysign(along_x ? radius * turn : radius, view.y)};
}

void set_nodes(const NeuralShape& s, Vec3 view, NeuralPass::Tap& tap) {
  const Place place = place_of(view, s.widest_view_z);
  const float last = float(s.view_side - 1), u = place.x * last, v = place.y * last;
  const auto at = [&](float w) { return std::min(std::uint32_t(w), std::max(s.view_side, 2u) - 2); };
  const std::uint32_t x = at(u), y = at(v), x1 = std::min(x + 1, s.view_side - 1),
                      y1 = std::min(y + 1, s.view_side - 1);
  const float fx = u - float(x), fy = v - float(y);
  const std::uint32_t node[] = {x * s.view_side + y, x1 * s.view_side + y, x * s.view_side + y1,
                                x1 * s.view_side + y1};
  const float share[] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  std::copy_n(node, 4, tap.node);
  std::copy_n(share, 4, tap.node_share);
}

void set_texels(const NeuralShape& s, const NeuralPosition& p, float height, NeuralPass::Tap& tap) {
  const bool shifted = std::abs(height) < 1;
  const float shift = nook::material::neural_shift(height, p.view);
  const float x = float(p.texel / s.height) + p.view.x * shift * float(s.width),
              y = float(p.texel % s.height) + p.view.y * shift * float(s.height);
  const float left = std::floor(x), low = std::floor(y), fx = x - left, fy = y - low;
  const auto wrap = [](float at, std::uint32_t side) {
    const long whole = long(at) % long(side);
    return std::uint32_t(whole < 0 ? whole + long(side) : whole);
  };
  for (int i = 0; i < 4; ++i) {
    const bool right = i & 1, high = i & 2;
    tap.texel[i] = wrap(left + float(right), s.width) * s.height + wrap(low + float(high), s.height);
    tap.texel_share[i] = (right ? fx : 1 - fx) * (high ? fy : 1 - fy);
    tap.slope_x[i] = shifted ? (right ? 1.0f : -1.0f) * (high ? fy : 1 - fy) : 0;
    tap.slope_y[i] = shifted ? (right ? fx : 1 - fx) * (high ? 1.0f : -1.0f) : 0;
  }
}

using Feature = Eigen::Map<const Eigen::VectorXf>;

Feature feature_at(const NeuralNumbers& n, std::uint32_t node, std::uint32_t texel) {
  const auto channels = Index(n.shape.channels);
  return {&n.features[(node * n.shape.texels() + texel) * n.shape.channels], channels};
}

void set_light_input(Vec3 view, Vec3 light, float* to) {
  const Vec3 half = nook::material::neural_half(view, light);
  const float values[neural_light_inputs] = {light.x, light.y, light.z, half.x, half.y, half.z};
  std::copy_n(values, neural_light_inputs, to);
}

void gather(NeuralPass& pass, const NeuralNumbers& n) {
  const auto& s = n.shape;
  const Index channels = s.channels;
  const auto count = Index(pass.positions.size());
  pass.taps.resize(pass.positions.size());
  pass.input.resize(channels + neural_view_inputs, count);
  for (Index i = 0; i < count; ++i) {
    const NeuralPosition& p = pass.positions[std::size_t(i)];
    auto& tap = pass.taps[std::size_t(i)];
    set_nodes(s, p.view, tap);
    set_texels(s, p, pass.heights(0, i), tap);
    auto feature = pass.input.col(i).head(channels);
    feature.setZero();
    for (int node = 0; node < 4; ++node)
      if (tap.node_share[node] > 0)
        for (int t = 0; t < 4; ++t)
          feature += tap.node_share[node] * tap.texel_share[t] * feature_at(n, tap.node[node], tap.texel[t]);
    pass.input.col(i).tail(3) << p.view.x, p.view.y, p.view.z;
  }
}

// Sets the gradients of a layer's matrix and bias.
void set_product(std::vector<float>& weights, std::size_t where, const Columns& gradient,
                 const Columns& input) {
  WeightGradient(&weights[where], gradient.rows(), input.rows()).noalias() = gradient * input.transpose();
}
void set_sum(std::vector<float>& weights, std::size_t where, const Columns& gradient) {
  Eigen::Map<Eigen::VectorXf>(&weights[where], gradient.rows()) = gradient.rowwise().sum();
}

// Returns the derivative of the loss with respect to a height. The height moves the point at which the
// features of a position are read.
float height_gradient(const NeuralNumbers& n, Vec3 view, const NeuralPass::Tap& tap,
                      const Eigen::Ref<const Eigen::VectorXf>& gradient) {
  float along_x = 0, along_y = 0;
  for (int node = 0; node < 4; ++node) {
    if (!(tap.node_share[node] > 0)) continue;
    for (int t = 0; t < 4; ++t) {
      const float slope = tap.node_share[node] * gradient.dot(feature_at(n, tap.node[node], tap.texel[t]));
      along_x += slope * tap.slope_x[t];
      along_y += slope * tap.slope_y[t];
    }
  }
  return (along_x * view.x * float(n.shape.width) + along_y * view.y * float(n.shape.height)) *
         nook::material::neural_slope(view);
}

}  // namespace

void NeuralPass::find_heights(const NeuralNumbers& n) {
  const NeuralLayout at(n.shape);
  const auto& s = n.shape;
  const Index channels = s.offset_channels, inputs = channels + neural_view_inputs, width = s.offset_units;
  const auto count = Index(positions.size());
  offset_input.resize(inputs, count);
  for (Index i = 0; i < count; ++i) {
    const NeuralPosition& p = positions[std::size_t(i)];
    offset_input.col(i).head(channels) = Feature(&n.offset_features[p.texel * s.offset_channels], channels);
    offset_input.col(i).tail(3) << p.view.x, p.view.y, p.view.z;
  }
  offset_units.noalias() = Weights(&n.weights[at.offset_in], width, inputs) * offset_input;
  offset_units.colwise() += Feature(&n.weights[at.offset_bias], width);
  rectify(offset_units);
  heights.noalias() = Weights(&n.weights[at.offset_out], 1, width) * offset_units;
  heights.array() += n.weights[at.offset_level];
}

void NeuralPass::forward(const NeuralNumbers& n) {
  const NeuralShape& s = n.shape;
  const NeuralLayout at(s);
  const Index width = s.units, inputs = Index(s.channels + neural_view_inputs);
  const auto count = Index(positions.size()), each = Index(lights.size()) / count;
  find_heights(n);
  gather(*this, n);
  at_position.noalias() = Weights(&n.weights[at.position], width, inputs) * input;
  at_position.colwise() += Feature(&n.weights[at.position_bias], width);
  light_input.resize(neural_light_inputs, count * each);
  for (Index i = 0; i < count * each; ++i)
    set_light_input(positions[std::size_t(i / each)].view, lights[std::size_t(i)], light_input.col(i).data());
  units.resize(s.layers);
  units[0].noalias() = Weights(&n.weights[at.light], width, neural_light_inputs) * light_input;
  for (Index i = 0; i < count; ++i) units[0].middleCols(i * each, each).colwise() += at_position.col(i);
  rectify(units[0]);
  for (std::size_t layer = 1; layer < s.layers; ++layer) {
    const float* layer_weights = &n.weights[neural_hidden_layer(s, at, layer)];
    units[layer].noalias() = Weights(layer_weights, width, width) * units[layer - 1];
    units[layer].colwise() += Feature(layer_weights + width * width, width);
    rectify(units[layer]);
  }
  out.noalias() = Weights(&n.weights[at.out], 3, width) * units.back();
  out.colwise() += Feature(&n.weights[at.out_bias], 3);
}

void NeuralPass::backward(const NeuralNumbers& n) {
  const NeuralShape& s = n.shape;
  const NeuralLayout at(s);
  const Index width = s.units, inputs = Index(s.channels + neural_view_inputs);
  const auto count = Index(positions.size()), each = Index(lights.size()) / count;
  weights.assign(at.count, 0);
  set_product(weights, at.out, out, units.back());
  set_sum(weights, at.out_bias, out);
  Columns gradient = Weights(&n.weights[at.out], 3, width).transpose() * out, before;
  rectify_back(units.back(), gradient);
  for (std::size_t layer = s.layers - 1; layer > 0; --layer) {
    const std::size_t where = neural_hidden_layer(s, at, layer);
    set_product(weights, where, gradient, units[layer - 1]);
    set_sum(weights, where + s.units * s.units, gradient);
    before.noalias() = Weights(&n.weights[where], width, width).transpose() * gradient;
    rectify_back(units[layer - 1], before);
    gradient.swap(before);
  }
  set_product(weights, at.light, gradient, light_input);
  Columns sums(width, count);
  for (Index i = 0; i < count; ++i) sums.col(i) = gradient.middleCols(i * each, each).rowwise().sum();
  set_product(weights, at.position, sums, input);
  set_sum(weights, at.position_bias, sums);
  features.noalias() =
      Weights(&n.weights[at.position], width, inputs).leftCols(s.channels).transpose() * sums;
  for (Index i = 0; i < count; ++i)
    heights(0, i) = height_gradient(n, positions[std::size_t(i)].view, taps[std::size_t(i)], features.col(i));
  heights_backward(n);
}

void NeuralPass::heights_backward(const NeuralNumbers& n) {
  const NeuralShape& s = n.shape;
  const NeuralLayout at(s);
  set_product(weights, at.offset_out, heights, offset_units);
  set_sum(weights, at.offset_level, heights);
  Columns gradient = Weights(&n.weights[at.offset_out], 1, s.offset_units).transpose() * heights;
  rectify_back(offset_units, gradient);
  set_product(weights, at.offset_in, gradient, offset_input);
  set_sum(weights, at.offset_bias, gradient);
  offset_features.noalias() =
      Weights(&n.weights[at.offset_in], s.offset_units, s.offset_channels + neural_view_inputs)
          .leftCols(s.offset_channels)
          .transpose() *
      gradient;
}

void NeuralPass::scatter(const NeuralShape& s, std::span<float> feature_gradient,
                         std::span<float> offset_gradient) const {
  using Sum = Eigen::Map<Eigen::VectorXf>;
  for (std::size_t i = 0; i < positions.size(); ++i)
    Sum(&offset_gradient[positions[i].texel * s.offset_channels], s.offset_channels) +=
        offset_features.col(Index(i));
  for (Index i = 0; i < features.cols(); ++i) {
    const Tap& tap = taps[std::size_t(i)];
    for (int node = 0; node < 4; ++node)
      for (int t = 0; t < 4; ++t)
        if (tap.node_share[node] > 0)
          Sum(&feature_gradient[(tap.node[node] * s.texels() + tap.texel[t]) * s.channels], s.channels) +=
              tap.node_share[node] * tap.texel_share[t] * features.col(i);
  }
}

}  // namespace nook::bake::material
