// Cross-validation of the baselines: which poses are left out together, and which vertices vote.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/lab/character/pose_space.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::lab {

// Folds receive runs of neighbouring poses. Consecutive frames of a clip are nearly equal, so single poses in
// folds would choose far too little regularisation.
struct ValidationFold {
  std::vector<Eigen::Index> fitted, left_out;
};
std::vector<ValidationFold> validation_folds(std::size_t poses, std::size_t folds = 4,
                                             std::size_t runs_a_fold = 5);

// At most `count` vertices, evenly spread over the mesh's order.
std::vector<std::size_t> sample_vertices(std::size_t vertex_count, std::size_t count);

// AO of some vertices: poses x vertices.
BaselineMatrix target_columns(const bake::AoTargets& targets, const std::vector<std::size_t>& vertices);
BaselineMatrix target_columns(const bake::AoTargets& targets, std::size_t first, std::size_t last);

// Sum of squared errors of clamped predictions.
double clamped_squared_error(const BaselineMatrix& prediction, const BaselineMatrix& target);

// Returns the smallest candidate whose error is within `slack` (relative) of the minimum.
struct SizedError {
  double error = 0;
  std::size_t bytes = 0;
};
std::size_t smallest_near_best(const std::vector<SizedError>& candidates, double slack);

// Rounds to half precision and back, as a stored model would.
void round_to_half(BaselineMatrix& values);

}  // namespace nook::lab
