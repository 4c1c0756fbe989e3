// One probe of one map.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/probe/map_samples.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/fit.h"

namespace nook::bake::probe {

enum class Sampling : std::uint8_t {
  automatic =
      0,  // texels for the forms that solve, luminance for running averages, which a late sun would shake
  texels = 1,     // every texel once, in random order
  luminance = 2,  // half of the directions by luminance
  uniform = 3
};

struct MapBakeSettings {
  nook::probe::Basis basis;
  nook::probe::FitSettings fit;
  Sampling sampling = Sampling::automatic;
  std::uint32_t samples = 1u << 20;  // of luminance and uniform
  std::uint64_t seed = 1;
};

// Which samples a bake takes.
Samples bake_samples(const Environment& map, const MapBakeSettings& settings);

// The coefficients, one for each function. progress counts samples; throws Failure(NOOK_ERROR_CANCELLED) when
// it returns false.
std::vector<Vec3> bake_map(const MapBakeSettings& settings, const Samples& samples,
                           const std::function<bool(std::size_t done, std::size_t total)>& progress = {});
inline std::vector<Vec3> bake_map(
    const Environment& map, const MapBakeSettings& settings,
    const std::function<bool(std::size_t done, std::size_t total)>& progress = {}) {
  return bake_map(settings, bake_samples(map, settings), progress);
}

}  // namespace nook::bake::probe
