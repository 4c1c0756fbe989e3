#include "bakers/measure/character/character_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/character/export_model.h"
#include "bakers/character/fit_state.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"

namespace nook::measure {
namespace {

using namespace bake;

float linear_ao(const CharacterModel& model, std::size_t vertex, const float* shadow) {
  float dark = model.bias[vertex];
  for (std::size_t s = vertex * model.influences; s < (vertex + 1) * model.influences; ++s)
    dark += model.alpha[s] * shadow[model.influence[s]];
  return std::clamp(1 - dark, 0.0f, 1.0f);
}

// Sums of squared errors of one pose. Each pose has its own sums, so that they can be added in the order of
// the poses.
struct ErrorSums {
  double all = 0, visible = 0, visible_area = 0, area = 0, body = 0, hands = 0;

  void add(double error, float vertex_area, bool hand) {
    const double e2 = error * error;
    all += e2;
    area += e2 * double(vertex_area);
    (hand ? hands : body) += e2;
  }
  void add_visible(double error, float vertex_area) {
    visible += error * error;
    visible_area += error * error * double(vertex_area);
  }
};

// The count of visible vertex-poses, and the sum of their areas.
struct VisibleTotal {
  std::size_t count = 0;
  double area = 0;
};

ErrorColumns columns_of(const std::vector<ErrorSums>& poses, const VisibleTotal& visible_total,
                        std::span<const float> vertex_area, std::span<const char> hands) {
  ErrorSums total;
  for (const ErrorSums& p : poses) {
    total.all += p.all;
    total.visible += p.visible;
    total.visible_area += p.visible_area;
    total.area += p.area;
    total.body += p.body;
    total.hands += p.hands;
  }
  double area = 0;
  for (float a : vertex_area) area += double(a);
  const double hand_count = double(std::count(hands.begin(), hands.end(), char(1)));
  const double body_count = double(hands.size()) - hand_count, count = double(poses.size());
  ErrorColumns columns;
  columns.mse = total.all / (count * double(hands.size()));
  if (visible_total.count > 0) columns.mse_visible = total.visible / double(visible_total.count);
  if (visible_total.area > 0) columns.mse_visible_area = total.visible_area / visible_total.area;
  columns.mse_area = total.area / (count * area);
  if (body_count > 0) columns.mse_body = total.body / (count * body_count);
  if (hand_count > 0) columns.mse_hands = total.hands / (count * hand_count);
  return columns;
}

double truth_at(const AoTargets& targets, std::size_t pose, std::size_t vertex) {
  return double(targets.row(pose)[vertex]) * double(AoTargets::scale);
}

// For every vertex, the mean ray-traced AO over all poses, and the mean over the poses in which the vertex is
// visible.
struct Oracle {
  std::vector<double> mean, visible_mean;
  VisibleTotal visible_total;

  Oracle(const AoTargets& targets, std::span<const float> vertex_area)
      : mean(targets.vertex_count, 0.0), visible_mean(targets.vertex_count, 0.0) {
    const std::size_t poses = targets.pose_count();
    std::vector<std::size_t> visible_poses(targets.vertex_count, 0);
    for (std::size_t t = 0; t < poses; ++t)
      for (std::size_t i = 0; i < mean.size(); ++i) {
        const double truth = truth_at(targets, t, i);
        mean[i] += truth;
        if (truth < visible_truth) continue;
        visible_mean[i] += truth;
        ++visible_poses[i];
      }
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] /= double(poses);
      if (visible_poses[i] > 0) visible_mean[i] /= double(visible_poses[i]);
      visible_total.count += visible_poses[i];
      visible_total.area += double(visible_poses[i]) * double(vertex_area[i]);
    }
  }
};

}  // namespace

std::vector<char> hand_vertices(const SkinnedMesh& mesh) {
  const std::vector<Joint> joints = joint_roles(mesh);
  std::vector<char> hand_bone(mesh.bones.size(), 0);
  for (std::size_t b = 0; b < hand_bone.size(); ++b) {
    const std::int32_t parent = mesh.bones[b].parent;
    hand_bone[b] = joints[b].role == JointRole::hand || (parent >= 0 && hand_bone[std::size_t(parent)]);
  }
  std::vector<char> hands(mesh.vertex_count(), 0);
  for (std::size_t i = 0; i < hands.size(); ++i) {
    float weight = 0;
    for (int s = 0; s < SkinWeights::max_bones; ++s)
      if (hand_bone[mesh.weights[i].bone[s]]) weight += mesh.weights[i].weight[s];
    hands[i] = weight > 0.5f;
  }
  return hands;
}

std::vector<float> predict_ao(const CharacterModel& model, std::span<const Mat3x4> bones) {
  const FitState state = state_of_model(model);
  const NonLinearLayer layer(state.structure);
  LayerWorkspace workspace(state.structure);
  std::vector<float> shadow(state.structure.padded_count());
  layer.forward(bones, state.parameters, workspace, shadow.data());
  std::vector<float> ao(model.vertex_count());
  for (std::size_t i = 0; i < ao.size(); ++i) ao[i] = linear_ao(model, i, shadow.data());
  return ao;
}

CharacterEvaluation score_character(const SkinnedMesh& mesh, const CharacterModel& model,
                                    std::span<const Pose> poses, AoTargets targets) {
  const FitState state = state_of_model(model);
  const std::vector<float> shadows = shadows_of(state, poses);
  const std::size_t padded = state.structure.padded_count(), vertices = mesh.vertex_count();
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const std::vector<char> hands = hand_vertices(mesh);

  const Oracle best(targets, area);
  std::vector<ErrorSums> model_sums(poses.size()), static_sums(poses.size()), oracle_sums(poses.size());
  tbb::parallel_for(std::size_t(0), poses.size(), [&](std::size_t t) {
    for (std::size_t i = 0; i < vertices; ++i) {
      const double truth = truth_at(targets, t, i);
      const bool visible = truth >= visible_truth;
      const auto add = [&](ErrorSums& sums, double value) {
        sums.add(value - truth, area[i], hands[i]);
        if (visible) sums.add_visible(value - truth, area[i]);
      };
      add(model_sums[t], double(linear_ao(model, i, &shadows[t * padded])));
      if (!model.static_ao.empty()) add(static_sums[t], double(model.static_ao[i]));
      oracle_sums[t].add(best.mean[i] - truth, area[i], hands[i]);
      if (visible) oracle_sums[t].add_visible(best.visible_mean[i] - truth, area[i]);
    }
  });
  CharacterEvaluation result;
  result.poses = poses.size();
  result.visible_share = double(best.visible_total.count) / double(vertices * poses.size());
  result.model = columns_of(model_sums, best.visible_total, area, hands);
  result.static_bake = columns_of(static_sums, best.visible_total, area, hands);
  result.oracle = columns_of(oracle_sums, best.visible_total, area, hands);
  for (std::size_t t = 0; t < poses.size(); ++t)
    result.pose_visible.push_back({model_sums[t].visible, static_sums[t].visible});
  result.vertex_rms.resize(vertices);
  tbb::parallel_for(std::size_t(0), vertices, [&](std::size_t i) {
    double sum = 0;
    for (std::size_t t = 0; t < poses.size(); ++t) {
      const double e = double(linear_ao(model, i, &shadows[t * padded])) - truth_at(targets, t, i);
      sum += e * e;
    }
    result.vertex_rms[i] = float(std::sqrt(sum / double(poses.size())));
  });
  result.truth = std::move(targets);
  return result;
}

CharacterEvaluation evaluate_character(const SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const Pose> poses, std::uint32_t rays, std::uint64_t seed,
                                       const Progress& progress) {
  CharacterEvaluation result =
      score_character(mesh, model, poses, trace_character_ao(mesh, poses, rays, seed, progress));
  result.rays = rays;
  result.noise_floor_mse = measure_noise_floor(mesh, poses, result.truth, rays, seed);
  return result;
}

UpdateErrors measure_update(const CharacterModel& model, std::span<const Pose> poses, const AoTargets& truth,
                            float far_error) {
  Memory* const memory = default_memory();
  SceneSettings settings;
  settings.far_error = far_error;
  Scene scene(settings, Parallel{}, memory);
  scene.terms = NOOK_TERM_SELF;
  const nook_instance_id id = add_instance(
      scene, Owned<LoadedModel>::make(memory, Ref<const RefCounted>(), CharacterModel(model), memory));
  std::vector<std::size_t> file_of_welded(model.vertex_count());
  for (std::size_t i = 0; i < model.file_to_welded.size(); ++i) file_of_welded[model.file_to_welded[i]] = i;
  std::vector<float> ao(model.file_to_welded.size());
  double squared = 0, visible_squared = 0;
  std::size_t visible = 0;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    set_pose(scene, id, poses[t]);
    update(scene);
    read_ao(scene, instance_of(scene, id), ao.data(), sizeof(float));
    for (std::size_t i = 0; i < file_of_welded.size(); ++i) {
      const double traced = truth_at(truth, t, i), error = double(ao[file_of_welded[i]]) - traced;
      squared += error * error;
      if (traced < visible_truth) continue;
      visible_squared += error * error;
      ++visible;
    }
  }
  UpdateErrors errors;
  errors.mse = squared / double(poses.size() * file_of_welded.size());
  if (visible > 0) errors.mse_visible = visible_squared / double(visible);
  return errors;
}

RegressionError measure_regression(const PoseRegression& regression, std::span<const Pose> poses,
                                   const AoTargets& targets, std::span<const float> vertex_area) {
  // Each pose has one partial sum. They are added in order, so that the result has the same bits with any
  // number of threads.
  std::vector<RegressionError> partial(poses.size());
  std::vector<std::size_t> visible(poses.size(), 0);
  tbb::parallel_for(std::size_t(0), poses.size(), [&](std::size_t t) {
    const std::vector<float> ao = regression.predict(poses[t]);
    const auto row = targets.row(t);
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double truth = double(row[i]) * double(AoTargets::scale), e = double(ao[i]) - truth;
      partial[t].mse += e * e;
      if (truth >= visible_truth) {
        partial[t].mse_visible += e * e;
        ++visible[t];
      }
      partial[t].mse_area += e * e * double(vertex_area[i]);
    }
  });
  double area = 0;
  for (float a : vertex_area) area += double(a);
  RegressionError total;
  for (const RegressionError& p : partial) {
    total.mse += p.mse;
    total.mse_visible += p.mse_visible;
    total.mse_area += p.mse_area;
  }
  total.mse /= double(poses.size()) * double(vertex_area.size());
  const std::size_t visible_count = std::accumulate(visible.begin(), visible.end(), std::size_t(0));
  if (visible_count > 0) total.mse_visible /= double(visible_count);
  total.mse_area /= double(poses.size()) * area;
  return total;
}

}  // namespace nook::measure
