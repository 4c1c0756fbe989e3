// Compares glossy reflections of a map's lobes with reflections of the map without its suns. Shows where a
// metal ball would look black.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/environment.h"
#include "sdk/src/core/spherical_gaussian.h"

namespace nook::measure {

// The roughnesses that are measured.
inline constexpr float gloss_roughness[] = {0.2f, 0.4f, 0.6f, 0.8f};
// A direction is dark if the lobes reflect less than the share gloss_dark of the truth. A direction counts
// only if the truth is above gloss_lit times the mean light.
inline constexpr double gloss_dark = 0.25, gloss_lit = 0.1;

struct GlossError {
  double dark = 0;      // share of the directions that count
  double negative = 0;  // share of all directions in which a channel is below 0, before any clamp
  double lowest = 0;    // lowest value of any channel, divided by the mean light
  double rms = 0;       // error of the luminance, divided by the mean light
  double mean = 0;      // mean of the lobes' reflections, divided by the mean of the true reflections
};

// The reflection of a map without suns in metal with a reflectance of 1. The view direction is the surface
// normal.
class GlossTruth {
 public:
  // Takes evenly spread directions. The map is reduced to 256 columns after its suns are taken out.
  explicit GlossTruth(const bake::Environment& map, std::uint32_t directions = 2048);

  // Returns the error at each roughness, and of all together.
  std::vector<GlossError> errors(std::span<const SphericalGaussian> lobes) const;

 private:
  std::vector<Vec3> direction_;
  std::vector<std::vector<Vec3>> truth_;  // for each roughness and direction
  double mean_ = 0;                       // luminance
};

}  // namespace nook::measure
