// The traced points that a fit of casters reads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/world/fit_casters.h"

namespace nook::bake {

// The open share of a cone of directions, by rays.

struct RayCone {
  Vec3 axis;  // unit
  float half_angle_radians = 0;
};

// The rays are spread evenly over the cone's solid angle on a spiral, which `turn` in [0, 1) turns about the
// axis.
float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn);

enum class PointKind : std::uint8_t { floor, wall, contact, neighbour, cone };
inline constexpr std::size_t point_kinds = 5;
// The cone of light of a point of that kind is one part as wide as this.
inline constexpr float training_cone_radians = 0.07f;  // 4 degrees, the half angle

struct TrainingPoint {
  Vec3 position;
  Vec3 normal;  // of a cone its axis, towards the light
  std::uint32_t pose = 0;
  PointKind kind = PointKind::floor;
  float ao = 1;      // traced; of a cone its open share
  float weight = 0;  // of the squared error: the sum of weight * (1 - ao)^2 over a kind is its share
};

struct TrainingPoints {
  std::vector<Pose> poses;
  std::vector<TrainingPoint> point;  // by pose
};

// Points that the body hides, whose AO is below 0.01, are left out.
TrainingPoints trace_training_points(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                     const WorldCasterSettings& settings, const CasterProgress& progress);

}  // namespace nook::bake
