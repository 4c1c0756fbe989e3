// Networks full of seeded numbers, for tests that need any network.
#pragma once

#include <random>
#include <span>

#include "sdk/src/nnao/network.h"

namespace nook::test {

template <class Layer>
void fill_layer(Layer& layer, std::mt19937& random) {
  // mt19937's numbers are the same everywhere; the numbers of a std distribution are not.
  const auto next = [&] { return float(random()) * 0x1p-31f - 1; };
  for (float& w : layer.weights) w = next();
  if constexpr (requires { layer.bias; })
    for (float& b : layer.bias) b = next();
  if constexpr (requires { layer.threshold; })
    for (float& t : layer.threshold) t = 0.05f + 0.05f * next();
  if constexpr (requires { layer.gate_weights; }) {
    for (float& g : layer.gate_weights) g = 0.5f * next();
    for (float& s : layer.slope) s = 0.25f * next();
  }
  if constexpr (requires { layer.positive_slope; }) {
    for (float& s : layer.negative_slope) s = 0.25f * next();
    for (float& s : layer.positive_slope) s = 1 + 0.25f * next();
  }
}

inline nnao::Network sample_network(nnao::NetworkForm form, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  nnao::Network network;
  network.form = form;
  if (form == nnao::NetworkForm::paper) {
    nnao::PaperNetwork& paper = network.paper;
    paper.filters.resize(31 * 31 * 4 * 4);
    // Steps of 1/1024 below 1/2: half floats hold them exactly.
    for (float& f : paper.filters) f = float(int(random() % 1023) - 511) / 1024;
    nnao::Dense<4, 4> first;
    fill_layer(first, random);
    paper.bias = first.bias;
    paper.negative_slope = first.negative_slope;
    paper.positive_slope = first.positive_slope;
    fill_layer(paper.layer_1, random);
    fill_layer(paper.layer_2, random);
    fill_layer(paper.layer_3, random);
  } else {
    fill_layer(network.horizon.tap, random);
    fill_layer(network.horizon.direction, random);
    fill_layer(network.horizon.join, random);
    for (float& w : network.horizon.out) w = float(random()) * 0x1p-31f - 1;
  }
  network.recipe = "{\"seed\": 1}";
  return network;
}

}  // namespace nook::test
