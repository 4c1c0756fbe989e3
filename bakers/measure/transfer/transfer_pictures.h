// Draws a shape in a material under a map: path traced, and from the vectors of each form.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/images/picture.h"
#include "bakers/measure/material/raw_reflectance.h"
#include "bakers/measure/transfer/vector_error.h"

namespace nook::measure {

struct PictureSettings {
  int width = 480, height = 360;
  std::uint32_t paths = 256;  // light samples per pixel of the truth
  TruthSettings truth;
  std::uint64_t seed = 1;
};

struct PictureSource {
  const bake::SurfaceMesh& mesh;
  const nook::material::MaterialTables& tables;
  const VectorMeasure& vectors;
  std::size_t light = 0;  // index of the light of the vectors
  const bake::Environment& map;
  // The surface of the truth; null: the decoded material.
  const RawReflectance* raw = nullptr;
};

struct PictureError {
  // Means of the squared error of linear radiance over the shape's pixels and RGB, less the noise of the
  // truth. They are divided by the squared mean luminance of the truth over these pixels.
  std::array<double, 3> mse{};
  double noise_floor_mse = 0;  // noise of the truth, same unit
  bake::Picture sheet;         // truth, then the forms
};

// The camera looks at the middle of the bounding box from 35 degrees above its horizon. A pixel has one ray
// through its middle. The truth is the light of the map on the material as decoded at the pixel, with
// `bounces` reflections on surfaces along the way. Half of the samples are by luminance and half
// cosine-weighted, with multiple importance sampling. Rays to the light pass through the holes of the VOTF if
// the settings have them, but camera rays do not. Throws Failure(CANCELLED) if progress returns false.
PictureError measure_pictures(const PictureSource& source, const PictureSettings& settings,
                              const VectorProgress& progress);

}  // namespace nook::measure
