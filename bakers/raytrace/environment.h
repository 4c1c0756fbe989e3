// Light from infinity: a latitude-longitude map of radiance, sampled in proportion to luminance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/light_map.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// No texel of a map and no emissive surface may have a higher radiance. So sums of squares over any number of
// paths stay far below the maximum of a float.
inline constexpr double max_radiance = 1e15;

// Rows go from +y to -y, and columns go around the y axis. The middle column looks along +x. The column a
// quarter of the width further to the right looks along +z. Radiance is constant over a texel, so integrals
// over the map are sums over its texels.
class Environment {
 public:
  // `rgb` has 3 floats for each texel, from 0 to max_radiance. Rows start at the top. `width` and `height`
  // must be at least 1.
  Environment(std::uint32_t width, std::uint32_t height, std::vector<float> rgb);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::size_t texel_count() const { return std::size_t(width_) * height_; }
  std::span<const float> rgb() const { return rgb_; }

  Vec3 texel(std::size_t index) const { return {rgb_[3 * index], rgb_[3 * index + 1], rgb_[3 * index + 2]}; }
  std::size_t texel_at(Vec3 direction) const;  // `direction` may have any non-zero length
  Vec3 radiance(Vec3 direction) const { return texel(texel_at(direction)); }

  double solid_angle(std::uint32_t row) const;  // steradians per texel; the sum over the map is 4 pi
  // u and v are positions within the texel in [0, 1). u points to the right and v down. Both are uniform in
  // solid angle.
  Vec3 direction(std::uint32_t column, std::uint32_t row, float u, float v) const;

 private:
  std::uint32_t width_, height_;
  std::vector<float> rgb_;
};

// Luminance with the weights of Rec. 709.
constexpr float luminance(Vec3 rgb) {
  return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

struct LightSample {
  Vec3 direction;
  Vec3 radiance;
  float density = 0;  // probability density per steradian
};

// Samples directions by luminance, mixed with uniform directions. The density is (1 - uniform) * luminance /
// integral of luminance + uniform / (4 pi).
class LightSampler {
 public:
  // The environment must outlive the sampler. uniform_share is in [0, 1]. Directions are uniform if the map
  // is black, or so dark that its density does not fit into a float.
  explicit LightSampler(const Environment& environment, float uniform_share = 0);

  // Takes four numbers in [0, 1). `choice` is a double, so that every texel of a large map can be chosen.
  LightSample sample(double choice, float alias, float u, float v) const;
  float density(Vec3 direction) const { return texel_density(environment_->texel_at(direction)); }

 private:
  float texel_density(std::size_t texel) const;

  const Environment* environment_;
  float uniform_ = 0, per_luminance_ = 0;  // density = uniform_ + per_luminance_ * luminance
  std::vector<float> keep_;                // Walker's alias table, built with Vose's method
  std::vector<std::uint32_t> other_;
};

// Finds the suns of an environment with the same rule as the runtime (sdk/src/core/light_map.h).

using Sun = MapSun;

// Returns the luminance above which a texel belongs to a sun.
double sun_limit(const Environment& environment);
// Returns the map without at most max_count of its brightest suns.
Environment without_suns(const Environment& environment, std::size_t max_count = ~std::size_t(0));
// Returns the suns with the highest luminance.
std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count);

}  // namespace nook::bake
