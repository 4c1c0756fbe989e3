// Measures the error of a model against ray tracing on given poses, and the errors of the methods that a team
// would use instead.
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
// in a fist. No camera sees them, so errors of visible vertices leave them out; but their triangles may be
// visible, and measure_surface counts these.
inline constexpr double visible_truth = double(bake::hidden_below);

struct ErrorColumns {
  double mse = 0;  // mean over all welded vertices and poses, as in the paper
  // Only over vertex-poses whose traced AO is at least visible_truth; 0 if there are none.
  double mse_visible = 0;
  // Like mse_visible, but weighted by rest Voronoi area, because the eye sees areas and not vertices.
  double mse_visible_area = 0;
  double mse_area = 0;   // weighted by rest Voronoi area
  double mse_body = 0;   // only over vertices outside the hands (see hand_vertices)
  double mse_hands = 0;  // only over vertices of the hands; 0 if there are none
};

// Squared errors of one pose, summed over its visible vertices.
struct PoseErrorSums {
  double model = 0, static_bake = 0;
};

struct CharacterEvaluation {
  std::size_t poses = 0;
  std::uint32_t rays = 0;
  double noise_floor_mse = 0;  // expected squared error of the ray-traced targets themselves
  double visible_share = 0;    // share of all vertex-poses that are visible
  // The oracle is the best possible static bake for each column. It is the mean traced AO of a vertex over
  // all poses. For mse_visible, the mean is over the poses in which the vertex is visible.
  ErrorColumns model, static_bake, oracle;
  std::vector<PoseErrorSums> pose_visible;  // one entry per pose
  bake::AoTargets truth;                    // the traced targets, so that other methods can be measured on
                                            // them
  std::vector<float> vertex_rms;            // error of the model per welded vertex; pictures show it
};

// Returns the clamped AO that the model predicts for one pose, one value per welded vertex. Computes it with
// the scalar reference implementation.
std::vector<float> predict_ao(const CharacterModel& model, std::span<const Mat3x4> bones);

// Measures the error against the given targets, which have one row per pose. In the result, the fields `rays`
// and `noise_floor_mse` are 0.
CharacterEvaluation score_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                    std::span<const bake::Pose> poses, bake::AoTargets targets);

// Traces targets with `rays` rays per vertex and measures the error against them. Pass a seed that differs
// from the seed of the fit.
CharacterEvaluation evaluate_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, std::uint32_t rays,
                                       std::uint64_t seed, const bake::Progress& progress = {});

// The error of the runtime's update of a single instance. The update groups far spheres as far as far_error
// allows. If far_error is 0, nothing is grouped, and the result differs from the scalar reference only by
// rounding.
struct UpdateErrors {
  double mse = 0;          // mean over all welded vertices and poses
  double mse_visible = 0;  // only over vertex-poses whose traced AO is at least visible_truth
};
UpdateErrors measure_update(const CharacterModel& model, std::span<const bake::Pose> poses,
                            const bake::AoTargets& truth, float far_error);

// Finds the vertices of the hands, for mse_body and mse_hands. Returns true for a vertex if the bone with its
// largest weight has the role of a hand, or is a descendant of such a bone.
std::vector<char> hand_vertices(const bake::SkinnedMesh& mesh);

// A method to compare the model with: a fitted regression that computes AO from any pose.
class PoseRegression {
 public:
  virtual ~PoseRegression() = default;
  // Returns one value per welded vertex, clamped to [0, 1].
  virtual std::vector<float> predict(const bake::Pose& pose) const = 0;
  virtual std::size_t model_bytes() const = 0;  // size if the coefficients are stored as half floats
  virtual std::string description() const = 0;  // what cross-validation chose, for reports
};

struct RegressionError {
  double mse = 0;          // mean over all welded vertices and poses
  double mse_visible = 0;  // only over vertex-poses whose traced AO is at least visible_truth
  double mse_area = 0;     // weighted by vertex_area
};

// Compares the clamped predictions for `poses` with the targets for the same poses.
RegressionError measure_regression(const PoseRegression& regression, std::span<const bake::Pose> poses,
                                   const bake::AoTargets& targets, std::span<const float> vertex_area);

}  // namespace nook::measure
