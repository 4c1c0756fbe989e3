// The layers of network.h forwards and backwards, on one sample (float) or sixteen at once (Lanes).
#pragma once

#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/compiler.h"

namespace nook::bake::nnao {

inline constexpr int lane_count = 16;
typedef float Lanes __attribute__((vector_size(4 * lane_count)));
// std::vector is not used, because its allocator may not support the alignment of the widest instructions.
using LaneArray = AlignedArray<Lanes>;
inline LaneArray lane_array(std::size_t count) {
  return {count, default_memory()};
}

// The layers of network.h are Dense, LeakyDense, RectifiedDense and LinearDense; their numbers are in the
// order of layers.h.
template <int inputs, int units>
struct LayerOrder {
  static constexpr int weights = 0, bias = inputs * units, negative = bias + units,
                       positive = negative + units, count = positive + units;
};

// before receives the values before the PReLU.
template <int inputs, int units, class Number>
NOOK_INLINE void forward(const float* layer, const Number* input, Number* before, Number* output) {
  using Order = LayerOrder<inputs, units>;
  for (int u = 0; u < units; ++u) {
    Number sum = Number{} + layer[Order::bias + u];
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    before[u] = sum;
    output[u] = sum > 0 ? layer[Order::positive + u] * sum : layer[Order::negative + u] * sum;
  }
}

// Adds the gradient of the layer's numbers to `gradient`, and sets the gradient of the inputs if it is not
// null.
template <int inputs, int units, class Number>
NOOK_INLINE void backward(const float* layer, const Number* input, const Number* before,
                          const Number* output_gradient, Number* gradient, Number* input_gradient) {
  using Order = LayerOrder<inputs, units>;
  const Number zero{};
  if (input_gradient)
    for (int i = 0; i < inputs; ++i) input_gradient[i] = zero;
  for (int u = 0; u < units; ++u) {
    const Number g_out = output_gradient[u], x = before[u];
    gradient[Order::negative + u] += x > 0 ? zero : g_out * x;
    gradient[Order::positive + u] += x > 0 ? g_out * x : zero;
    const Number g = x > 0 ? layer[Order::positive + u] * g_out : layer[Order::negative + u] * g_out;
    gradient[Order::bias + u] += g;
    for (int i = 0; i < inputs; ++i) {
      gradient[i * units + u] += g * input[i];
      if (input_gradient) input_gradient[i] += layer[i * units + u] * g;
    }
  }
}

template <int inputs, int units>
struct LeakyOrder {
  static constexpr int weights = 0, bias = inputs * units, slope = bias + units, count = slope + units;
};
// A RectifiedDense has weights alone.
template <int inputs, int units>
struct LinearOrder {
  static constexpr int weights = 0, bias = inputs * units, count = bias + units;
};

template <int inputs, int units, class Number>
NOOK_INLINE void linear_forward(const float* layer, const Number* input, Number* output) {
  for (int u = 0; u < units; ++u) {
    Number sum = Number{} + layer[LinearOrder<inputs, units>::bias + u];
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    output[u] = sum;
  }
}

template <int inputs, int units, class Number>
NOOK_INLINE void linear_backward(const float* layer, const Number* input, const Number* output_gradient,
                                 Number* gradient, Number* input_gradient) {
  if (input_gradient)
    for (int i = 0; i < inputs; ++i) input_gradient[i] = Number{};
  for (int u = 0; u < units; ++u) {
    const Number g = output_gradient[u];
    gradient[LinearOrder<inputs, units>::bias + u] += g;
    for (int i = 0; i < inputs; ++i) {
      gradient[i * units + u] += g * input[i];
      if (input_gradient) input_gradient[i] += layer[i * units + u] * g;
    }
  }
}

template <int inputs, int units, class Number>
NOOK_INLINE void rectified_forward(const float* layer, const Number* input, Number* output) {
  const Number zero{};
  for (int u = 0; u < units; ++u) {
    Number sum{};
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    output[u] = sum > 0 ? sum : zero;
  }
}

// Adds the gradient of the layer's numbers to `gradient`.
template <int inputs, int units, class Number>
NOOK_INLINE void rectified_backward(const Number* input, const Number* output, const Number* output_gradient,
                                    Number* gradient) {
  const Number zero{};
  for (int u = 0; u < units; ++u) {
    const Number g = output[u] > 0 ? output_gradient[u] : zero;
    for (int i = 0; i < inputs; ++i) gradient[i * units + u] += g * input[i];
  }
}

// before receives the sums.
template <int inputs, int units, class Number>
NOOK_INLINE void leaky_forward(const float* layer, const Number* input, Number* before, Number* output) {
  linear_forward<inputs, units>(layer, input, before);
  for (int u = 0; u < units; ++u) {
    const Number sloped = layer[LeakyOrder<inputs, units>::slope + u] * before[u];
    output[u] = before[u] > sloped ? before[u] : sloped;
  }
}

template <int inputs, int units, class Number>
NOOK_INLINE void leaky_backward(const float* layer, const Number* input, const Number* before,
                                const Number* output_gradient, Number* gradient, Number* input_gradient) {
  constexpr int slope = LeakyOrder<inputs, units>::slope;
  const Number zero{};
  Number g_sum[units];
  for (int u = 0; u < units; ++u) {
    const Number g = output_gradient[u], sloped = layer[slope + u] * before[u];
    gradient[slope + u] += before[u] > sloped ? zero : g * before[u];
    g_sum[u] = before[u] > sloped ? g : layer[slope + u] * g;
  }
  linear_backward<inputs, units>(layer, input, g_sum, gradient, input_gradient);
}

}  // namespace nook::bake::nnao
