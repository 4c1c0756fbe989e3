#include "bakers/material/view_spline.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "bakers/tensor/blocks.h"
#include "sdk/src/material/parabolic.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using nook::material::ParabolicPoint;

double radial(ParabolicPoint a, ParabolicPoint b) {
  const double dx = double(a.x) - double(b.x), dy = double(a.y) - double(b.y), square = dx * dx + dy * dy;
  return square > 0 ? square * std::log(square) : 0;
}

// Returns the number of terms of the linear part of the spline. The full linear part needs points that span a
// plane.
Index linear_terms(std::size_t points) {
  return points >= 3 ? 3 : 1;
}

void set_linear(Eigen::VectorXd& row, Index first, ParabolicPoint p, Index terms) {
  const double values[] = {1, double(p.x), double(p.y)};
  for (Index t = 0; t < terms; ++t) row[first + t] = values[t];
}

}  // namespace

tensor::Matrix spline_weights(const std::vector<Vec3>& views, const std::vector<Vec3>& directions) {
  std::vector<ParabolicPoint> points;
  float rim = 0;
  for (const Vec3 v : views) {
    points.push_back(nook::material::to_parabolic(v));
    rim = std::max(rim, std::hypot(points.back().x, points.back().y));
  }
  // [K P; P^T 0] maps spline coefficients to values at the views. The inverse of this matrix maps values at
  // the views to spline coefficients. A row of weights is a row of the spline basis times the first n columns
  // of the inverse, which belong to the values.
  const auto n = Index(views.size()), terms = linear_terms(views.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + terms, n + terms);
  for (Index i = 0; i < n; ++i) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n + terms);
    for (Index k = 0; k < n; ++k) row[k] = radial(points[std::size_t(i)], points[std::size_t(k)]);
    set_linear(row, n, points[std::size_t(i)], terms);
    system.row(i) = row;
    system.block(n, i, terms, 1) = row.tail(terms);
  }
  const Eigen::MatrixXd inverse = system.fullPivLu().inverse();
  tensor::Matrix weights(Index(directions.size()), n);
  tensor::for_each_block(directions.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      ParabolicPoint p = nook::material::to_parabolic(directions[j]);
      const float radius = std::hypot(p.x, p.y);
      if (radius > rim) p = {p.x * rim / radius, p.y * rim / radius};
      Eigen::VectorXd row(n + terms);
      for (Index k = 0; k < n; ++k) row[k] = radial(p, points[std::size_t(k)]);
      set_linear(row, n, p, terms);
      weights.row(Index(j)) = (row.transpose() * inverse.leftCols(n)).cast<float>();
    }
  });
  return weights;
}

tensor::Matrix spline_weights(const std::vector<Vec3>& views, std::uint32_t side) {
  std::vector<Vec3> directions;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column)
      directions.push_back(nook::material::from_parabolic(nook::material::cell_centre(column, row, side)));
  return spline_weights(views, directions);
}

}  // namespace nook::bake::material
