// The networks of the screen-space pass as plain data. View space is OpenGL's: x right, y up, the camera
// looks along -z. The method is by D. Holden, J. Saito, T. Komura: Neural Network Ambient Occlusion, 2016.
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

// PReLU(x) = positive_slope max(x, 0) + negative_slope min(x, 0), with one pair of slopes for each unit
// (equation 1).
template <int inputs, int units>
struct Dense {
  std::array<float, std::size_t(inputs) * units> weights{};  // weights[input * units + unit]
  std::array<float, units> bias{};
  std::array<float, units> negative_slope{};
  std::array<float, units> positive_slope{};
};

// The paper's network. Tap (column, row) of a grid_size x grid_size grid lies at the view-space offset
//   r (2 (column + 0.5) / grid_size - 1, 2 (row + 0.5) / grid_size - 1, 0)
// from the pixel's position p. It is projected to the screen, where the buffers give position p_t and normal
// n_t. Its input is
//   (n_t - n, (p_t.z - p.z) / r) clamp(1 - |p_t - p| / r, 0, 1).
// Filters and bias already contain the normalisation by mean and deviation. With a subset of n taps, the sum
// over taps is scaled by grid_size^2 / n. taps.h has the positions of the taps.
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

// y = max(x, slope x). x is a sum of products of the input, times 1 + a sum of products of the gate's values.
// Each unit has its own gate and slope.
template <int inputs, int gates, int units>
struct GatedDense {
  std::array<float, std::size_t(inputs) * units> weights{};      // weights[input * units + unit]
  std::array<float, std::size_t(gates) * units> gate_weights{};  // gate_weights[gate * units + unit]
  std::array<float, units> slope{};
};

// y = a sum of products of the input, times 1 + a sum of products of the gate's values.
template <int inputs, int gates, int units>
struct GatedLinear {
  std::array<float, std::size_t(inputs) * units> weights{};      // weights[input * units + unit]
  std::array<float, std::size_t(gates) * units> gate_weights{};  // gate_weights[gate * units + unit]
};

// y = max(x - threshold, 0), where x is a sum of products.
template <int inputs, int units>
struct ThresholdDense {
  std::array<float, std::size_t(inputs) * units> weights{};
  std::array<float, units> threshold{};  // 0 or more
};

// Nook's network. The taps lie along `directions` half-lines on the screen, with `steps` taps on each. A tap
// off the screen is moved to the nearest pixel on it. With v = p_t - p, the direction to the viewer o = -p /
// |p| (orthographic: +z), the elevation s = dot(v, n) / |v|, the angle c = dot(v, o) / |v| and the nearness
// w = max(1 - |v| / 2r, 0), where |v| is at least half a pixel, a tap's hidden units are tap(input) of
//   input = (s, s c, s w, s c w).
// The sky is a surface at infinity. The input of `direction` is the maximum and the mean of the units over
// the steps of a direction. Its gate is (dot(n, t), dot(n, o)), where t is the unit vector perpendicular to o
// in the plane of the direction. The input of `join` is the mean over directions. Its gate is dot(n, o) and
// the distance of the pixel from the border of the screen in radii, at most 1. AO is
//   1 - min(-dot(out, join), bound),
// where bound is NOOK_HORIZON_BOUND times the mean over directions of the greatest max(s w, 0) of a
// direction. Without a tap that is near and above the plane, nothing darkens, whatever lies behind a
// silhouette. bent has the input and the gate of `direction`, and two outputs (p, q) for each direction. The
// bent normal is the cosine-weighted mean of the open directions, and points along
//   n + mean over directions of (p t + q o).
// Only taps have a threshold, and no other layer has a bias. If no tap lies more than a little above the
// pixel's plane, all units are 0 and AO is 1. So a plane is open from every angle, up to the border of the
// screen, even with rounded depth and normals.
struct HorizonNetwork {
  static constexpr int revision = 8;  // raise it when the meaning of the numbers changes
  static constexpr int tap_inputs = NOOK_HORIZON_TAP_INPUTS;
  static constexpr int units = NOOK_HORIZON_UNITS;

  ThresholdDense<tap_inputs, units> tap;
  GatedDense<2 * units, 2, units> direction;
  GatedDense<units, 2, units> join;
  std::array<float, units> out{};
  GatedLinear<2 * units, 2, 2> bent;
};

// AO is the network's output clamped to [0, 1]; 1 is open.
struct Network {
  explicit Network(Memory* memory = default_memory())
      : paper{Vector<float>(memory), {}, {}, {}, {}, {}, {}}, recipe(memory) {}

  NetworkForm form = NetworkForm::paper;
  PaperNetwork paper;      // used if form is paper
  HorizonNetwork horizon;  // used if form is horizon
  String recipe;           // settings of the training, JSON
};

}  // namespace nook::nnao
