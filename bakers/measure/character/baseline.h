// The published object-space alternatives, fitted on the same poses and measured on the same targets.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake {

// A fitted pose -> AO regression that can be evaluated in any pose.
class PoseRegression {
 public:
  virtual ~PoseRegression() = default;
  // A value a welded vertex, clamped to [0, 1].
  virtual std::vector<float> predict(const Pose& pose) const = 0;
  virtual std::size_t model_bytes() const = 0;  // with half floats
  virtual std::string description() const = 0;  // what cross-validation chose, for reports
};

struct RegressionError {
  double mse = 0;  // over all welded vertices and poses
  double mse_visible =
      0;                // over those vertex-poses whose truth is at least visible_truth, see visible_truth.h
  double mse_area = 0;  // weighted by vertex_area
};

// Clamped predictions against targets of the same poses.
RegressionError measure_regression(const PoseRegression& regression, std::span<const Pose> poses,
                                   const AoTargets& targets, std::span<const float> vertex_area);

}  // namespace nook::bake
