// The transfer function and the primaries of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// Converts an sRGB value from 0 to 1 to a linear value.
inline float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

// Converts from CIE 1931 XYZ under D65. White has Y = 1. Colours outside the sRGB gamut get negative values.
inline Vec3 linear_rgb_from_xyz(Vec3 xyz) {
  return {3.2406f * xyz.x - 1.5372f * xyz.y - 0.4986f * xyz.z,
          -0.9689f * xyz.x + 1.8758f * xyz.y + 0.0415f * xyz.z,
          0.0557f * xyz.x - 0.2040f * xyz.y + 1.0570f * xyz.z};
}

}  // namespace nook::bake
