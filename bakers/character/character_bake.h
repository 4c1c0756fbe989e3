// Bakes a character model: poses -> ray-traced targets -> initialisation -> fit -> CharacterModel.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

enum class FitMethod : std::uint8_t {
  nook,   // mini-batches over both layers at once, with linear solves in between
  paper,  // block coordinate descent with L-BFGS, as in the paper
};

struct BakeSettings {
  std::size_t spheres = 130;
  std::size_t key_points = 500;
  std::size_t entries = 7;    // key points per vertex, at most 8
  std::uint32_t rays = 16;    // per vertex and pose
  std::size_t steps = 20000;  // mini-batches (nook), or rounds of block descent (paper)
  // Limit for the fit, in seconds; 0: no limit. If the limit ends a fit, the result is not reproducible bit
  // for bit.
  double time_limit_s = 0;
  std::uint64_t seed = 1;
  Kernel kernel;
  // Initial saturation of each key point, up to max_saturation (model.h). The fit changes it. If it is 0, no
  // shadow saturates. FitMethod::paper does not use saturation. A fit whose gamma is learned or differs from
  // 1 does not use saturation either, because gamma has the same purpose.
  float saturation = 0.5f;
  bool learn_gamma = false;  // takes the kernel.gamma with the lowest held-out error in short fits
  FitMethod fit = FitMethod::nook;

  float used_saturation() const {
    return fit == FitMethod::nook && kernel.gamma == 1 && !learn_gamma ? saturation : 0;
  }
};

enum class BakeStage : std::uint8_t { raytrace, initialise, fit, casters };

// `done` and `total` count poses or steps of the stage. Return false to cancel. Worker threads call the
// function, but never two at the same time.
using BakeProgress = std::function<bool(BakeStage stage, std::size_t done, std::size_t total)>;

struct CurvePoint {
  double seconds = 0;                      // since the fit began
  double mse_train = 0, mse_held_out = 0;  // on all poses, including the noise from their few rays
};

struct BakeReport {
  double seconds_raytrace = 0, seconds_fit = 0;
  std::size_t iterations = 0, train_poses = 0;
  // The errors are over all vertices, with clamped predictions. mse_initial is measured before the fit,
  // mse_train after it, both on some of the fitted poses, traced again with many rays.
  double mse_initial = 0, mse_train = 0;
  double noise_floor_mse = 0;  // what the noise of these rays adds to both errors
  // The error on the held-out poses, including the noise from their few rays. It decides when the fit stops.
  double mse_held_out = 0;
  double mse_held_out_file = 0;  // the same error after the model is quantised for its file
  double noise_floor_held_out_mse = 0;
  std::vector<CurvePoint> curve;
};

struct BakeResult {
  CharacterModel model;
  BakeReport report;
};

// Bakes on the given poses. The same settings and seed give the same model on any number of threads, unless
// the time limit ends the fit. The caller must set model.recipe. Throws Failure: INVALID_ARGUMENT (settings
// out of range, no poses, wrong bone count), CANCELLED.
BakeResult bake_character(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& settings,
                          const BakeProgress& progress = {});

}  // namespace nook::bake
