// Tables of clips: planted AO and poses come back, within the bounds of error and bytes, and ray-traced AO of
// a bending tube is kept.
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>

#include "bakers/character/clip_tables.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/loaded_clips.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t frame_count = 120;

// The part of a model that a set takes: its orders.
CharacterModel orders_of(const SkinnedMesh& mesh) {
  CharacterModel model;
  for (const Bone& bone : mesh.bones) model.bone_names.emplace_back(bone.name.c_str());
  model.file_to_welded.assign(mesh.file_to_welded.begin(), mesh.file_to_welded.end());
  model.bias.resize(mesh.vertex_count());
  return model;
}

// One clip of 4 seconds whose joint turns and bends smoothly.
ClipFrames swaying(const SkinnedMesh& mesh) {
  ClipFrames frames;
  ClipRange& clip = frames.clips.emplace_back();
  clip.name = "sway";
  clip.duration_s = 4;
  clip.frame_count = frame_count;
  for (std::size_t f = 0; f < frame_count; ++f) {
    const float t = 6.2831853f * float(f) / float(frame_count - 1);
    const JointRotation joint{1, {0.3f * std::sin(2 * t), 1.2f * std::sin(t), 0.8f * std::cos(3 * t)}};
    frames.poses.push_back(turn_joints(mesh, {&joint, 1}));
  }
  return frames;
}

// AO between 0.1 and 0.9 that is exactly a product of four modes.
AoTargets planted(std::size_t vertices) {
  AoTargets targets;
  targets.vertex_count = vertices;
  for (std::size_t f = 0; f < frame_count; ++f)
    for (std::size_t i = 0; i < vertices; ++i) {
      const double x = double(i) / double(vertices), t = double(f) / double(frame_count);
      const double ao = 0.5 + 0.2 * std::sin(9 * x) * std::cos(7 * t) + 0.1 * std::cos(23 * x) * t +
                        0.1 * std::sin(50 * x) * std::sin(12 * t);
      targets.value.push_back(std::uint16_t(std::lround(ao * 65535)));
    }
  return targets;
}

double rms_error(const ClipSet& set, const AoTargets& targets) {
  double sum = 0;
  for (std::size_t f = 0; f < targets.pose_count(); ++f)
    for (std::size_t i = 0; i < targets.vertex_count; ++i) {
      double ao = 0.5;
      for (std::size_t k = 0; k < set.ao.modes; ++k)
        ao += double(set.ao.frame_weight(f, k)) * double(set.ao.mode[k * set.ao.rows + i]) / 127;
      const double e =
          std::min(std::max(ao, 0.0), 1.0) - double(targets.row(f)[i]) * double(AoTargets::scale);
      sum += e * e;
    }
  return std::sqrt(sum / double(targets.value.size()));
}

}  // namespace

TEST_CASE("the leading modes of a matrix are found, and their weights") {
  // Three orthogonal products with singular values 30, 10 and 2.
  constexpr Eigen::Index rows = 600, columns = 80;
  Eigen::MatrixXf values = Eigen::MatrixXf::Zero(rows, columns);
  const double sizes[] = {30, 10, 2};
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXf left(rows), right(columns);
    for (Eigen::Index r = 0; r < rows; ++r)
      left[r] = float(std::sqrt(2.0 / double(rows)) *
                      std::cos(std::numbers::pi * (double(r) + 0.5) * (k + 1) / double(rows)));
    for (Eigen::Index c = 0; c < columns; ++c)
      right[c] = float(std::sqrt(2.0 / double(columns)) *
                       std::cos(std::numbers::pi * (double(c) + 0.5) * (2 * k + 1) / double(columns)));
    values += float(sizes[k]) * left * right.transpose();
  }
  const LowRank low = factorise(values, 2, 7);
  REQUIRE(low.removed.size() == 2);
  // Float sums of 600 numbers.
  CHECK(std::abs(std::sqrt(low.removed[0]) - 30) < 1e-3);
  CHECK(std::abs(std::sqrt(low.removed[1]) - 10) < 1e-3);
  CHECK(std::abs(low.total - 1004) < 0.1);
  const Eigen::MatrixXf left = values - outer_product(low.modes, low.weights);
  CHECK(std::abs(double(left.norm()) - 2) < 1e-3);
  CHECK(double((fitted_weights(values, low.modes) - low.weights).norm()) < 1e-2);
}

TEST_CASE("planted AO of four modes and the poses of the clip come back") {
  const SkinnedMesh mesh = bending_tube();
  const CharacterModel model = orders_of(mesh);
  const ClipFrames frames = swaying(mesh);
  const AoTargets targets = planted(mesh.vertex_count());
  ClipTableSettings settings;
  settings.max_error = 0.002;
  settings.max_bytes = 4;
  ClipTableReport report;
  const ClipSet set = make_clip_set(mesh, model, frames, targets, 0, settings, report);
  CHECK_NOTHROW(read_clip_set(write_clip_set(set)));
  CHECK(set.ao.modes == 4);
  // Modes of eight bits round to 1/254 of an amplitude of 0.5, and weights of 16 bits are finer.
  CHECK(rms_error(set, targets) < 0.002);
  CHECK(std::abs(report.error - rms_error(set, targets)) < 1e-4);
  CHECK(report.pose_error <= 1.5 * settings.max_pose_error);
  for (std::uint32_t f = 0; f < frame_count; f += 17) {
    const Mat3x4 got = decode_bone(set, {f, f, 0}, Mat3x4{}, 1);
    for (const Vec3 p : {Vec3{0.6f, 0, 0}, Vec3{1, 0.1f, 0}})
      CHECK(length(transform_point(got, p) - transform_point(frames.poses[f][1], p)) <
            float(4 * settings.max_pose_error));
  }
}

TEST_CASE("the same seed gives the same bytes on any number of threads") {
  const SkinnedMesh mesh = bending_tube();
  const ClipFrames frames = swaying(mesh);
  const auto baked = [&](int threads) {
    std::vector<std::byte> bytes;
    tbb::task_arena(threads).execute([&] {
      const AoTargets targets = trace_character_ao(mesh, frames.poses, 16, 3);
      ClipTableReport report;
      bytes = write_clip_set(make_clip_set(mesh, orders_of(mesh), frames, targets, 1e-3, {}, report));
    });
    return bytes;
  };
  CHECK(baked(1) == baked(2));
}

TEST_CASE("traced AO of a clip is kept below the noise of its rays, within the bytes") {
  const SkinnedMesh mesh = bending_tube();
  const ClipFrames frames = swaying(mesh);
  const AoTargets traced = trace_character_ao(mesh, frames.poses, 32, 3),
                  truth = trace_character_ao(mesh, frames.poses, 1024, 5);
  const double noise = measure_noise_floor(mesh, frames.poses, traced, 32, 3);
  ClipTableSettings settings;
  settings.max_bytes = 0.4;
  ClipTableReport report;
  const ClipSet set = make_clip_set(mesh, orders_of(mesh), frames, traced, noise, settings, report);
  const double bytes = double(write_clip_set(set).size());
  CHECK(bytes <= settings.max_bytes * double(frame_count) * double(mesh.vertex_count()));
  const double error = rms_error(set, truth);
  // Few modes average the noise of many frames.
  CHECK(error * error < 0.7 * noise);
  // The report knows the error without the truth; the noise of the rays is itself an estimate.
  CHECK(std::abs(report.error - error) < 0.5 * error + 2e-3);
}

TEST_CASE("a small byte bound limits the modes, and a clip of one frame is kept") {
  const SkinnedMesh mesh = bending_tube();
  ClipFrames frames = swaying(mesh);
  // The noise of few rays has no modes of its own, so that the error alone would take all of them.
  const AoTargets targets = trace_character_ao(mesh, frames.poses, 16, 3);
  ClipTableSettings settings;
  settings.max_error = 1e-3;
  settings.max_bytes = 0.3;
  ClipTableReport report;
  const ClipSet tight = make_clip_set(mesh, orders_of(mesh), frames, targets, 0, settings, report);
  settings.max_bytes = 4;
  const ClipSet wide = make_clip_set(mesh, orders_of(mesh), frames, targets, 0, settings, report);
  CHECK(tight.ao.modes < wide.ao.modes);

  ClipFrames still;
  still.clips = {frames.clips[0]};
  still.clips[0].frame_count = 1;
  still.clips[0].duration_s = 0;
  still.poses = {frames.poses[30]};
  AoTargets one;
  one.vertex_count = targets.vertex_count;
  one.value.assign(targets.row(30).begin(), targets.row(30).end());
  const ClipSet set = make_clip_set(mesh, orders_of(mesh), still, one, 0, settings, report);
  CHECK_NOTHROW(read_clip_set(write_clip_set(set)));
  // A single mode holds it, to the step of its eight bits.
  CHECK(rms_error(set, one) < 0.005);
}
