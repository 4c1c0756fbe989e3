// Compares glossy reflections of the lobes that were fitted to a map with reflections of the map itself,
// without its suns. Finds directions in which a metal ball would look black.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/environment.h"
#include "sdk/src/core/spherical_gaussian.h"

namespace nook::measure {

// The roughnesses that are measured.
inline constexpr float gloss_roughness[] = {0.2f, 0.4f, 0.6f, 0.8f};
// A direction is dark if the reflection of the lobes is below gloss_dark times the true reflection. Only
// directions whose true reflection is above gloss_lit times the mean light are counted.
inline constexpr double gloss_dark = 0.25, gloss_lit = 0.1;

struct GlossError {
  double dark = 0;      // fraction of the counted directions that are dark
  double negative = 0;  // fraction of all directions in which a channel is below 0, before any clamp
  double lowest = 0;    // lowest value of any channel, divided by the mean light
  double rms = 0;       // error of the luminance, divided by the mean light
  double mean = 0;      // mean of the lobes' reflections, divided by the mean of the true reflections
};

// The true reflections: a metal with a reflectance of 1 reflects the map without its suns. The viewer looks
// along the surface normal.
class GlossTruth {
 public:
  // Uses evenly spread directions. First removes the suns from the map, then reduces the map to 256 columns.
  explicit GlossTruth(const bake::Environment& map, std::uint32_t directions = 2048);

  // Returns the error at each roughness, followed by the error over all of them together.
  std::vector<GlossError> errors(std::span<const SphericalGaussian> lobes) const;

 private:
  std::vector<Vec3> direction_;
  std::vector<std::vector<Vec3>> truth_;  // for each roughness and direction
  double mean_ = 0;                       // luminance
};

}  // namespace nook::measure
