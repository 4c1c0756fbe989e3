// Baking a character model: poses -> ray-traced targets -> initialisation -> fit -> CharacterModel.
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
  nook,   // mini-batches over both layers at once, with linear solves between
  paper,  // block coordinate descent with L-BFGS, as the paper describes
};

struct BakeSettings {
  std::size_t spheres = 130;
  std::size_t key_points = 500;
  std::size_t entries = 7;    // key points per vertex, at most 8
  std::uint32_t rays = 16;    // a vertex and pose
  std::size_t steps = 20000;  // mini-batches (nook), or rounds of block descent (paper)
  double time_limit_s = 0;    // of the fit; 0: none. A fit that it ends is not reproducible bit for bit
  std::uint64_t seed = 1;
  Kernel kernel;
  // Of each key point before the fit, up to max_saturation (model.h); the fit changes it. 0: no shadow
  // is saturated, as with method paper, and with a gamma that is learned or not 1, which has the same
  // purpose.
  float saturation = 0.5f;
  bool learn_gamma = false;  // chooses kernel.gamma by held-out error of short fits
  FitMethod fit = FitMethod::nook;

  float used_saturation() const {
    return fit == FitMethod::nook && kernel.gamma == 1 && !learn_gamma ? saturation : 0;
  }
};

enum class BakeStage : std::uint8_t { raytrace, initialise, fit, casters };

// done and total count poses or steps of the stage. Returns false to cancel. Called from worker threads, one
// call at a time.
using BakeProgress = std::function<bool(BakeStage stage, std::size_t done, std::size_t total)>;

struct CurvePoint {
  double seconds = 0;                      // since the fit began
  double mse_train = 0, mse_held_out = 0;  // on all poses, with the noise of their few rays in it
};

struct BakeReport {
  double seconds_raytrace = 0, seconds_fit = 0;
  std::size_t iterations = 0, train_poses = 0;
  // Over all vertices, clamped predictions. On a spread of the fitted poses traced anew with many rays,
  // before and after the fit:
  double mse_initial = 0, mse_train = 0;
  double noise_floor_mse = 0;  // of those rays
  // On the held-out poses, with the noise of their few rays in it; what the fit is stopped by:
  double mse_held_out = 0;
  double mse_held_out_file = 0;  // of the model as its file holds it: what quantisation costs
  double noise_floor_held_out_mse = 0;
  std::vector<CurvePoint> curve;
};

struct BakeResult {
  CharacterModel model;
  BakeReport report;
};

// Bakes on the given poses. The same settings and seed give the same model on any number of threads, unless
// the time limit ends the fit. model.recipe is left for the caller. Throws Failure: INVALID_ARGUMENT
// (settings out of range, no poses, wrong bone count), CANCELLED.
BakeResult bake_character(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& settings,
                          const BakeProgress& progress = {});

}  // namespace nook::bake
