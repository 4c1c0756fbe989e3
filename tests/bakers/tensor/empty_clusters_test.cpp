#include "bakers/tensor/cta_stages.h"

#include <set>

#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook::bake::tensor;

TEST_CASE("an empty cluster takes the worse half of the worst cluster") {
  // Sums of errors: cluster 0 6, cluster 1 11, cluster 3 5; cluster 2 is empty.
  std::vector<std::uint32_t> membership{0, 0, 1, 1, 1, 1, 3};
  const std::vector<double> error{3, 3, 1, 5, 4, 1, 5};
  const std::vector<std::size_t> changed = split_into_empty(membership, 1, 4, error);
  CHECK(changed == std::vector<std::size_t>{3, 4});
  CHECK(membership == std::vector<std::uint32_t>{0, 0, 1, 2, 2, 1, 3});
}

TEST_CASE("several empty clusters are filled one after the other, and memberships of a row stay different") {
  std::vector<std::uint32_t> membership{0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1};  // K = 2, clusters 2 to 4 empty
  const std::vector<double> error{1, 2, 3, 4, 5, 6};
  split_into_empty(membership, 2, 5, error);
  CHECK(std::set<std::uint32_t>(membership.begin(), membership.end()).size() == 5);
  for (std::size_t i = 0; i < 6; ++i) CHECK(membership[2 * i] != membership[2 * i + 1]);
}

TEST_CASE("clusters of one member are never split") {
  std::vector<std::uint32_t> membership{0, 1};
  CHECK(split_into_empty(membership, 1, 3, {1, 1}).empty());
  CHECK(membership == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a clustering stage that leaves a cluster empty splits another, and the update stage fits it") {
  // Cluster 2 begins with atoms that no sub-tensor holds anything of.
  for (const std::size_t mixture : {std::size_t(1), std::size_t(2)}) {
    Tensor a = test::planted_clusters({3, 20, 6, 6}, {3, 2, 3, 3}, 1, 5, 1, 41).a;
    ClusteredSettings settings;
    settings.mode = 1;
    settings.ranks = {3, 2, 3, 3};
    settings.clusters = 4;
    settings.mixture = mixture;
    for (std::uint32_t i = 0; i < 20; ++i) settings.seeds.push_back(i % 4);
    WorkingFit fit;
    fit_seeds(fit, a, settings, {});
    std::fill(fit.clusters[2].parts.core.data.begin(), fit.clusters[2].parts.core.data.end(), 0.0f);

    Tensor residual;
    CHECK(clustering_stage(fit, a, settings, residual) == 1);
    for (const WorkingCluster& cluster : fit.clusters) CHECK_FALSE(cluster.members.empty());
    CHECK_FALSE(fit.clusters[2].fitted);
    // The residual belongs to what the clusters hold now.
    Tensor left = a;
    const auto subtract_parts = [&](Tensor& from) {
      for (const WorkingCluster& cluster : fit.clusters) {
        Matrix rows = Matrix::Zero(20, 2);
        for (std::size_t r = 0; r < cluster.members.size(); ++r)
          rows.row(Eigen::Index(cluster.members[r])) = cluster.mixing.row(Eigen::Index(r));
        std::vector<Matrix> bases = cluster.parts.basis;
        bases[1] = rows;
        const Tensor part = mode_products(cluster.parts.core, bases);
        for (std::size_t e = 0; e < from.data.size(); ++e) from.data[e] -= part.data[e];
      }
    };
    subtract_parts(left);
    CHECK(squared_distance(left, residual) < 1e-10 * squared_norm(a));  // floats

    const double before = squared_norm(residual);
    update_stage(fit, residual, settings, {}, 1, 0);
    CHECK(fit.clusters[2].fitted);
    CHECK(squared_norm(fit.clusters[2].parts.core) > 0);
    CHECK(squared_norm(residual) < before);
    left = a;
    subtract_parts(left);
    CHECK(squared_distance(left, residual) < 1e-10 * squared_norm(a));
  }
}
