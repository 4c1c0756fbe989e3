// k-means clusters of poses.
#pragma once

#include <Eigen/Dense>
#include <cstdint>

#include "bakers/measure/character/baseline_features.h"

namespace nook::bake {

struct PoseGroups {
  BaselineMatrix centre;         // clusters x features
  double mean_squared_distance;  // of the poses to their nearest centre
};

// Lloyd's iterations from a k-means++ start, the best of a few starts. The same seed gives the same groups.
PoseGroups k_means(const BaselineMatrix& features, Eigen::Index clusters, std::uint64_t seed);

// Squared distances: poses x clusters.
BaselineMatrix squared_distances(const BaselineMatrix& features, const BaselineMatrix& centres);

}  // namespace nook::bake
