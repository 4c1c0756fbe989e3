// Makes an uncompressed raw material usable as a surface in path tracing. It interpolates between lights,
// views and texels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/reflectance.h"

namespace nook::measure {

// Interpolates in the same way as the decoder: between views with a thin-plate spline, and linearly between
// lights, texels and mipmap levels. Each level has half the width and height of the level before.
class RawReflectance {
 public:
  // Takes ownership of the BTF. During the call, it also needs 4/3 times the memory of the BTF.
  explicit RawReflectance(bake::material::RawMaterial raw);

  std::size_t number_count() const { return numbers_; }
  // Writes the radiance at the sample's point and for the sample's view, under each light of the raw material
  // (lights x RGB). The light of the sample is ignored.
  void decode(const nook::material::Sample& sample, std::span<float> numbers) const;
  // Returns the radiance under a light that causes an irradiance of 1 on a plane that faces it. Returns black
  // if the light is below the horizon.
  Vec3 radiance(std::span<const float> numbers, Vec3 light) const;

 private:
  struct Level {
    std::uint32_t width = 0, height = 0;
    std::vector<float> texels;  // texel x view x numbers
  };
  void add(const Level& level, const nook::material::Sample& sample, float share,
           std::span<float> numbers) const;

  std::vector<Vec3> lights_;
  std::size_t views_ = 0, numbers_ = 0;
  std::vector<Level> levels_;
  bake::tensor::Matrix view_weights_;  // one row per cell of a parabolic map
  nook::material::DirectionMesh light_mesh_;
};

// Reads a file of `bake material --keep-raw`. Throws Failure(NOOK_ERROR_BAD_FILE).
RawReflectance read_raw_reflectance(std::span<const std::byte> bytes);

}  // namespace nook::measure
