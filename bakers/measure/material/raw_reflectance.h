// Serves a raw material as a surface for path tracing, without compression. It interpolates between lights,
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

// Interpolates like decoding: between views by the thin-plate spline, and linearly between lights, texels and
// levels. Each level halves the one before.
class RawReflectance {
 public:
  // Takes ownership of the BTF. During the call, it needs another 4/3 of the BTF's memory.
  explicit RawReflectance(bake::material::RawMaterial raw);

  std::size_t number_count() const { return numbers_; }
  // Writes the radiance at the sample's point, for the sample's view, under each sampled light (lights x
  // RGB). Ignores the sample's light.
  void decode(const nook::material::Sample& sample, std::span<float> numbers) const;
  // Returns the radiance for an irradiance of 1 on a plane that faces the light; black if the light is below
  // the horizon.
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
  bake::tensor::Matrix view_weights_;  // per cell of a parabolic map
  nook::material::DirectionMesh light_mesh_;
};

// Reads a file of `bake material --keep-raw`. Throws Failure(NOOK_ERROR_BAD_FILE).
RawReflectance read_raw_reflectance(std::span<const std::byte> bytes);

}  // namespace nook::measure
