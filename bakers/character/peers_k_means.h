// k-means clusters of poses.
#pragma once

#include <Eigen/Dense>
#include <cstdint>

#include "character/peers_features.h"

namespace nook::bake {

struct PoseGroups {
  PeerMatrix centre;             // clusters x features
  double mean_squared_distance;  // of the poses to their nearest centre
};

// Lloyd's iterations from a k-means++ start, the best of a few starts. The same seed gives the same groups.
PoseGroups k_means(const PeerMatrix& features, Eigen::Index clusters, std::uint64_t seed);

// Squared distances: poses x clusters.
PeerMatrix squared_distances(const PeerMatrix& features, const PeerMatrix& centres);

}  // namespace nook::bake
