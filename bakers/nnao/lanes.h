// Forward and backward passes of the layers of network.h, on one sample (float) or on sixteen at once
// (Lanes).
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

// The layers of network.h are Dense, ThresholdDense and GatedDense. Their parameters are in the order of
// layers.h.
template <int inputs, int units>
struct LayerOrder {
  static constexpr int weights = 0, bias = inputs * units, negative = bias + units,
                       positive = negative + units, count = positive + units;
};

// `before` receives the values before the PReLU.
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

// Adds the gradient of the layer's parameters to `gradient`. If input_gradient is not null, it receives the
// gradient of the inputs.
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

template <int inputs, int gates, int units>
struct GatedOrder {
  static constexpr int weights = 0, gate = inputs * units, slope = gate + gates * units,
                       count = slope + units;
};

template <int inputs, int units, class Number>
NOOK_INLINE void threshold_forward(const float* layer, const Number* input, Number* output) {
  const Number zero{};
  for (int u = 0; u < units; ++u) {
    Number sum = Number{} - layer[inputs * units + u];
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    output[u] = sum > 0 ? sum : zero;
  }
}

// Adds the gradient of the layer's parameters to `gradient`.
template <int inputs, int units, class Number>
NOOK_INLINE void threshold_backward(const Number* input, const Number* output, const Number* output_gradient,
                                    Number* gradient) {
  const Number zero{};
  for (int u = 0; u < units; ++u) {
    const Number g = output[u] > 0 ? output_gradient[u] : zero;
    gradient[inputs * units + u] -= g;
    for (int i = 0; i < inputs; ++i) gradient[i * units + u] += g * input[i];
  }
}

template <int inputs, int gates, int units, class Number>
NOOK_INLINE void set_gate_factor(const float* layer, const Number* gate, int unit, Number& factor) {
  factor = Number{} + 1.0f;
  for (int i = 0; i < gates; ++i)
    factor += layer[GatedOrder<inputs, gates, units>::gate + i * units + unit] * gate[i];
}

// `sums` receives the sums before the gate.
template <int inputs, int gates, int units, class Number>
NOOK_INLINE void gated_forward(const float* layer, const Number* input, const Number* gate, Number* sums,
                               Number* output) {
  for (int u = 0; u < units; ++u) {
    Number sum{};
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    sums[u] = sum;
    Number factor;
    set_gate_factor<inputs, gates, units>(layer, gate, u, factor);
    const Number gated = sum * factor;
    const Number sloped = layer[GatedOrder<inputs, gates, units>::slope + u] * gated;
    output[u] = gated > sloped ? gated : sloped;
  }
}

// Adds the gradient of the layer's parameters to `gradient`, and sets the gradient of the inputs.
template <int inputs, int gates, int units, class Number>
NOOK_INLINE void gated_backward(const float* layer, const Number* input, const Number* gate,
                                const Number* sums, const Number* output_gradient, Number* gradient,
                                Number* input_gradient) {
  using Order = GatedOrder<inputs, gates, units>;
  const Number zero{};
  for (int i = 0; i < inputs; ++i) input_gradient[i] = zero;
  for (int u = 0; u < units; ++u) {
    Number factor;
    set_gate_factor<inputs, gates, units>(layer, gate, u, factor);
    const Number g = output_gradient[u];
    const Number gated = sums[u] * factor, sloped = layer[Order::slope + u] * gated;
    gradient[Order::slope + u] += gated > sloped ? zero : g * gated;
    const Number g_gated = gated > sloped ? g : layer[Order::slope + u] * g;
    const Number g_sum = g_gated * factor, g_factor = g_gated * sums[u];
    for (int i = 0; i < gates; ++i) gradient[Order::gate + i * units + u] += g_factor * gate[i];
    for (int i = 0; i < inputs; ++i) {
      gradient[i * units + u] += g_sum * input[i];
      input_gradient[i] += layer[i * units + u] * g_sum;
    }
  }
}

// The parameters of GatedLinear: the same as for GatedDense, but without slopes.
template <int inputs, int gates, int units>
struct LinearOrder {
  static constexpr int gate = GatedOrder<inputs, gates, units>::gate, count = gate + gates * units;
};

// `sums` receives the sums before the gate.
template <int inputs, int gates, int units, class Number>
NOOK_INLINE void linear_forward(const float* layer, const Number* input, const Number* gate, Number* sums,
                                Number* output) {
  for (int u = 0; u < units; ++u) {
    Number sum{};
    for (int i = 0; i < inputs; ++i) sum += layer[i * units + u] * input[i];
    sums[u] = sum;
    Number factor;
    set_gate_factor<inputs, gates, units>(layer, gate, u, factor);
    output[u] = sum * factor;
  }
}

// Adds the gradient of the layer's parameters to `gradient`, and the gradient of the inputs to
// input_gradient.
template <int inputs, int gates, int units, class Number>
NOOK_INLINE void linear_backward(const float* layer, const Number* input, const Number* gate,
                                 const Number* sums, const Number* output_gradient, Number* gradient,
                                 Number* input_gradient) {
  for (int u = 0; u < units; ++u) {
    Number factor;
    set_gate_factor<inputs, gates, units>(layer, gate, u, factor);
    const Number g_sum = output_gradient[u] * factor, g_factor = output_gradient[u] * sums[u];
    for (int i = 0; i < gates; ++i)
      gradient[LinearOrder<inputs, gates, units>::gate + i * units + u] += g_factor * gate[i];
    for (int i = 0; i < inputs; ++i) {
      gradient[i * units + u] += g_sum * input[i];
      input_gradient[i] += layer[i * units + u] * g_sum;
    }
  }
}

}  // namespace nook::bake::nnao
