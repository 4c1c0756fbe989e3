// Fits the world casters of a character: capsules that darken the surroundings like ray tracing does, in many
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
  std::size_t poses = 96;    // at most this many poses, evenly picked
  // Points in each pose.
  std::size_t floor_points = 256, wall_points = 64, contact_points = 128, neighbour_points = 48,
              cone_points = 96, outline_points = 400;
  std::uint32_t rays = 256;  // per point, for AO; a cone takes an eighth of this
  std::size_t steps = 16;    // maximum number of Gauss-Newton steps; 0: the initial capsules
  // The weight of the prior that pulls capsules towards their initial values: the relative error that a
  // change by one standard deviation costs. The standard deviation is deviation_m for every coordinate, and
  // deviation_radius for the logarithm of every radius and of ao_scale.
  double pull = 0.003;
  double deviation_m = 0.03, deviation_radius = 0.3;
  std::uint64_t seed = 1;
};

struct WorldCasterReport {
  double seconds = 0;
  // Error before and after the fit: the mean squared error divided by the mean squared error without any
  // casters, summed over the six kinds of points.
  double error_initial = 0, error_fitted = 0;
};

// Return false to stop.
using CasterProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Fits casters with the Levenberg-Marquardt method, starting from initial_casters. Minimises a weighted sum
// of six terms, one per kind of point (training_points.h): floor, wall, contact ring, neighbour, shadows of
// cones of light on the floor, and outlines of these shadows. Each term is the mean squared error divided by
// the mean squared error without any casters. The same seed gives the same casters on any number of threads.
// Throws Failure (CANCELLED).
std::vector<WorldCaster> fit_world_casters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                           const WorldCasterSettings& settings,
                                           WorldCasterReport* report = nullptr,
                                           const CasterProgress& progress = {});

}  // namespace nook::bake
