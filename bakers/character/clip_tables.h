// Bakes clips of a character: the frames of each, their ray-traced AO, and the tables that hold both.
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

// Finds the best product of few modes and weights for a large matrix.

// values ~ modes * weights.transpose(). The modes are orthonormal; the weights of a mode have the length of
// its singular value, and those with the largest come first.
struct LowRank {
  Eigen::MatrixXf modes;        // rows x count
  Eigen::MatrixXf weights;      // columns x count
  std::vector<double> removed;  // the squared singular value of each mode, by which it lowers the error
  double total = 0;             // the sum of squares of all values
};

// Finds the leading modes by subspace iteration from random vectors (Halko, Martinsson, Tropp 2011, "Finding
// Structure with Randomness", algorithm 4.4). The same seed gives the same bits on any number of threads.
// There are fewer than `count` modes if the matrix has a smaller side.
LowRank factorise(const Eigen::MatrixXf& values, std::size_t count, std::uint64_t seed);

// Returns the weights of given modes that leave the least squared error: columns x modes.
Eigen::MatrixXf fitted_weights(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes);

// Returns left * right.transpose(), computed column by column on all threads.
Eigen::MatrixXf outer_product(const Eigen::MatrixXf& left, const Eigen::MatrixXf& right);

// The frames of clips, one clip after another.
struct ClipFrames {
  std::vector<ClipRange> clips;
  std::vector<Pose> poses;
};

// A clip has about duration * frames_per_second + 1 frames. The first and the last frame are at its ends. A
// clip without duration has one frame.
ClipFrames clip_frames(const ImportedCharacter& character, std::span<const std::size_t> clips,
                       double frames_per_second);

struct ClipTableSettings {
  std::uint64_t seed = 1;
  // The AO error, root mean square over vertices and frames, beyond the noise of the targets.
  double max_error = 0.015;
  // Metres. The error of the points that a bone carries, root mean square over bones and frames.
  double max_pose_error = 0.004;
  // Bytes of the whole file for each frame and welded vertex. This limit outweighs the error limits.
  double max_bytes = 0.25;
  std::uint32_t max_modes = 96;  // of the AO table
};

struct ClipTableReport {
  double error = 0;                    // like max_error, for the tables as they are stored
  double pose_error = 0;               // like max_pose_error
  std::vector<double> error_of_modes;  // with the first 4, 8, 12, ... modes, before rounding
};

// Makes the tables from traced frames. noise_mse is the expected squared error of the targets. The model
// gives the order of vertices and bones.
ClipSet make_clip_set(const SkinnedMesh& mesh, const CharacterModel& model, const ClipFrames& frames,
                      const AoTargets& targets, double noise_mse, const ClipTableSettings& settings,
                      ClipTableReport& report);

}  // namespace nook::bake
