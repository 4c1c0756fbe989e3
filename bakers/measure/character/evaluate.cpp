#include "bakers/measure/character/evaluate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/character/export_model.h"
#include "bakers/character/fit_state.h"
#include "bakers/character/joint_roles.h"
#include "bakers/import/skinning.h"

namespace nook::bake {
namespace {

float linear_ao(const CharacterModel& model, std::size_t vertex, const float* shadow) {
  float dark = model.bias[vertex];
  for (std::size_t s = vertex * model.influences; s < (vertex + 1) * model.influences; ++s)
    dark += model.alpha[s] * shadow[model.influence[s]];
  return std::clamp(1 - dark, 0.0f, 1.0f);
}

// Sums of squared errors of one pose, kept apart so that they can be added in order.
struct ErrorSums {
  double all = 0, area = 0, body = 0, hands = 0;

  void add(double error, float vertex_area, bool hand) {
    const double e2 = error * error;
    all += e2;
    area += e2 * double(vertex_area);
    (hand ? hands : body) += e2;
  }
};

ErrorColumns columns_of(const std::vector<ErrorSums>& poses, std::span<const float> vertex_area,
                        std::span<const char> hands) {
  ErrorSums total;
  for (const ErrorSums& p : poses) {
    total.all += p.all;
    total.area += p.area;
    total.body += p.body;
    total.hands += p.hands;
  }
  double area = 0;
  for (float a : vertex_area) area += double(a);
  const double hand_count = double(std::count(hands.begin(), hands.end(), char(1)));
  const double body_count = double(hands.size()) - hand_count, count = double(poses.size());
  return {total.all / (count * double(hands.size())), total.area / (count * area),
          body_count > 0 ? total.body / (count * body_count) : 0,
          hand_count > 0 ? total.hands / (count * hand_count) : 0};
}

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

CharacterEvaluation evaluate_character(const SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const Pose> poses, std::uint32_t rays, std::uint64_t seed,
                                       const Progress& progress) {
  const AoTargets targets = trace_character_ao(mesh, poses, rays, seed, progress);
  const FitState state = state_of_model(model);
  const std::vector<float> shadows = shadows_of(state, poses);
  const std::size_t padded = state.structure.padded_count(), vertices = mesh.vertex_count();
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const std::vector<char> hands = hand_vertices(mesh);

  std::vector<double> mean(vertices, 0.0);
  for (std::size_t t = 0; t < poses.size(); ++t)
    for (std::size_t i = 0; i < vertices; ++i)
      mean[i] += double(targets.row(t)[i]) * double(AoTargets::scale);
  for (double& m : mean) m /= double(poses.size());

  std::vector<ErrorSums> model_sums(poses.size()), static_sums(poses.size()), oracle_sums(poses.size());
  tbb::parallel_for(std::size_t(0), poses.size(), [&](std::size_t t) {
    const auto row = targets.row(t);
    for (std::size_t i = 0; i < vertices; ++i) {
      const double truth = double(row[i]) * double(AoTargets::scale);
      model_sums[t].add(double(linear_ao(model, i, &shadows[t * padded])) - truth, area[i], hands[i]);
      if (!model.static_ao.empty()) static_sums[t].add(double(model.static_ao[i]) - truth, area[i], hands[i]);
      oracle_sums[t].add(mean[i] - truth, area[i], hands[i]);
    }
  });
  CharacterEvaluation result;
  result.poses = poses.size();
  result.rays = rays;
  result.model = columns_of(model_sums, area, hands);
  result.static_bake = columns_of(static_sums, area, hands);
  result.oracle = columns_of(oracle_sums, area, hands);
  result.noise_floor_mse = measure_noise_floor(mesh, poses, targets, rays, seed);
  result.vertex_rms.resize(vertices);
  tbb::parallel_for(std::size_t(0), vertices, [&](std::size_t i) {
    double sum = 0;
    for (std::size_t t = 0; t < poses.size(); ++t) {
      const double e = double(linear_ao(model, i, &shadows[t * padded])) -
                       double(targets.row(t)[i]) * double(AoTargets::scale);
      sum += e * e;
    }
    result.vertex_rms[i] = float(std::sqrt(sum / double(poses.size())));
  });
  return result;
}

}  // namespace nook::bake
