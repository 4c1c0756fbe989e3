#include "bakers/transfer/lobes_of_directions.h"

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/transfer/distant_light.h"

namespace nook::bake::transfer {
namespace {

// Lobes count down to exp(-reach) of their height, 1e-4: a share has 8 bits.
constexpr float reach = 9;

}  // namespace

LobesOfDirections lobes_of(const nook::transfer::CubeCells& cells, std::uint32_t lobes) {
  const float sharpness = nook::transfer::sharpness_of(lobes), cap = 1 - reach / sharpness;
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  LobesOfDirections out;
  out.integral = gaussian_integral(sharpness);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out.begin.push_back(std::uint32_t(out.lobe.size()));
    for (std::uint32_t j = 0; j < lobes; ++j) {
      if (dot(axes[j], cells.direction[i]) < cap) continue;
      out.lobe.push_back(j);
      out.weight.push_back(gaussian_value(axes[j], sharpness, cells.direction[i]) * cells.solid_angle[i]);
    }
  }
  out.begin.push_back(std::uint32_t(out.lobe.size()));
  return out;
}

}  // namespace nook::bake::transfer
