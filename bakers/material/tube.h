// Tubes swept along curves: fibres and yarns.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/material/meso_surface.h"

namespace nook::bake::material {

// A curve that closes on the torus: point(1) - point(0) is a whole number of tiles along x and y, and it is
// nowhere vertical.
struct Tube {
  std::function<Vec3(float t)> centre;                // t in [0, 1]
  std::function<float(float t, float angle)> radius;  // relative to the half axes; angle 0 points sideways
  float half_width = 0.01f, half_height = 0.01f;      // half axes of the section, tiles
  std::function<Vec3(float t, float angle)> albedo;
  std::uint32_t segments = 64, sides = 12;
};

// Appends the tube; its first and last rings coincide on the torus.
void sweep(const Tube& tube, MesoSurface& surface);

}  // namespace nook::bake::material
