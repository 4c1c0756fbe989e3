#include "sdk/src/gl/nnao/network_shader.h"

#include <cassert>
#include <cstdio>
#include <cstring>

#include "shaders/nnao/layout.h"

namespace nook::gl {

PassDefines pass_defines(const NnaoSettings& desc, bool horizon, const nnao::TapGrid& grid) {
  PassDefines defines;
  std::snprintf(
      defines.text, sizeof defines.text,
      "#define NOOK_HALF %d\n#define NOOK_HORIZON %d\n#define NOOK_DIRECTIONS %u\n#define NOOK_STEPS %u\n"
      "#define NOOK_BENT_NORMALS %d\n#define NOOK_TEMPORAL %d\n",
      desc.half_resolution != 0, horizon, grid.directions, grid.steps, desc.bent_normals,
      desc.max_history_frames != 0);
  std::size_t used = std::strlen(defines.text);
  if (desc.views > 0)
    used += std::size_t(
        std::snprintf(defines.text + used, sizeof defines.text - used, "#define NOOK_LAYERS 1\n"));
  if (desc.depth_samples > 0)
    used += std::size_t(std::snprintf(defines.text + used, sizeof defines.text - used,
                                      "#define NOOK_SAMPLES %d\n#define NOOK_SAMPLE_RULE %d\n",
                                      desc.depth_samples, desc.depth_sample));
  if (desc.normal_samples > 0)
    std::snprintf(defines.text + used, sizeof defines.text - used, "#define NOOK_NORMAL_SAMPLES 1\n");
  return defines;
}

namespace {

using Floats = Vector<float>;

template <std::size_t count>
void add(Floats& out, const std::array<float, count>& values) {
  out.insert(out.end(), values.begin(), values.end());
}

// A layer with one unit ends with its bias, both slopes and a zero, so that each layer starts at a multiple
// of four.
template <int inputs, int units>
void add(Floats& out, const nnao::Dense<inputs, units>& layer) {
  add(out, layer.weights);
  add(out, layer.bias);
  add(out, layer.negative_slope);
  add(out, layer.positive_slope);
  if constexpr (units == 1) out.push_back(0);
}

template <int inputs, int units>
void add(Floats& out, const nnao::ThresholdDense<inputs, units>& layer) {
  add(out, layer.weights);
  add(out, layer.threshold);
}

template <int inputs, int gates, int units>
void add(Floats& out, const nnao::GatedDense<inputs, gates, units>& layer) {
  add(out, layer.weights);
  add(out, layer.gate_weights);
  add(out, layer.slope);
}

// Each vec4 contains four weights of one output. The order is: the weights of the maxima for both outputs,
// the weights of the sums for both outputs, and the gates of both outputs. The shader sums instead of
// averaging, so the weights of the maxima are divided by the number of directions, and the weights of the
// sums by the number of taps.
template <int inputs>
void add_bent(Floats& out, const nnao::GatedLinear<inputs, 2, 2>& layer, nnao::TapGrid grid) {
  for (int first = 0; first < inputs; first += 4)
    for (int unit = 0; unit < 2; ++unit)
      for (int input = first; input < first + 4; ++input)
        out.push_back(layer.weights[std::size_t(input * 2 + unit)] /
                      float(first > 0 ? grid.directions * grid.steps : grid.directions));
  add(out, layer.gate_weights);
}

}  // namespace

Vector<float> network_constants(const nnao::Network& network, nnao::TapGrid grid, Memory* memory) {
  Floats out(memory);
  if (network.form == nnao::NetworkForm::horizon) {
    constexpr int units = NOOK_HORIZON_UNITS;
    nnao::HorizonNetwork horizon = network.horizon;
    for (int i = 0; i < units * units; ++i) {
      horizon.direction.weights[units * units + i] /= float(grid.steps);
      horizon.join.weights[i] /= float(grid.directions);
    }
    add(out, horizon.tap);
    add(out, horizon.direction);
    add(out, horizon.join);
    add(out, horizon.out);
    add_bent(out, horizon.bent, grid);
  } else {
    const nnao::PaperNetwork& paper = network.paper;
    add(out, paper.bias);
    add(out, paper.negative_slope);
    add(out, paper.positive_slope);
    add(out, paper.layer_1);
    add(out, paper.layer_2);
    add(out, paper.layer_3);
  }
  assert(out.size() ==
         4 * (network.form == nnao::NetworkForm::horizon ? NOOK_HORIZON_VEC4S : NOOK_PAPER_VEC4S));
  return out;
}

}  // namespace nook::gl
