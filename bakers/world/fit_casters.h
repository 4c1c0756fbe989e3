// World casters of a character: capsules that are fitted against ray tracing to what a body darkens in many
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
  std::size_t poses = 96;    // at most this many of those given, evenly chosen
  // The numbers in each pose.
  std::size_t floor_points = 256, wall_points = 64, contact_points = 128, neighbour_points = 48,
              cone_points = 96;
  std::uint32_t rays = 256;  // a point; a cone takes an eighth
  std::size_t steps = 16;    // of Gauss-Newton, at most; 0: the initial capsules
  // The pull towards the initial capsules, in relative error of the fit for a change by a standard deviation:
  // deviation_m of every coordinate, deviation_radius of the logarithm of every radius and scale.
  double pull = 0.003;
  double deviation_m = 0.03, deviation_radius = 0.3;
  std::uint64_t seed = 1;
};

struct WorldCasterReport {
  double seconds = 0;
  // Mean squared error over that of no darkening, a sum over the five kinds of points, before and after.
  double error_initial = 0, error_fitted = 0;
};

// Returns false to stop.
using CasterProgress = std::function<bool(std::size_t done, std::size_t total)>;

// The casters minimise a weighted sum over floor, wall, contact ring and neighbour of the mean squared error
// of AO over that of no darkening, and the same of the shadows of small cones of light on the floor, by
// Levenberg's and Marquardt's method from initial_casters. The same seed gives the same casters on any number
// of threads. Throws Failure (CANCELLED).
std::vector<WorldCaster> fit_world_casters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                           const WorldCasterSettings& settings,
                                           WorldCasterReport* report = nullptr,
                                           const CasterProgress& progress = {});

}  // namespace nook::bake
