// Draws a shape with a material under a map, once path traced and once from the vectors of each form.
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
  // The material of the truth. If null, the truth uses the decoded material.
  const RawReflectance* raw = nullptr;
};

struct PictureError {
  // Mean squared error of linear radiance over the shape's pixels and RGB, minus the noise of the truth.
  // Divided by the squared mean luminance of the truth over these pixels.
  std::array<double, 3> mse{};
  double noise_floor_mse = 0;  // noise of the truth, same unit
  bake::Picture sheet;         // truth, then the forms
};

// The camera looks at the centre of the bounding box from 35 degrees above the horizon. Each pixel has one
// ray through its centre. The truth is the light of the map on the material as decoded at the pixel, with
// `bounces` reflections on surfaces along the way. Half of the samples are distributed by luminance and half
// by the cosine, combined by multiple importance sampling. Rays to the light pass through the holes of the
// VOTF if the settings have them, but camera rays do not. Throws Failure(CANCELLED) if progress returns
// false.
PictureError measure_pictures(const PictureSource& source, const PictureSettings& settings,
                              const VectorProgress& progress);

}  // namespace nook::measure
