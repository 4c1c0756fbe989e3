#include "bakers/tensor/tensor.h"

#include <limits>

#include "bakers/tensor/gram.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::tensor;

namespace {

// 2 x 3 x 2, entries 1 to 12 in row-major order.
Tensor counted() {
  Tensor a({2, 3, 2});
  for (std::size_t e = 0; e < 12; ++e) a.data[e] = float(e + 1);
  return a;
}

Matrix rows(std::initializer_list<std::initializer_list<float>> entries) {
  return Matrix(entries);
}

// Products and sums of a few hundred floats below 1.
constexpr double rounding = 1e-4;

}  // namespace

TEST_CASE("unfolding puts the mode behind the row's slowest and the one before it fastest") {
  // a_ijk = 6 i + 2 j + k + 1, counted from 0. Columns of mode 2: (k, i); of mode 3: (i, j).
  CHECK(unfold(counted(), 0) == rows({{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}}));
  CHECK(unfold(counted(), 1) == rows({{1, 7, 2, 8}, {3, 9, 4, 10}, {5, 11, 6, 12}}));
  CHECK(unfold(counted(), 2) == rows({{1, 3, 5, 7, 9, 11}, {2, 4, 6, 8, 10, 12}}));
  for (std::size_t n = 0; n < 3; ++n) CHECK(fold(unfold(counted(), n), {2, 3, 2}, n).data == counted().data);
}

TEST_CASE("sub-tensors are joined in the given order") {
  const Tensor joined = sub_tensors(counted(), 1, {2, 0});
  CHECK(joined.dimensions == Dimensions{2, 2, 2});
  CHECK(joined.data == std::vector<float>{5, 6, 1, 2, 11, 12, 7, 8});
}

TEST_CASE("norms and scalar products by hand") {
  Tensor twos({2, 3, 2});
  std::fill(twos.data.begin(), twos.data.end(), 2.0f);
  CHECK(scalar_product(counted(), twos) == 156);    // 2 (1 + ... + 12)
  CHECK(squared_norm(counted()) == 650);            // 12 * 13 * 25 / 6
  CHECK(squared_distance(counted(), twos) == 386);  // 650 - 2 * 156 + 12 * 4
  CHECK_THROWS_AS(scalar_product(counted(), Tensor({2, 2, 3})), Failure);
}

TEST_CASE("a mode product by hand") {
  const Tensor b = mode_product(counted(), 1, rows({{1, 0, -1}, {1, 1, 1}}));
  CHECK(b.dimensions == Dimensions{2, 2, 2});
  CHECK(b.data == std::vector<float>{-4, -4, 9, 12, -4, -4, 27, 30});
  CHECK(mode_product(counted(), 0, rows({{1, 1}})).data == std::vector<float>{8, 10, 12, 14, 16, 18});
  CHECK(mode_product(counted(), 2, rows({{1, 1}})).data == std::vector<float>{3, 7, 11, 15, 19, 23});
}

TEST_CASE("mode products in unfoldings: uf_n(A x_n U) = U uf_n(A), and uf_n(A x U) = U_n uf_n(A) (x) U^T") {
  std::mt19937_64 bits(1);
  const Tensor a = test::random_tensor({4, 5, 3, 6}, bits);
  std::vector<Matrix> u;
  for (std::size_t n = 0; n < 4; ++n) u.push_back(test::random_matrix(n + 2, a.dimensions[n], bits));
  for (std::size_t n = 0; n < 4; ++n) {
    CHECK((unfold(mode_product(a, n, u[n]), n) - u[n] * unfold(a, n)).norm() < rounding);
    // Columns of the unfolding run over modes n + 1 to N, then 1 to n - 1, the first the slowest.
    Matrix kronecker = Matrix::Ones(1, 1);
    for (std::size_t k = 1; k < 4; ++k) {
      const Matrix& right = u[(n + k) % 4];
      Matrix wider(kronecker.rows() * right.rows(), kronecker.cols() * right.cols());
      for (Eigen::Index r = 0; r < kronecker.rows(); ++r)
        for (Eigen::Index c = 0; c < kronecker.cols(); ++c)
          wider.block(r * right.rows(), c * right.cols(), right.rows(), right.cols()) =
              kronecker(r, c) * right;
      kronecker = wider;
    }
    const Matrix expected = u[n] * unfold(a, n) * kronecker.transpose();
    CHECK((unfold(mode_products(a, u), n) - expected).norm() < rounding * expected.norm());
  }
}

TEST_CASE("products of different modes commute, whatever shrinks most, and empty matrices are identities") {
  std::mt19937_64 bits(2);
  const Tensor a = test::random_tensor({6, 5, 7}, bits);
  const Matrix u = test::random_matrix(2, 6, bits), v = test::random_matrix(9, 5, bits),
               w = test::random_matrix(3, 7, bits);
  const Tensor one = mode_product(mode_product(mode_product(a, 2, w), 1, v), 0, u);
  const Tensor all = mode_products(a, {u, v, w});
  CHECK(all.dimensions == Dimensions{2, 9, 3});
  CHECK(squared_distance(all, one) < rounding * rounding);
  CHECK(squared_distance(mode_products(a, {Matrix(), v, Matrix()}), mode_product(a, 1, v)) == 0);
  CHECK(squared_distance(mode_products(a, std::vector<Matrix>(3)), a) == 0);
  CHECK(test::says(test::failure_of([&] { mode_product(a, 1, u); }), "6 columns does not fit mode 2"));
}

TEST_CASE("Gram matrices are the inner products of sub-tensors, in every mode") {
  std::mt19937_64 bits(3);
  // Larger than a block of columns in each layout: the mode first, within, last.
  const Tensor a = test::random_tensor({7, 5, 1100}, bits), b = test::random_tensor({7, 3, 1100}, bits);
  for (std::size_t n = 0; n < 3; ++n) {
    const Eigen::MatrixXd exact = unfold(a, n).cast<double>() * unfold(a, n).cast<double>().transpose();
    CHECK((gram(a, n) - exact).norm() < 1e-6 * exact.norm());  // float products: 6e-8 each
  }
  const Eigen::MatrixXd exact = unfold(a, 1).cast<double>() * unfold(b, 1).cast<double>().transpose();
  CHECK((cross_gram(a, b, 1) - exact).norm() < 1e-6 * unfold(a, 1).norm() * unfold(b, 1).norm());
  CHECK_THROWS_AS(cross_gram(a, b, 0), Failure);
}

TEST_CASE("a bad tensor is refused by the name of its fault") {
  Tensor a = counted();
  CHECK_NOTHROW(check_tensor(a));
  a.data[9] = std::numeric_limits<float>::quiet_NaN();  // i = 1, j = 1, k = 1
  {
    const std::string message = test::failure_of([&] { check_tensor(a); });
    CHECK(test::says(message, "(1, 1, 1)"));
    CHECK(test::says(message, "not finite"));
  }
  a.data[9] = -std::numeric_limits<float>::infinity();
  CHECK(test::says(test::failure_of([&] { check_tensor(a); }), "(1, 1, 1)"));
  {
    const std::string message = test::failure_of([&] { check_tensor(Tensor({2, 0, 2})); });
    CHECK(test::says(message, "mode 2"));
    CHECK(test::says(message, "size 0"));
  }
  CHECK(test::says(test::failure_of([&] { check_tensor(Tensor()); }), "empty"));
}
