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
  std::uint32_t paths = 256;  // light samples per pixel of the reference
  TruthSettings truth;
  std::uint64_t seed = 1;
};

struct PictureSource {
  const bake::SurfaceMesh& mesh;
  const nook::material::MaterialTables& tables;
  const VectorMeasure& vectors;
  std::size_t light = 0;  // index of the light of the vectors
  const bake::Environment& map;
  // The material that the reference is traced with. If null, the reference uses the decoded material.
  const RawReflectance* raw = nullptr;
};

struct PictureError {
  // Mean squared error of the linear radiance over the shape's pixels and over RGB, minus the noise of the
  // reference. It is divided by the squared mean luminance of the reference over these pixels.
  std::array<double, 3> mse{};
  double noise_floor_mse = 0;  // noise of the reference, in the same unit
  bake::Picture sheet;         // the picture of the reference, then one picture for each form
};

// The camera looks at the centre of the bounding box from 35 degrees above the horizon. Each pixel has one
// camera ray through its centre. The reference is the light that the map sends to the pixel's surface, where
// paths may have up to `bounces` reflections on the way. The material is decoded at the pixel. Half of the
// samples are distributed by luminance and half by the cosine. They are combined by multiple importance
// sampling. If the settings contain the holes of the VOTF, rays to the light pass through them, but camera
// rays do not. Throws Failure(CANCELLED) if progress returns false.
PictureError measure_pictures(const PictureSource& source, const PictureSettings& settings,
                              const VectorProgress& progress);

}  // namespace nook::measure
