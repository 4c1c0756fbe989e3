// Functions for the cross-validation of the baselines. They choose which poses are left out together, and
// which vertices are evaluated.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/lab/character/pose_space.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::lab {

// Each fold consists of runs of neighbouring poses. Consecutive frames of a clip are almost equal. If a fold
// left out only single poses, cross-validation would choose far too little regularisation.
struct ValidationFold {
  std::vector<Eigen::Index> fitted, left_out;
};
std::vector<ValidationFold> validation_folds(std::size_t poses, std::size_t folds = 4,
                                             std::size_t runs_a_fold = 5);

// Returns at most `count` vertices, evenly spread over the vertex order of the mesh.
std::vector<std::size_t> sample_vertices(std::size_t vertex_count, std::size_t count);

// Returns the AO of the given vertices, as a matrix of poses x vertices.
BaselineMatrix target_columns(const bake::AoTargets& targets, const std::vector<std::size_t>& vertices);
BaselineMatrix target_columns(const bake::AoTargets& targets, std::size_t first, std::size_t last);

// Clamps the predictions and returns the sum of their squared errors.
double clamped_squared_error(const BaselineMatrix& prediction, const BaselineMatrix& target);

// Returns the smallest candidate whose error is within `slack` (relative) of the minimum.
struct SizedError {
  double error = 0;
  std::size_t bytes = 0;
};
std::size_t smallest_near_best(const std::vector<SizedError>& candidates, double slack);

// Rounds the values to half precision, as if the model were stored in a file.
void round_to_half(BaselineMatrix& values);

}  // namespace nook::lab
