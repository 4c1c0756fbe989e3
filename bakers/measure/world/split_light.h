// Splits a map in the way in which a host draws it: the brightest sun becomes a cone of light, and the rest
// of the light becomes lobes. Also computes how much of the cone and of the lobes the casters block.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/environment.h"
#include "bakers/world/surroundings.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/world/light_terms.h"

namespace nook::measure {

struct NamedMap {
  std::string name;
  bake::Environment map;
};

struct SplitLight {
  std::string name;
  bake::Environment soft, sun_map;  // they add up to the map
  std::optional<bake::Sun> sun;
  std::vector<SphericalGaussian> lobes;  // 32
  world::LightTerms terms;
  double unit = 0;  // irradiance from uniform light with the map's mean radiance

  float sun_half_angle_radians() const;
  Vec3 sun_irradiance(Vec3 normal) const;   // without a body
  Vec3 soft_irradiance(Vec3 normal) const;  // without a body, from the lobes
};

SplitLight split(const NamedMap& named);

// `rgb` has three floats per point, the other arrays have one.
struct SampledLight {
  std::vector<float> ao, cone, rgb;
};

// Returns the shares of the light that the casters leave open, in the same way as nook_world_sample.
SampledLight sample_light(std::span<const PosedCaster> casters, const bake::SurfacePoints& points,
                          const SplitLight& light);

std::vector<PosedCaster> casters_in(const CharacterModel& model, const bake::Pose& pose);

}  // namespace nook::measure
