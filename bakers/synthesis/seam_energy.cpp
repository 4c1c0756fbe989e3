#include "bakers/synthesis/seam_energy.h"

#include <array>
#include <vector>

namespace nook::bake::synthesis {
namespace {

constexpr std::array<Texel, 2> steps{{{1, 0}, {0, 1}}};

double squared_difference(const Exemplar& exemplar, Texel a, Texel b) {
  const ExemplarShape& s = exemplar.shape;
  return double((exemplar.values.row(s.row(a)) - exemplar.values.row(s.row(b))).squaredNorm());
}

// Returns the mean squared difference of horizontal neighbours and of vertical neighbours in the exemplar.
// Leaves out pairs across the border.
std::array<double, 2> mean_differences(const Exemplar& exemplar) {
  std::array<double, 2> out{};
  const ExemplarShape& s = exemplar.shape;
  for (std::size_t i = 0; i < 2; ++i) {
    double sum = 0, pairs = 0;
    for (std::int32_t y = 0; y + steps[i].y < s.height; ++y)
      for (std::int32_t x = 0; x + steps[i].x < s.width; ++x, ++pairs)
        sum += squared_difference(exemplar, {x, y}, Texel{x, y} + steps[i]);
    out[i] = sum / pairs;
  }
  return out;
}

// plane(x, y) must be defined for x from 0 to width and y from 0 to height, both included.
template <class PlaneAt>
Seams measure(const Exemplar& exemplar, std::int32_t width, std::int32_t height, const PlaneAt& plane) {
  const std::array<double, 2> usual = mean_differences(exemplar);
  const ExemplarShape& s = exemplar.shape;
  double jumps = 0, energy = 0;
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x)
      for (std::size_t i = 0; i < 2; ++i) {
        const Texel own = plane(Texel{x, y}), next = plane(Texel{x, y} + steps[i]), expected = own + steps[i];
        if ((s.is_tiling || s.holds(expected)) && s.inside(expected) == next) continue;
        ++jumps;
        energy += squared_difference(exemplar, own, next) - usual[i];
      }
  const double texels = double(width) * height;
  return {jumps / (2 * texels), energy / texels};
}

}  // namespace

Seams measure_seams(const Exemplar& exemplar, std::span<const Texel> plane, std::int32_t side) {
  return measure(exemplar, side, side, [&](Texel p) {
    return plane[std::size_t(wrapped(p.y, side)) * std::size_t(side) + std::size_t(wrapped(p.x, side))];
  });
}

Seams measure_tiled(const Exemplar& exemplar) {
  const ExemplarShape& s = exemplar.shape;
  return measure(exemplar, s.width, s.height, [&](Texel p) {
    return Texel{wrapped(p.x, s.width), wrapped(p.y, s.height)};
  });
}

}  // namespace nook::bake::synthesis
