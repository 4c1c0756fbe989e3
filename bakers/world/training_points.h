// Ray-traced points for fitting casters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/world/fit_casters.h"

namespace nook::bake {

// Traces which share of a cone of directions is open.

struct RayCone {
  Vec3 axis;  // unit
  float half_angle_radians = 0;
};

// The rays are spread evenly over the cone's solid angle on a spiral. `turn`, in [0, 1), turns the spiral
// about the axis.
float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn);

// `cone` points lie on the floor, distributed by area. `outline` points lie in the body's shadow and at the
// shadow's edge, for all directions of the light.
enum class PointKind : std::uint8_t { floor, wall, contact, neighbour, cone, outline };
inline constexpr std::size_t point_kinds = 6;

struct TrainingPoint {
  Vec3 position;
  Vec3 normal;  // for a cone of light, its axis towards the light
  std::uint32_t pose = 0;
  PointKind kind = PointKind::floor;
  float ao = 1;      // traced AO; for a cone, its open share
  float weight = 0;  // weight of the squared error; the sum of weight * (1 - ao)^2 over a kind of points is
                     // the share of that kind
  float slope = 0;   // tangent of the half angle of a cone of light; 0: the point is for AO

  bool of_light() const { return slope > 0; }
};

struct TrainingPoints {
  std::vector<Pose> poses;
  std::vector<TrainingPoint> point;  // sorted by pose
};

// Leaves out points with an AO below 0.01, because the body hides them.
TrainingPoints trace_training_points(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                     const WorldCasterSettings& settings, const CasterProgress& progress);

}  // namespace nook::bake
