// Fits the world casters of a character: capsules that match ray tracing of what a body darkens, in many
// poses.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct WorldCasterSettings {
  std::size_t casters = 40;  // 1 to 64
  std::size_t poses = 96;    // at most this many poses, evenly chosen
  // Points in each pose.
  std::size_t floor_points = 256, wall_points = 64, contact_points = 128, neighbour_points = 48,
              cone_points = 96, outline_points = 400;
  std::uint32_t rays = 256;  // per point; a cone takes an eighth
  std::size_t steps = 16;    // maximum number of Gauss-Newton steps; 0: the initial capsules
  // The pull towards the initial capsules is the relative error that a change by one standard deviation
  // costs. The deviation is deviation_m for every coordinate, and deviation_radius for the logarithm of every
  // radius and scale.
  double pull = 0.003;
  double deviation_m = 0.03, deviation_radius = 0.3;
  std::uint64_t seed = 1;
};

struct WorldCasterReport {
  double seconds = 0;
  // Mean squared error over the error without darkening, as a sum over the six kinds of points, before and
  // after.
  double error_initial = 0, error_fitted = 0;
};

// Return false to stop.
using CasterProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Fits casters by Levenberg's and Marquardt's method, starting from initial_casters. Minimises a weighted sum
// over floor, wall, contact ring, neighbour, shadows of cones of light on the floor, and the outlines of
// these shadows. Each term is the mean squared error over the error without darkening. The same seed gives
// the same casters on any number of threads. Throws Failure (CANCELLED).
std::vector<WorldCaster> fit_world_casters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                           const WorldCasterSettings& settings,
                                           WorldCasterReport* report = nullptr,
                                           const CasterProgress& progress = {});

}  // namespace nook::bake
