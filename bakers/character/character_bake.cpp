#include "bakers/character/character_bake.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bakers/character/blend_weights.h"
#include "bakers/character/block_descent.h"
#include "bakers/character/body_scale.h"
#include "bakers/character/caster_weights.h"
#include "bakers/character/export_model.h"
#include "bakers/character/fit_state.h"
#include "bakers/character/initialise.h"
#include "bakers/character/levels.h"
#include "bakers/character/linear_fit.h"
#include "bakers/character/mini_batch_fit.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/stand_ins.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

void check(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& s) {
  const auto refuse = [](const char* what, std::size_t got, const char* need) {
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of %s is out of range (got %zu, need %s)", what,
                  got, need);
  };
  if (poses.empty()) refuse("poses", 0, "at least 1");
  if (s.spheres < 1 || s.spheres > 1024) refuse("spheres", s.spheres, "1 to 1024");
  if (s.key_points < 1 || s.key_points > 4096) refuse("key points", s.key_points, "1 to 4096");
  if (s.entries < 1 || s.entries > 8) refuse("entries", s.entries, "1 to 8");
  if (s.rays < 1 || s.rays > 65536) refuse("rays", s.rays, "1 to 65536");
  if (s.steps > 10'000'000) refuse("steps", s.steps, "at most 10,000,000");
  if (!(s.kernel.gamma >= 1 && s.kernel.gamma <= 8))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "gamma is out of range (got %g, need 1 to 8)",
                  double(s.kernel.gamma));
  if (!(s.saturation >= 0 && s.saturation <= max_saturation))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "saturation is out of range (got %g, need 0 to %g)",
                  double(s.saturation), double(max_saturation));
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (poses[p].size() != mesh.bones.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "pose %zu has the wrong number of bones (got %zu, need %zu)",
                    p, poses[p].size(), mesh.bones.size());
    for (const Mat3x4& m : poses[p])
      if (!is_pose_matrix(m))
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "pose %zu has a matrix that is not finite, or that moves beyond 1e9 m or scales by more than 1e6",
            p);
  }
}

// Returns the progress callback of one stage.
Progress stage_progress(const BakeProgress& progress, BakeStage stage) {
  return [&progress, stage](std::size_t done, std::size_t total) {
    return !progress || progress(stage, done, total);
  };
}

// Holds out every 16th pose and moves it to the end.
std::size_t hold_out(std::vector<Pose>& poses) {
  constexpr std::size_t every = 16;
  std::vector<Pose> fitted, held;
  for (std::size_t i = 0; i < poses.size(); ++i)
    (i % every == every - 1 ? held : fitted).push_back(std::move(poses[i]));
  const std::size_t count = held.size();
  poses = std::move(fitted);
  for (Pose& p : held) poses.push_back(std::move(p));
  return count;
}

// With this many rays, the noise is far below the error of any fit.
constexpr std::uint32_t precise_rays = 512;

// Picks fitted poses at even intervals and traces them again with many rays. Picks 4 to 24 poses. Within this
// range, the traces take at most a quarter of the fit's rays.
TrainingSet precise_share(const SkinnedMesh& mesh, const TrainingSet& set, const StandIns& stand_ins,
                          const BakeSettings& settings, const Progress& progress) {
  const std::size_t affordable = set.fitted() * settings.rays / (4 * precise_rays);
  const std::size_t count = std::min(std::clamp<std::size_t>(affordable, 4, 24), set.fitted());
  TrainingSet share;
  for (std::size_t i = 0; i < count; ++i) share.poses.push_back(set.poses[i * set.fitted() / count]);
  share.targets = trace_character_ao(mesh, share.poses, precise_rays, settings.seed + 1, progress, stand_ins);
  return share;
}

// Half of the weight is equal for all vertices, as in the reported mse. The other half is proportional to the
// vertex's area, because large areas are more visible. The paper weights all vertices equally (slide 25).
std::vector<float> vertex_weights(std::span<const float> area, FitMethod fit) {
  if (fit == FitMethod::paper) return std::vector<float>(area.size(), 1.0f);
  double mean = 0;
  for (float a : area) mean += double(a);
  mean /= double(area.size());
  std::vector<float> weight;
  for (float a : area) weight.push_back(mean > 0 ? float(0.5 + 0.5 * double(a) / mean) : 1.0f);
  return weight;
}

// Settings for non-negative least squares over all candidates of a vertex. There are no anchors for other
// casters, and entries are kept even if they lower the error only a little.
LinearFitSettings plain_linear_fit(std::size_t entries) {
  LinearFitSettings plain;
  plain.entries = entries;
  plain.least_gain = 0;
  plain.anchors = 0;
  plain.anchor_floor = 0;
  return plain;
}

// One fit in progress: its state, the data that measures it, and the state with the lowest held-out error so
// far.
class Fit {
 public:
  Fit(const TrainingSet& set, const std::vector<float>& area, const BakeSettings& settings,
      const Candidates& candidates, FitState state, BakeReport& report)
      : set_(set), area_(area), candidates_(candidates), report_(report), state_(std::move(state)) {
    linear_.entries = settings.entries;
    if (settings.fit == FitMethod::paper) linear_ = plain_linear_fit(settings.entries);
  }

  FitState& state() { return state_; }
  const FitState& best() const { return best_; }
  double seconds() const { return watch_.seconds(); }

  void solve_linear() {
    const std::vector<float> shadows = shadows_of(state_, std::span(set_.poses).first(set_.fitted()));
    state_.linear = fit_linear_layer(shadows, state_.structure.padded_count(), set_, candidates_, linear_);
  }

  double held_out_mse(const FitState& state) const {
    const std::size_t first = set_.held_out ? set_.fitted() : 0;
    return measure_fit(state, set_, first, set_.poses.size(), area_).mse;
  }

  // Adds a point to the curve, and keeps the state if it is the best so far. Returns true if the held-out
  // error is below (1 - least_gain) times the best error before the call.
  bool measure(double least_gain = 0) {
    const std::size_t fitted = set_.fitted();
    const double train = measure_fit(state_, set_, 0, fitted, area_).mse;
    const double held = set_.held_out ? held_out_mse(state_) : train;
    report_.curve.push_back({watch_.seconds(), train, held});
    const bool gained = best_.parameters.empty() || held < best_held_ * (1 - least_gain);
    if (best_.parameters.empty() || held < best_held_) {
      best_ = state_;
      best_held_ = held;
      report_.mse_held_out = held;
    }
    return gained;
  }

 private:
  const TrainingSet& set_;
  const std::vector<float>& area_;
  const Candidates& candidates_;
  BakeReport& report_;
  FitState state_, best_;
  LinearFitSettings linear_;
  double best_held_ = 0;
  platform::Stopwatch watch_;
};

[[noreturn]] void cancelled() {
  throw Failure(NOOK_ERROR_CANCELLED, "cancelled while fitting");
}

// Runs mini-batches in rounds. Chooses the key points of each vertex again between rounds.
void fit_by_mini_batches(Fit& fit, const TrainingSet& set, const BakeSettings& settings, BakeReport& report,
                         const BakeProgress& progress) {
  constexpr std::size_t rounds = 3;
  std::size_t done = 0;
  for (std::size_t r = 0; r < rounds; ++r) {
    MiniBatchSettings batch;
    // The last round is the longest. It only refines the model: it does not choose key points.
    batch.steps = r + 1 < rounds ? settings.steps / 4 : settings.steps - done;
    batch.seed = settings.seed + r;
    batch.final_rate = r + 1 < rounds ? 0.3f : 0.01f;
    bool stop = false;
    fit_mini_batches(fit.state(), set, batch, [&](std::size_t step) {
      if (settings.time_limit_s > 0 && fit.seconds() > settings.time_limit_s) return false;
      stop = progress && step % 16 == 0 && !progress(BakeStage::fit, done + step, settings.steps);
      return !stop;
    });
    if (stop) cancelled();
    done += batch.steps;
    report.iterations = done;
    if (r + 1 < rounds) fit.solve_linear();
    fit.measure();
  }
}

void fit_by_blocks(Fit& fit, const TrainingSet& set, const BakeSettings& settings, BakeReport& report,
                   const BakeProgress& progress) {
  int without_gain = 0;
  for (std::size_t round = 0; round < settings.steps && without_gain < 3; ++round) {
    if (progress && !progress(BakeStage::fit, round, settings.steps)) cancelled();
    if (settings.time_limit_s > 0 && fit.seconds() > settings.time_limit_s) break;
    descend_non_linear(fit.state(), set, {});
    fit.solve_linear();
    report.iterations = round + 1;
    without_gain = fit.measure(1e-3) ? 0 : without_gain + 1;
  }
}

void fit_both_layers(Fit& fit, const TrainingSet& set, const BakeSettings& settings, BakeReport& report,
                     const BakeProgress& progress) {
  if (settings.fit == FitMethod::nook)
    fit_by_mini_batches(fit, set, settings, report, progress);
  else
    fit_by_blocks(fit, set, settings, report, progress);
}

// Returns the exponent whose short fit has the lowest error on held-out poses. A coarse grid of exponents is
// enough: both layers adapt to the exponent, so the error changes little near its minimum.
float learned_gamma(const TrainingSet& set, const std::vector<float>& area, const BakeSettings& settings,
                    const Candidates& candidates, const FitState& initial, const BakeProgress& progress) {
  BakeSettings brief = settings;
  brief.steps = std::max<std::size_t>(1, settings.steps / 20);
  float best = settings.kernel.gamma;
  double least = INFINITY;
  for (const float gamma : {1.0f, 1.25f, 1.5f, 1.75f, 2.0f, 2.5f}) {
    BakeReport report;
    FitState state = initial;
    state.structure.kernel.gamma = gamma;
    Fit fit(set, area, brief, candidates, std::move(state), report);
    fit.solve_linear();
    fit.measure();
    fit_both_layers(fit, set, brief, report, progress);
    if (report.mse_held_out < least) {
      least = report.mse_held_out;
      best = gamma;
    }
  }
  return best;
}

// The ray-traced data of a fit.
struct TracedPoses {
  TrainingSet set;
  TrainingSet precise;  // some of the fitted poses, traced with more rays
  AoTargets rest;       // targets of the rest pose
};

// Traces the targets. Writes their noise and the duration to the report.
TracedPoses trace_poses(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& settings,
                        const BakeProgress& progress, BakeReport& report) {
  const platform::Stopwatch watch;
  TracedPoses traced;
  TrainingSet& set = traced.set;
  set.poses.assign(poses.begin(), poses.end());
  set.held_out = hold_out(set.poses);
  // The paper's fit has no stand-ins: it traces AO at the vertices themselves.
  const Progress ray_progress = stage_progress(progress, BakeStage::raytrace);
  const StandIns stand_ins = settings.fit == FitMethod::paper
                                 ? StandIns()
                                 : choose_stand_ins(mesh, set.poses, settings.seed, ray_progress);
  set.targets = trace_character_ao(mesh, set.poses, settings.rays, settings.seed, ray_progress, stand_ins);
  report.noise_floor_held_out_mse =
      measure_noise_floor(mesh, set.poses, set.targets, settings.rays, settings.seed, stand_ins);
  traced.precise = precise_share(mesh, set, stand_ins, settings, [&](std::size_t, std::size_t) {
    return !progress || progress(BakeStage::raytrace, set.poses.size(), set.poses.size());
  });
  report.noise_floor_mse = measure_noise_floor(mesh, traced.precise.poses, traced.precise.targets,
                                               precise_rays, settings.seed + 1, stand_ins);
  const std::vector<Pose> rest{Pose(mesh.bones.size())};
  constexpr std::uint32_t rest_rays = 1024;
  traced.rest = trace_character_ao(mesh, rest, rest_rays, settings.seed, {}, stand_ins);
  report.seconds_raytrace = watch.seconds();
  report.train_poses = set.poses.size();
  return traced;
}

// The rest surface of a mesh, by vertex.
struct Surface {
  std::vector<float> area;
  std::vector<Vec3> normal;
};

Surface rest_surface(const SkinnedMesh& mesh) {
  Surface surface;
  surface.area = vertex_areas(mesh, mesh.position);
  vertex_normals(mesh.triangle, mesh.position, surface.normal);
  return surface;
}

// The initial state of a fit.
struct Start {
  FitState state;
  Candidates candidates;
};

// Makes clusters, key points and spheres. `weight` has one value per vertex and is used for spheres. Spheres
// also darken other objects, so they must cover the whole body. key_point_weight has one value per vertex and
// is used for key points.
Start initialise(const SkinnedMesh& mesh, const Surface& surface, std::span<const float> weight,
                 std::span<const float> key_point_weight, const BakeSettings& settings,
                 const std::function<void(std::size_t)>& step) {
  const std::vector<Vec3> feature_normal =
      settings.fit == FitMethod::paper ? centre_of_rotation_normals(mesh, surface.area, surface.normal)
                                       : surface.normal;
  step(1);
  ClusterSettings clustering;
  clustering.count = std::min(settings.key_points, mesh.vertex_count());
  const std::vector<std::uint32_t> cluster =
      cluster_vertices(mesh, key_point_weight, feature_normal, clustering);
  std::vector<KeyPoint> key_points = key_points_of_clusters(mesh, cluster, key_point_weight, feature_normal);
  for (KeyPoint& point : key_points) point.saturation = settings.used_saturation();
  const std::vector<InitialSphere> spheres = initial_spheres(mesh, weight, settings.spheres);
  Start start;
  // In the paper, a vertex uses the few key points that are nearest to it (slide 23). With more candidates,
  // the greedy choice finds better key points.
  const std::size_t nearest = settings.fit == FitMethod::paper ? settings.entries : 40;
  start.candidates.count = std::min(nearest, key_points.size());
  NearKeyPoints near = nearest_key_points(mesh, feature_normal, key_points, start.candidates.count);
  start.candidates.key_point = std::move(near.key_point);
  start.candidates.nearness = std::move(near.nearness);
  start.state = initial_state(settings.kernel, spheres, key_points);
  step(2);
  return start;
}

// Makes and measures levels of detail, on at most 120 evenly picked training poses.
void add_levels(CharacterModel& model, std::span<const Pose> poses) {
  constexpr std::size_t max_poses = 120, min_poses = 4;
  std::vector<Pose> spread;
  const std::size_t count = std::min(max_poses, poses.size());
  for (std::size_t i = 0; i < count; ++i) spread.push_back(poses[i * poses.size() / count]);
  if (spread.size() < min_poses) return;
  for (CharacterLevel& level : make_levels(model, spread)) model.levels.push_back(std::move(level));
}

std::vector<float> floats_of(std::span<const std::uint16_t> targets) {
  std::vector<float> ao;
  for (const std::uint16_t v : targets) ao.push_back(float(v) * AoTargets::scale);
  return ao;
}

BakeResult bake_in_metres(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& settings,
                          const BakeProgress& progress) {
  BakeReport report;
  TracedPoses traced = trace_poses(mesh, poses, settings, progress, report);
  TrainingSet& set = traced.set;
  const TrainingSet& precise = traced.precise;

  const auto step = [&](std::size_t done) {
    if (progress && !progress(BakeStage::initialise, done, 3))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled");
  };
  step(0);
  const Surface surface = rest_surface(mesh);
  const std::vector<float>& area = surface.area;
  set.vertex_weight = vertex_weights(area, settings.fit);
  const std::vector<float> placed_by = settings.fit == FitMethod::paper
                                           ? set.vertex_weight
                                           : placement_weights(set.vertex_weight, set.targets, set.fitted());
  const std::vector<float>& spread_by = settings.fit == FitMethod::paper ? area : set.vertex_weight;
  Start start = initialise(mesh, surface, spread_by, placed_by, settings, step);
  if (settings.learn_gamma)
    start.state.structure.kernel.gamma =
        learned_gamma(set, area, settings, start.candidates, start.state, progress);

  Fit fit(set, area, settings, start.candidates, std::move(start.state), report);
  fit.solve_linear();
  fit.measure();
  report.mse_initial = measure_fit(fit.state(), precise, 0, precise.poses.size(), area).mse;
  fit_both_layers(fit, set, settings, report, progress);
  report.seconds_fit = fit.seconds();
  report.mse_train = measure_fit(fit.best(), precise, 0, precise.poses.size(), area).mse;

  BakeResult result{export_model(fit.best(), mesh, area, surface.normal, floats_of(traced.rest.row(0))),
                    std::move(report)};
  fit_blend_weights(result.model, mesh, set.poses);
  result.report.mse_held_out_file = fit.held_out_mse(state_of_model(quantise(result.model)));
  CasterFitSettings casters;
  casters.seed = settings.seed;
  fit_caster_weights(result.model, mesh, set.poses, casters, stage_progress(progress, BakeStage::casters));
  add_levels(result.model, set.poses);
  return result;
}

}  // namespace

BakeResult bake_character(const SkinnedMesh& mesh, std::span<const Pose> poses, const BakeSettings& settings,
                          const BakeProgress& progress) {
  check(mesh, poses, settings);
  const float scale = scale_to_person(mesh);
  if (scale == 1) return bake_in_metres(mesh, poses, settings, progress);
  BakeResult result = bake_in_metres(scaled(mesh, scale), scaled(poses, scale), settings, progress);
  scale_model(result.model, 1 / scale);
  return result;
}

}  // namespace nook::bake
