#include "bakers/character/offset_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/character/export_model.h"
#include "bakers/character/fit_state.h"
#include "bakers/raytrace/stand_ins.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr double old_constant_poses = 4;
// The prior that keeps the scale near its old value has the weight scale_ridge * (number of poses +
// old_scale_poses). `scale_ridge` has the unit of a squared shadow.
constexpr double scale_ridge = 2e-3, old_scale_poses = 20;
constexpr double least_scale = 0.05, most_scale = 4;
// Targets within this margin of black or white count as black or white. The margin is one of 64 rays.
constexpr double clamped_margin = 1.0 / 64;

// One vertex in one pose.
struct Sample {
  double shadow;  // sum of alpha times shadow
  double truth;
};

// AO = 1 - (scale * shadow + bias).
struct Line {
  double scale = 1, bias = 0;
};

// Returns true if clamping hides the error of a prediction.
bool is_hidden(const Sample& sample, const Line& line) {
  const double ao = 1 - line.scale * sample.shadow - line.bias;
  return (ao <= 0 && sample.truth <= clamped_margin) || (ao >= 1 && sample.truth >= 1 - clamped_margin);
}

// Fits the darkness as a linear function of the shadow, by least squares. Ignores samples in which clamping
// hides the error of the line `now`.
Line line_of(std::span<const Sample> samples, double old_bias, double mean, const Line& now) {
  const double old_level = old_bias + mean;  // the darkness of the old line at the mean
  double count = old_constant_poses, x1 = 0, y1 = old_constant_poses * old_level, xx = 0, xy = 0;
  for (const Sample& sample : samples) {
    if (is_hidden(sample, now)) continue;
    const double x = sample.shadow - mean, y = 1 - sample.truth;
    count += 1;
    x1 += x;
    y1 += y;
    xx += x * x;
    xy += x * y;
  }
  const double ridge = scale_ridge * (double(samples.size()) + old_scale_poses);
  const double scale = (xy - x1 * y1 / count + ridge) / (xx - x1 * x1 / count + ridge);
  Line line;
  line.scale = std::clamp(scale, least_scale, most_scale);
  line.bias = (y1 - line.scale * x1) / count - line.scale * mean;
  return line;
}

// Fits a line by Newton's method. The squared error is convex, and it is quadratic as long as the same
// samples are clamped. So a few rounds are enough.
Line fitted_line(std::span<const Sample> samples, double old_bias) {
  constexpr int rounds = 12;
  double mean = 0;
  for (const Sample& sample : samples) mean += sample.shadow / double(samples.size());
  Line line{1, old_bias};
  for (int round = 0; round < rounds; ++round) {
    const Line next = line_of(samples, old_bias, mean, line);
    if (next.scale == line.scale && next.bias == line.bias) break;
    line = next;
  }
  return line;
}

}  // namespace

double fit_offsets(CharacterModel& model, std::span<const Pose> poses, const AoTargets& targets) {
  const FitState state = state_of_model(model);
  const std::vector<float> shadows = shadows_of(state, poses);
  const std::size_t padded = state.structure.padded_count(), entries = model.influences;
  std::vector<double> moved(model.vertex_count());
  tbb::parallel_for(std::size_t(0), moved.size(), [&](std::size_t v) {
    std::vector<Sample> samples(poses.size());
    for (std::size_t p = 0; p < poses.size(); ++p) {
      samples[p] = {0, double(targets.row(p)[v]) * double(AoTargets::scale)};
      for (std::size_t s = v * entries; s < (v + 1) * entries; ++s)
        samples[p].shadow += double(model.alpha[s]) * double(shadows[p * padded + model.influence[s]]);
    }
    const double old_bias = double(model.bias[v]);
    const Line line = fitted_line(samples, old_bias);
    for (std::size_t e = v * entries; e < (v + 1) * entries; ++e) model.alpha[e] *= float(line.scale);
    model.bias[v] = float(line.bias);
    double change = 0;
    for (const Sample& sample : samples) change += (line.scale - 1) * sample.shadow + line.bias - old_bias;
    moved[v] = change / double(samples.size());
  });
  double squares = 0;
  for (const double move : moved) squares += move * move;
  return std::sqrt(squares / double(moved.size()));
}

double calibrate_offsets(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                         const OffsetFitSettings& settings, const Progress& progress) {
  if (poses.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there are no poses to calibrate to (need at least 1)");
  for (const Pose& pose : poses)
    if (pose.size() != mesh.bones.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "a pose to calibrate to has the wrong number of bones (got %zu, need %zu)", pose.size(),
                    mesh.bones.size());
  const StandIns stand_ins = choose_stand_ins(mesh, poses, settings.seed, progress);
  return fit_offsets(model, poses,
                     trace_character_ao(mesh, poses, settings.rays, settings.seed, progress, stand_ins));
}

}  // namespace nook::bake
