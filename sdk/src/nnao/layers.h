// Visits the parameters of a network's small layers in the order that files and the training use. The layers
// have the order of network.h, and the parameters of a layer have the order of its members.
#pragma once

#include <span>

#include "sdk/src/nnao/network.h"

namespace nook::nnao {

template <class Layer, class Visit>
void visit_layer(Layer& layer, Visit&& visit) {
  visit(std::span(layer.weights));
  if constexpr (requires { layer.bias; }) visit(std::span(layer.bias));
  if constexpr (requires { layer.threshold; }) visit(std::span(layer.threshold));
  if constexpr (requires { layer.gate_weights; }) visit(std::span(layer.gate_weights));
  if constexpr (requires { layer.slope; }) visit(std::span(layer.slope));
  if constexpr (requires { layer.positive_slope; }) {
    visit(std::span(layer.negative_slope));
    visit(std::span(layer.positive_slope));
  }
}

// Calls visit(span) for every parameter array of the network's form. The paper's filters are not visited.
template <class AnyNetwork, class Visit>
void visit_layers(AnyNetwork& network, Visit&& visit) {
  if (network.form == NetworkForm::paper) {
    auto& paper = network.paper;
    visit(std::span(paper.bias));
    visit(std::span(paper.negative_slope));
    visit(std::span(paper.positive_slope));
    visit_layer(paper.layer_1, visit);
    visit_layer(paper.layer_2, visit);
    visit_layer(paper.layer_3, visit);
  } else {
    auto& horizon = network.horizon;
    visit_layer(horizon.tap, visit);
    visit_layer(horizon.direction, visit);
    visit_layer(horizon.join, visit);
    visit(std::span(horizon.out));
    visit_layer(horizon.bent, visit);
  }
}

}  // namespace nook::nnao
