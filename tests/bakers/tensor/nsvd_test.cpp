#include "bakers/tensor/nsvd.h"

#include <tbb/global_control.h>

#include <Eigen/SVD>
#include <limits>

#include "bakers/tensor/gram.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::tensor;

namespace {

void check_orthonormal(const Matrix& u) {
  const Matrix identity = Matrix::Identity(u.cols(), u.cols());
  CHECK((u.transpose() * u - identity).norm() < 1e-5);  // vectors rounded to floats
}

Tensor planted(const Dimensions& dimensions, const std::vector<std::size_t>& ranks) {
  return test::planted_clusters(dimensions, ranks, 0, 1, 1, 7).a;
}

}  // namespace

TEST_CASE("a tensor of known ranks is recovered") {
  const Tensor a = planted({12, 9, 10, 8}, {3, 4, 2, 5});
  const Nsvd fit = fit_nsvd(a, {{3, 4, 2, 5}});
  CHECK(fit.core.dimensions == Dimensions{3, 4, 2, 5});
  for (const Matrix& u : fit.basis) check_orthonormal(u);
  // Floats: a relative error of 1e-6 and less, squared.
  CHECK(squared_distance(reconstruct(fit), a) < 1e-12 * squared_norm(a));
}

TEST_CASE("of a matrix, N-SVD is the truncated singular value decomposition") {
  std::mt19937_64 bits(5);
  const Tensor a = test::random_tensor({20, 30}, bits);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(unfold(a, 0).cast<double>());
  const double best = svd.singularValues().tail(20 - 6).squaredNorm();  // Eckart and Young
  const Nsvd fit = fit_nsvd(a, {{6, 6}});
  CHECK(test::near(fit.objective.back(), best, 1e-5));
  CHECK(test::near(squared_distance(reconstruct(fit), a), best, 1e-5));
}

TEST_CASE("the objective is the squared error, and falls from the HOSVD's") {
  std::mt19937_64 bits(6);
  const Tensor a = test::random_tensor({10, 11, 12}, bits);
  const Nsvd start = fit_nsvd(a, {{3, 3, 3}, 0}), fit = fit_nsvd(a, {{3, 3, 3}, 30, 1e-6});
  REQUIRE(fit.objective.size() > 2);
  CHECK(fit.objective.front() == start.objective.back());
  for (std::size_t s = 1; s < fit.objective.size(); ++s) CHECK(fit.objective[s] <= fit.objective[s - 1]);
  CHECK(fit.objective.back() < 0.999 * fit.objective.front());
  CHECK(test::near(squared_distance(reconstruct(fit), a), fit.objective.back(), 1e-5));
}

TEST_CASE("modes of full rank keep the identity") {
  const Tensor a = planted({6, 9, 7}, {6, 2, 7});
  const Nsvd fit = fit_nsvd(a, {{6, 2, 7}});
  CHECK(fit.basis[0].size() == 0);
  CHECK(fit.basis[2].size() == 0);
  CHECK(squared_distance(reconstruct(fit), a) < 1e-12 * squared_norm(a));
  CHECK(squared_distance(reconstruct(fit_nsvd(a, {{6, 9, 7}})), a) == 0);
}

TEST_CASE("an N-SVD has the same bits on one thread and on three") {
  std::mt19937_64 bits(8);
  const Tensor a = test::random_tensor({9, 40, 33}, bits);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return fit_nsvd(a, {{3, 8, 5}});
  };
  const Nsvd one = with_threads(1), three = with_threads(3);
  CHECK(one.core.data == three.core.data);
  CHECK(one.basis[1] == three.basis[1]);
  CHECK(one.objective == three.objective);
}

TEST_CASE("ranks by threshold are the smallest multiples that keep the error") {
  const Tensor a = planted({12, 16, 10}, {3, 5, 4});
  CHECK(ranks_for_error(a, {1e-5, 1e-5, 1e-5}, 1) == std::vector<std::size_t>{3, 5, 4});
  CHECK(ranks_for_error(a, {1e-5, 1e-5, 1e-5}, 4) == std::vector<std::size_t>{4, 8, 4});
  CHECK(ranks_for_error(a, {1e-5, 1e-5, 1e-5}, 12) == std::vector<std::size_t>{12, 12, 10});
  // A share that needs fewer: the rank found keeps to it, one less does not.
  const std::size_t rank = ranks_for_error(a, {0, 0.3, 0}, 1)[1];
  const auto share = [&](std::size_t r) {
    return fit_nsvd(a, {{12, r, 10}}).objective.back() / squared_norm(a);
  };
  REQUIRE(rank > 1);
  CHECK(share(rank) <= 0.3);
  CHECK(share(rank - 1) > 0.3);
}

TEST_CASE("ranks that do not fit are refused, and progress can stop it") {
  std::mt19937_64 bits(9);
  Tensor a = test::random_tensor({4, 5, 6}, bits);
  {
    const std::string message = test::failure_of([&] { fit_nsvd(a, {{4, 7, 6}}); });
    CHECK(test::says(message, "mode 2"));
    CHECK(test::says(message, "got 7, need 1 to 5"));
  }
  CHECK(test::says(test::failure_of([&] { fit_nsvd(a, {{0, 5, 6}}); }), "mode 1"));
  CHECK(test::says(test::failure_of([&] { fit_nsvd(a, {{4, 5}}); }), "2 ranks"));
  CHECK(test::says(test::failure_of([&] { fit_nsvd(a, {{4, 5, 6}, -1}); }), "-1"));
  CHECK(test::says(test::failure_of([&] {
                     fit_nsvd(a, {{2, 2, 2}, 3, std::numeric_limits<double>::quiet_NaN()});
                   }),
                   "tolerance"));
  std::vector<std::pair<int, std::size_t>> seen;
  try {
    fit_nsvd(a, {{2, 5, 2}}, [&](const NsvdProgress& now) {
      seen.emplace_back(now.sweep, now.mode);
      CHECK((now.objective > 0) == (now.sweep > 0));
      return now.sweep < 1;
    });
    FAIL("was not stopped");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_CANCELLED);
  }
  CHECK(seen == std::vector<std::pair<int, std::size_t>>{{0, 0}, {0, 2}, {1, 0}});
  a.data[0] = std::numeric_limits<float>::quiet_NaN();
  CHECK(test::says(test::failure_of([&] { fit_nsvd(a, {{2, 2, 2}}); }), "(0, 0, 0)"));
}
