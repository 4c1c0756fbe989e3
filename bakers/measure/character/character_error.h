// The error of a model against ray tracing on given poses, beside what a team would use instead.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// A vertex in a pose counts as black if its ray-traced AO is below this. Such vertices are inside the body or
// in a fist: no camera sees them, and a model that says 0 is always right. Two rays of 128 reach this value.
inline constexpr double visible_truth = 0.01;

struct ErrorColumns {
  double mse = 0;  // over all welded vertices and poses, as the paper has it
  double mse_visible =
      0;  // over those vertex-poses whose truth is at least visible_truth; 0 where there are none
  double mse_visible_area = 0;  // as mse_visible, weighted by rest Voronoi area: what the eye sees
  double mse_area = 0;          // weighted by rest Voronoi area
  double mse_body = 0;          // vertices that no hand bone or anything below it moves
  double mse_hands = 0;         // the others; 0 where there are none
};

// Squared errors of one pose, summed over its visible vertices.
struct PoseErrorSums {
  double model = 0, static_bake = 0;
};

struct CharacterEvaluation {
  std::size_t poses = 0;
  std::uint32_t rays = 0;
  double noise_floor_mse = 0;  // expected squared error of the ray-traced targets themselves
  double visible_share = 0;    // of all vertex-poses
  // The oracle is the best static bake of each column: the mean truth of a vertex over all poses, in
  // mse_visible over those in which the vertex is visible.
  ErrorColumns model, static_bake, oracle;
  std::vector<PoseErrorSums> pose_visible;  // a value a pose
  bake::AoTargets truth;                    // what was measured against, for other methods on the same
  std::vector<float>
      vertex_rms;  // of the model, one value per welded vertex: what a picture of the error shows
};

// Returns a model's clamped prediction for one pose, by the scalar reference: one value per welded vertex.
std::vector<float> predict_ao(const CharacterModel& model, std::span<const Mat3x4> bones);

// Measures the error against the given targets, one row per pose. rays and noise_floor_mse stay 0.
CharacterEvaluation score_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                    std::span<const bake::Pose> poses, bake::AoTargets targets);

// Targets are traced with rays for each vertex under another seed than the fit's.
CharacterEvaluation evaluate_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, std::uint32_t rays,
                                       std::uint64_t seed, const bake::Progress& progress = {});

// The error of the runtime's own update of a lone instance, which groups far spheres as far_error allows (0:
// none, which differs from the scalar reference by rounding alone).
struct UpdateErrors {
  double mse = 0;          // over all welded vertices and poses
  double mse_visible = 0;  // over those vertex-poses whose truth is at least visible_truth
};
UpdateErrors measure_update(const CharacterModel& model, std::span<const bake::Pose> poses,
                            const bake::AoTargets& truth, float far_error);

// Splits vertices for mse_body and mse_hands: true where a hand bone (by role) or a bone below it holds most
// of the weight.
std::vector<char> hand_vertices(const bake::SkinnedMesh& mesh);

// A fitted pose -> AO regression that can be evaluated in any pose: another method than the model.
class PoseRegression {
 public:
  virtual ~PoseRegression() = default;
  // A value a welded vertex, clamped to [0, 1].
  virtual std::vector<float> predict(const bake::Pose& pose) const = 0;
  virtual std::size_t model_bytes() const = 0;  // with half floats
  virtual std::string description() const = 0;  // what cross-validation chose, for reports
};

struct RegressionError {
  double mse = 0;          // over all welded vertices and poses
  double mse_visible = 0;  // over those vertex-poses whose truth is at least visible_truth
  double mse_area = 0;     // weighted by vertex_area
};

// Clamped predictions against targets of the same poses.
RegressionError measure_regression(const PoseRegression& regression, std::span<const bake::Pose> poses,
                                   const bake::AoTargets& targets, std::span<const float> vertex_area);

}  // namespace nook::measure
