// Ray-traced points for fitting casters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/world/fit_casters.h"

namespace nook::bake {

// Traces the open share of a cone of directions.

struct RayCone {
  Vec3 axis;  // unit
  float half_angle_radians = 0;
};

// The rays are spread evenly over the cone's solid angle on a spiral. `turn` in [0, 1) turns it about the
// axis.
float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn);

enum class PointKind : std::uint8_t { floor, wall, contact, neighbour, cone };
inline constexpr std::size_t point_kinds = 5;
// The half angle of the cone of light at a point of this kind.
inline constexpr float training_cone_radians = 0.07f;  // 4 degrees, the half angle

struct TrainingPoint {
  Vec3 position;
  Vec3 normal;  // for a cone, its axis towards the light
  std::uint32_t pose = 0;
  PointKind kind = PointKind::floor;
  float ao = 1;      // traced; for a cone, its open share
  float weight = 0;  // weight of the squared error: the sum of weight * (1 - ao)^2 over a kind is its share
};

struct TrainingPoints {
  std::vector<Pose> poses;
  std::vector<TrainingPoint> point;  // by pose
};

// Leaves out points that the body hides, whose AO is below 0.01.
TrainingPoints trace_training_points(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                     const WorldCasterSettings& settings, const CasterProgress& progress);

}  // namespace nook::bake
