#include "bakers/tensor/seed_clusters.h"

#include <algorithm>
#include <set>

#include "sdk/src/core/failure.h"
#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::tensor;

TEST_CASE("separated points fall into their groups, and the same seed gives the same") {
  std::mt19937_64 bits(21);
  Matrix points(40, 2);
  for (Eigen::Index i = 0; i < 40; ++i)
    points.row(i) << 10 * float(i % 4 / 2) + test::uniform(bits), 10 * float(i % 2) + test::uniform(bits);
  const std::vector<std::uint32_t> group = seed_clusters(points, 4, 3);
  for (std::size_t i = 4; i < 40; ++i) CHECK(group[i] == group[i % 4]);
  CHECK(std::set<std::uint32_t>(group.begin(), group.end()).size() == 4);
  CHECK(seed_clusters(points, 4, 3) == group);
}

TEST_CASE("no group is empty, up to one point a group") {
  std::mt19937_64 bits(22);
  const Matrix points = test::random_matrix(30, 3, bits);
  for (const std::size_t clusters : {std::size_t(1), std::size_t(17), std::size_t(29), std::size_t(30)}) {
    const std::vector<std::uint32_t> group = seed_clusters(points, clusters);
    CHECK(std::set<std::uint32_t>(group.begin(), group.end()).size() == clusters);
  }
}

TEST_CASE("points of sub-tensors have their distances") {
  std::mt19937_64 bits(23);
  const Tensor a = test::random_tensor({5, 8, 6}, bits);
  const Matrix points = sub_tensor_points(a, 1);
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double expected =
          squared_distance(sub_tensors(a, 1, {std::size_t(i)}), sub_tensors(a, 1, {std::size_t(j)}));
      CHECK(test::near((points.row(i) - points.row(j)).squaredNorm(), expected, 1e-5));
    }
}

TEST_CASE("what cannot be grouped is refused") {
  Matrix points = Matrix::Zero(6, 2);
  points(1, 0) = 1;
  CHECK(test::says(test::failure_of([&] { seed_clusters(points, 7); }), "got 7, need 1 to 6"));
  CHECK(test::says(test::failure_of([&] { seed_clusters(points, 0); }), "got 0"));
  CHECK(test::says(test::failure_of([&] { seed_clusters(points, 3); }), "distinct"));
  CHECK(seed_clusters(points, 2)[1] != seed_clusters(points, 2)[0]);
  points(0, 1) = std::numeric_limits<float>::infinity();
  CHECK(test::says(test::failure_of([&] { seed_clusters(points, 2); }), "not finite"));
}
