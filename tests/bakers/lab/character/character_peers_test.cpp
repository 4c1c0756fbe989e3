#include "bakers/measure/character/character_error.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bakers/character/pose_sets.h"
#include "bakers/lab/character/character_peers.h"
#include "bakers/lab/character/cross_validation.h"
#include "bakers/lab/character/pose_space.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;
using namespace nook::lab;

namespace {

// A chain of bones; vertex i rides on bone i % bones. Only weights and hierarchy matter here: the AO is made
// up.
SkinnedMesh chain(std::size_t bones, std::size_t vertices) {
  SkinnedMesh mesh;
  mesh.bones.resize(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    mesh.bones[b].parent = std::int32_t(b) - 1;
    mesh.bones[b].frame_rest.m[3] = float(b);
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.position.push_back({float(i), 0, 0});
    SkinWeights w;
    w.bone[0] = std::uint16_t(i % bones);
    w.weight[0] = 1;
    mesh.weights.push_back(w);
  }
  return mesh;
}

std::vector<Pose> random_poses(const SkinnedMesh& mesh, std::size_t count, float range, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto angle = [&] { return range * (2 * float(bits() >> 40) * 0x1p-24f - 1); };
  std::vector<Pose> poses;
  for (std::size_t p = 0; p < count; ++p) {
    std::vector<JointRotation> turns;
    for (std::uint32_t b = 1; b < mesh.bones.size(); ++b) {
      const float x = angle(), y = angle(), z = angle();
      turns.push_back({b, {x, y, z}});
    }
    poses.push_back(turn_joints(mesh, turns));
  }
  return poses;
}

template <class Ao>
AoTargets make_targets(const SkinnedMesh& mesh, std::span<const Pose> poses, const Ao& ao_of) {
  const PoseFeatures features(mesh, FeatureKind::axis_angle);
  AoTargets targets;
  targets.vertex_count = mesh.vertex_count();
  for (const Pose& pose : poses) {
    const Eigen::RowVectorXf x = features.of(pose);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      targets.value.push_back(std::uint16_t(std::lround(std::clamp(ao_of(i, x), 0.0f, 1.0f) * 65535)));
  }
  return targets;
}

// AO that is linear in the joint angles and never leaves [0, 1]: both baselines can represent it exactly.
float planted_linear(std::size_t vertex, const Eigen::RowVectorXf& x) {
  float ao = 0.5f;
  for (Eigen::Index f = 0; f < x.size(); ++f)
    ao += 0.3f / float(x.size()) * std::sin(1.7f * float(vertex) + 2.3f * float(f)) * x[f];
  return ao;
}

// Linear with other coefficients on each side of a joint's straight position: one linear model cannot hold
// it, two clusters can.
float planted_kink(std::size_t vertex, const Eigen::RowVectorXf& x) {
  return 0.5f + 0.2f * std::sin(float(vertex)) * std::fabs(x[0]);
}

double variance_round_mean(const AoTargets& t) {
  double total = 0;
  for (std::size_t i = 0; i < t.vertex_count; ++i) {
    double mean = 0, square = 0;
    for (std::size_t p = 0; p < t.pose_count(); ++p) {
      const double v = double(t.row(p)[i]) / 65535;
      mean += v;
      square += v * v;
    }
    mean /= double(t.pose_count());
    total += square / double(t.pose_count()) - mean * mean;
  }
  return total / double(t.vertex_count);
}

std::vector<float> ones(const SkinnedMesh& mesh) {
  return std::vector<float>(mesh.vertex_count(), 1.0f);
}

}  // namespace

TEST_CASE("pose features are the joint rotations against the parent") {
  const SkinnedMesh mesh = chain(3, 9);
  const JointRotation turns[] = {{1, {0.3f, 0, 0}}, {2, {0, -0.7f, 0.2f}}};
  Pose pose = turn_joints(mesh, turns);
  // A uniformly scaled, turned and moved character has the same features.
  const JointRotation whole{0, {0.4f, 1.1f, -0.3f}};
  const Pose root = turn_joints(mesh, {&whole, 1});
  for (Mat3x4& m : pose) {
    Mat3x4 scaled = root[0];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) scaled.m[4 * i + j] *= 2;
    scaled.m[3] += 5;
    m = scaled * m;
  }
  const Eigen::RowVectorXf x = PoseFeatures(mesh, FeatureKind::axis_angle).of(pose);
  REQUIRE(x.size() == 6);  // the root moves every vertex: it tells nothing
  const float truth[] = {0.3f, 0, 0, 0, -0.7f, 0.2f};
  // Logarithms of single-precision rotations near these angles lose about four digits.
  for (int i = 0; i < 6; ++i) CHECK(std::fabs(x[i] - truth[i]) < 2e-4f);

  const Eigen::RowVectorXf at_rest = PoseFeatures(mesh, FeatureKind::matrix).of(Pose(3));
  CHECK(at_rest.cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("validation folds leave every pose out once and keep neighbours together") {
  const std::vector<ValidationFold> folds = validation_folds(100, 4, 5);
  REQUIRE(folds.size() == 4);
  std::vector<int> left_out(100, 0);
  std::size_t breaks = 0;
  for (const ValidationFold& fold : folds) {
    CHECK(fold.fitted.size() + fold.left_out.size() == 100);
    for (Eigen::Index t : fold.left_out) ++left_out[std::size_t(t)];
    for (std::size_t i = 1; i < fold.left_out.size(); ++i)
      breaks += fold.left_out[i] != fold.left_out[i - 1] + 1;
  }
  CHECK(std::all_of(left_out.begin(), left_out.end(), [](int n) { return n == 1; }));
  CHECK(breaks == 4 * 4);  // five runs a fold
}

TEST_CASE("the smallest candidate near the best wins") {
  CHECK(smallest_near_best({{1.0, 50}, {1.004, 20}, {1.02, 10}}, 0.005) == 1);
  CHECK(smallest_near_best({{1.0, 50}, {1.004, 20}, {1.02, 10}}, 0) == 0);
}

TEST_CASE("k-means finds separated groups, the same for the same seed") {
  BaselineMatrix points(90, 2);
  for (int i = 0; i < 90; ++i) {
    points(i, 0) = 10 * float(i % 3) + 0.1f * std::sin(float(i));
    points(i, 1) = 0.1f * std::cos(float(7 * i));
  }
  const PoseGroups groups = k_means(points, 3, 5);
  std::vector<float> x{groups.centre(0, 0), groups.centre(1, 0), groups.centre(2, 0)};
  std::sort(x.begin(), x.end());
  for (int g = 0; g < 3; ++g)
    CHECK(std::fabs(x[std::size_t(g)] - 10 * float(g)) < 0.1f);  // the spread within a group
  CHECK(groups.mean_squared_distance < 0.02);
  CHECK(k_means(points, 3, 5).centre == groups.centre);
}

TEST_CASE("both baselines recover linear AO and have a lower error than the mean on unseen poses") {
  const SkinnedMesh mesh = chain(6, 60);
  const std::vector<Pose> poses = random_poses(mesh, 300, 0.8f, 1), unseen = random_poses(mesh, 80, 0.8f, 2);
  const AoTargets targets = make_targets(mesh, poses, planted_linear);
  const AoTargets truth = make_targets(mesh, unseen, planted_linear);
  const double variance = variance_round_mean(truth);
  const auto linear = fit_linear_pose(mesh, poses, targets);
  const auto clusters = fit_pose_clusters(mesh, poses, targets);
  // Half floats (2^-11 relative) and the rank reduction, which may give away 0.5 % of an error that is nearly
  // 0, leave far less than a thousandth of the variance.
  CHECK(measure_regression(*linear, unseen, truth, ones(mesh)).mse < 1e-3 * variance);
  CHECK(measure_regression(*clusters, unseen, truth, ones(mesh)).mse < 1e-3 * variance);
  CHECK(linear->model_bytes() > 0);
  CHECK_FALSE(clusters->description().empty());
}

TEST_CASE("pose clusters hold what one linear model cannot") {
  const SkinnedMesh mesh = chain(2, 40);
  const std::vector<Pose> poses = random_poses(mesh, 600, 1.0f, 3), unseen = random_poses(mesh, 150, 1.0f, 4);
  const AoTargets targets = make_targets(mesh, poses, planted_kink);
  const AoTargets truth = make_targets(mesh, unseen, planted_kink);
  const double linear =
      measure_regression(*fit_linear_pose(mesh, poses, targets), unseen, truth, ones(mesh)).mse;
  const double clusters =
      measure_regression(*fit_pose_clusters(mesh, poses, targets), unseen, truth, ones(mesh)).mse;
  // A linear model of |x| over a symmetric range explains nothing of its variance but what matrix entries
  // such as cos x - 1 see; several pieces explain nearly all.
  CHECK(clusters < 0.25 * linear);
}

TEST_CASE("regularisation keeps the baselines at the mean where the poses have no information") {
  const SkinnedMesh mesh = chain(8, 30);
  const std::vector<Pose> poses = random_poses(mesh, 60, 0.8f, 5), unseen = random_poses(mesh, 60, 0.8f, 6);
  std::mt19937_64 bits(7);
  const auto noise = [&](std::size_t, const Eigen::RowVectorXf&) { return float(bits() >> 40) * 0x1p-24f; };
  const AoTargets targets = make_targets(mesh, poses, noise), truth = make_targets(mesh, unseen, noise);
  const double variance = variance_round_mean(truth);
  // 21 parameters from 60 poses of pure noise would add a third of the variance without a ridge; the mean of
  // 60 samples itself adds a sixtieth.
  CHECK(measure_regression(*fit_linear_pose(mesh, poses, targets), unseen, truth, ones(mesh)).mse <
        1.15 * variance);
  CHECK(measure_regression(*fit_pose_clusters(mesh, poses, targets), unseen, truth, ones(mesh)).mse <
        1.15 * variance);
}

TEST_CASE("baselines do not depend on the number of threads") {
  const SkinnedMesh mesh = chain(4, 600);
  const std::vector<Pose> poses = random_poses(mesh, 120, 0.8f, 8);
  const AoTargets targets = make_targets(mesh, poses, planted_kink);
  std::vector<std::vector<float>> answers;
  for (std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    answers.push_back(fit_linear_pose(mesh, poses, targets)->predict(poses[5]));
    answers.push_back(fit_pose_clusters(mesh, poses, targets)->predict(poses[5]));
  }
  CHECK(answers[0] == answers[2]);
  CHECK(answers[1] == answers[3]);
}

TEST_CASE("a character without joints to turn is given its mean") {
  const SkinnedMesh mesh = chain(1, 5);
  const std::vector<Pose> poses(3, Pose(1));
  const AoTargets targets =
      make_targets(mesh, poses, [](std::size_t i, const Eigen::RowVectorXf&) { return 0.1f * float(i); });
  for (const auto& peer : {fit_linear_pose(mesh, poses, targets), fit_pose_clusters(mesh, poses, targets)})
    // 16-bit targets.
    for (std::size_t i = 0; i < 5; ++i)
      CHECK(std::fabs(peer->predict(poses[0])[i] - 0.1f * float(i)) < 1e-4f);
}
