// Bakes clips of a character: makes tables of poses and AO from the frames of each clip and their ray-traced
// AO.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Approximates a large matrix by a product of a few modes and their weights.

// values ~ modes * weights.transpose(). The modes are orthonormal. The norm of a mode's weights is the mode's
// singular value. Modes are sorted by descending singular value.
struct LowRank {
  Eigen::MatrixXf modes;        // rows x count
  Eigen::MatrixXf weights;      // columns x count
  std::vector<double> removed;  // how much each mode lowers the squared error (its squared singular value)
  double total = 0;             // the sum of squares of all values
};

// Finds the leading modes by subspace iteration from random vectors (Halko, Martinsson, Tropp 2011, "Finding
// Structure with Randomness", algorithm 4.4). The same seed gives the same bits on any number of threads.
// Returns fewer than `count` modes if a side of the matrix is smaller than `count`.
LowRank factorise(const Eigen::MatrixXf& values, std::size_t count, std::uint64_t seed);

// Returns the least-squares weights for the given modes: columns x modes.
Eigen::MatrixXf fitted_weights(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes);

// Returns left * right.transpose(), computed column by column on all threads.
Eigen::MatrixXf outer_product(const Eigen::MatrixXf& left, const Eigen::MatrixXf& right);

// The frames of clips, one clip after another.
struct ClipFrames {
  std::vector<ClipRange> clips;
  std::vector<Pose> poses;
};

// A clip gets about duration * frames_per_second + 1 frames. The first frame is at the clip's start, the last
// frame at its end. A clip without duration has one frame.
ClipFrames clip_frames(const ImportedCharacter& character, std::span<const std::size_t> clips,
                       double frames_per_second);

struct ClipTableSettings {
  std::uint64_t seed = 1;
  // Limit of the AO error: root mean square over vertices and frames, without the noise of the ray tracing.
  double max_error = 0.015;
  // Limit, in metres, of the position error of the points that a bone moves: root mean square over bones and
  // frames.
  double max_pose_error = 0.004;
  // Limit of the file size in bytes per frame and welded vertex. This limit takes precedence over the error
  // limits.
  double max_bytes = 0.25;
  std::uint32_t max_modes = 96;  // maximum for the AO table
};

struct ClipTableReport {
  double error = 0;                    // the error that max_error limits, measured for the stored tables
  double pose_error = 0;               // the error that max_pose_error limits
  std::vector<double> error_of_modes;  // the error with the first 4, 8, 12, ... modes, before rounding
};

// Makes the tables from traced frames. noise_mse is the expected squared error of the targets. The tables use
// the model's order of vertices and bones.
ClipSet make_clip_set(const SkinnedMesh& mesh, const CharacterModel& model, const ClipFrames& frames,
                      const AoTargets& targets, double noise_mse, const ClipTableSettings& settings,
                      ClipTableReport& report);

}  // namespace nook::bake
