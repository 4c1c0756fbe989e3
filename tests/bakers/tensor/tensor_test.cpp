#include "tensor/tensor.h"

#include "catch.h"
#include "tensor/mode_product.h"

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

}  // namespace

TEST_CASE("unfolding puts the mode behind the row's slowest and the one before it fastest") {
  // a_{ijk} = 6 i + 2 j + k + 1, counted from 0. Columns of mode 2: (k, i); of mode 3: (i, j).
  CHECK(unfold(counted(), 0) == rows({{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}}));
  CHECK(unfold(counted(), 1) == rows({{1, 7, 2, 8}, {3, 9, 4, 10}, {5, 11, 6, 12}}));
  CHECK(unfold(counted(), 2) == rows({{1, 3, 5, 7, 9, 11}, {2, 4, 6, 8, 10, 12}}));
}
