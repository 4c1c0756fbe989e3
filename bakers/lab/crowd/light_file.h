// Reads lights from files. A light has lobes, and the environment that the lobes represent.
#pragma once

#include <nook/experimental/nook_trace.h>

#include <filesystem>
#include <nook/nook.hpp>
#include <string>
#include <vector>

#include "samples/crowd/light.h"

namespace crowd::lab {

struct MapLight {
  std::string name;
  Light light;
  std::vector<float> rgb;  // pixels of the environment
  std::uint32_t width = 0, height = 0;
  // Mean radiance over the sphere and the channels. A constant light with this radiance has the same power.
  float mean_radiance = 0;

  nook_bake_environment environment() const { return {rgb.data(), width, height}; }
};

// Reads a probe file or a latitude-longitude map. For a map, it fits 12 lobes. For a probe, the environment
// is computed from the lobes. Throws std::runtime_error and nook::Error. Lobes that are fitted to a map
// overlap, and some are negative. No single lobe therefore represents the sun.
MapLight read_light(const nook::Context& context, const std::filesystem::path& path);

// Returns a light whose environment is its own lobes.
MapLight light_of_lobes(std::string name, Light light);

}  // namespace crowd::lab
