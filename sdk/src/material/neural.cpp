#include "sdk/src/material/neural.h"

#include <utility>

namespace nook::material {

NeuralLayout::NeuralLayout(const NeuralShape& s) {
  std::size_t end = 0;
  const auto take = [&end](std::size_t numbers) { return std::exchange(end, end + numbers); };
  offset_in = take(std::size_t(s.offset_channels + neural_view_inputs) * s.offset_units);
  offset_bias = take(s.offset_units);
  offset_out = take(s.offset_units);
  offset_level = take(1);
  position = take(std::size_t(s.channels + neural_view_inputs) * s.units);
  position_bias = take(s.units);
  light = take(std::size_t(neural_light_inputs) * s.units);
  hidden = take(std::size_t(s.layers - 1) * s.units * (s.units + 1));
  out = take(std::size_t(3) * s.units);
  out_bias = take(3);
  count = end;
}

}  // namespace nook::material
