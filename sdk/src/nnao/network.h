// The networks of the screen-space pass as plain data. View space is the same as in OpenGL: x points right, y
// up, and the camera looks along -z. The method is by D. Holden, J. Saito, T. Komura: Neural Network Ambient
// Occlusion, 2016.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/containers.h"
#include "shaders/nnao/layout.h"

namespace nook::nnao {

enum class NetworkForm : std::uint32_t {
  paper = 0,    // filters over a grid of taps, then three small layers
  horizon = 1,  // one layer along each direction, then one over the directions
};

// A layer with the activation PReLU(x) = positive_slope max(x, 0) + negative_slope min(x, 0), equation 1 of
// the paper. Each unit has its own pair of slopes.
template <int inputs, int units>
struct Dense {
  std::array<float, std::size_t(inputs) * units> weights{};  // weights[input * units + unit]
  std::array<float, units> bias{};
  std::array<float, units> negative_slope{};
  std::array<float, units> positive_slope{};
};

// The paper's network. Tap (column, row) of a grid_size x grid_size grid lies at the view-space offset
//   r (2 (column + 0.5) / grid_size - 1, 2 (row + 0.5) / grid_size - 1, 0)
// from the pixel's position p. The tap is projected to the screen, and the depth and normal buffers give the
// position p_t and the normal n_t there. The input of the tap is
//   (n_t - n, (p_t.z - p.z) / r) clamp(1 - |p_t - p| / r, 0, 1).
// The filters and the bias already include the normalisation of the inputs by mean and standard deviation. If
// only n taps of the grid are used, the sum over taps is multiplied by grid_size^2 / n. taps.h computes the
// positions of the taps.
struct PaperNetwork {
  static constexpr int grid_size = NOOK_GRID_SIZE;
  static constexpr int tap_inputs = 4;
  static constexpr int units = NOOK_PAPER_UNITS;

  Vector<float> filters;  // grid_size^2 x tap_inputs x units, row by row
  std::array<float, units> bias{};
  std::array<float, units> negative_slope{};
  std::array<float, units> positive_slope{};
  Dense<units, units> layer_1;
  Dense<units, units> layer_2;
  Dense<units, 1> layer_3;
};

// A gated layer: y = max(x, slope x), where x = (weights . input) (1 + gate_weights . gate). Each unit has
// its own weights, gate weights and slope.
template <int inputs, int gates, int units>
struct GatedDense {
  std::array<float, std::size_t(inputs) * units> weights{};      // weights[input * units + unit]
  std::array<float, std::size_t(gates) * units> gate_weights{};  // gate_weights[gate * units + unit]
  std::array<float, units> slope{};
};

// A gated layer without an activation: y = (weights . input) (1 + gate_weights . gate).
template <int inputs, int gates, int units>
struct GatedLinear {
  std::array<float, std::size_t(inputs) * units> weights{};      // weights[input * units + unit]
  std::array<float, std::size_t(gates) * units> gate_weights{};  // gate_weights[gate * units + unit]
};

// y = max(x - threshold, 0), where x = weights . input.
template <int inputs, int units>
struct ThresholdDense {
  std::array<float, std::size_t(inputs) * units> weights{};
  std::array<float, units> threshold{};  // 0 or more
};

// Nook's network. The taps lie along `directions` half-lines on the screen, with `steps` taps on each
// half-line. A tap outside the screen is moved to the nearest pixel on the screen. v = p_t - p is the vector
// to the tap, where |v| is at least half a pixel, and o = -p / |p| (orthographic: +z) is the direction to the
// viewer. s = dot(v, n) / |v| is the elevation, c = dot(v, o) / |v| the cosine of the angle to the viewer,
// and w = max(1 - |v| / 2r, 0) the nearness. A tap's hidden units are the output of the layer `tap` for
//   input = (s, s c, s w, s c w).
// The sky is treated as a surface at infinity. The input of the layer `direction` is the maximum and the mean
// of the tap units over the steps of a direction. The gate of `direction` is (dot(n, t), dot(n, o)), where t
// is the unit vector perpendicular to o in the plane of the direction. The input of the layer `join` is the
// mean of the `direction` units over all directions. The gate of `join` is dot(n, o) and the distance of the
// pixel from the border of the screen in radii, at most 1. AO is
//   1 - min(-dot(out, join), bound),
// where `bound` is NOOK_HORIZON_BOUND times the mean, over all directions, of the greatest max(s w, 0) of a
// direction's taps. So the AO of a pixel is 1 unless some tap is both near the pixel and above its plane.
// Surfaces far behind a silhouette do not darken the pixel. The layer `bent` has the same input and gate as
// `direction`, and two outputs (p, q) for each direction. The bent normal is the cosine-weighted mean of the
// open directions, and points along
//   n + mean over directions of (p t + q o).
// The tap layer has thresholds; the other layers have no bias. If every tap lies below the pixel's plane or
// only slightly above it, all units are 0 and AO is 1. So a plane is fully open from every viewing angle, up
// to the border of the screen, even if depth and normals are rounded.
struct HorizonNetwork {
  static constexpr int revision = 8;  // increment it when the meaning of the weights changes
  static constexpr int tap_inputs = NOOK_HORIZON_TAP_INPUTS;
  static constexpr int units = NOOK_HORIZON_UNITS;

  ThresholdDense<tap_inputs, units> tap;
  GatedDense<2 * units, 2, units> direction;
  GatedDense<units, 2, units> join;
  std::array<float, units> out{};
  GatedLinear<2 * units, 2, 2> bent;
};

// AO is the output of the network, clamped to [0, 1]; 1 is fully open.
struct Network {
  explicit Network(Memory* memory = default_memory())
      : paper{Vector<float>(memory), {}, {}, {}, {}, {}, {}}, recipe(memory) {}

  NetworkForm form = NetworkForm::paper;
  PaperNetwork paper;      // used if form is paper
  HorizonNetwork horizon;  // used if form is horizon
  String recipe;           // settings of the training, JSON
};

}  // namespace nook::nnao
