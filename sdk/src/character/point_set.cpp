#include "sdk/src/character/point_set.h"

#include <algorithm>
#include <cmath>

namespace nook {

double distance(const Point3& a, const Point3& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

double spread(std::span<const Point3> points) {
  const double share = 1 / static_cast<double>(points.size());
  Point3 mean{};
  double squares = 0;
  for (const Point3& point : points)
    for (int i = 0; i < 3; ++i) mean[i] += share * point[i];
  for (const Point3& point : points) squares += share * distance(point, mean) * distance(point, mean);
  return std::sqrt(squares);
}

bool best_map(std::span<const Point3> from_points, std::span<const Point3> to_points, Affine& map) {
  Point3 from{}, to{};
  const double share = 1 / static_cast<double>(from_points.size());
  for (std::size_t v = 0; v < from_points.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      from[i] += share * from_points[v][i];
      to[i] += share * to_points[v][i];
    }
  Affine own, cross;  // 3x3 parts: sums of p p^T and of x p^T about the means
  own.m.fill(0);
  cross.m.fill(0);
  for (std::size_t v = 0; v < from_points.size(); ++v)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double p = from_points[v][j] - from[j];
        own.m[4 * i + j] += (from_points[v][i] - from[i]) * p;
        cross.m[4 * i + j] += (to_points[v][i] - to[i]) * p;
      }
  const double trace = own.m[0] + own.m[5] + own.m[10];
  if (!(determinant(own) > 1e-7 * trace * trace * trace)) return false;
  map = cross * inverse(own);
  const Point3 moved = transform(map, from[0], from[1], from[2]);
  for (int i = 0; i < 3; ++i) map.m[4 * i + 3] = to[i] - moved[i];
  return true;
}

double scale_of_similarity(const Affine& map) {
  const double scale = std::cbrt(std::abs(determinant(map)));
  double difference = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double dot = 0;
      for (int k = 0; k < 3; ++k) dot += map.m[4 * k + i] * map.m[4 * k + j];
      difference = std::max(difference, std::abs(dot - (i == j ? scale * scale : 0)));
    }
  return difference <= 0.02 * scale * scale ? scale : 0;
}

double turn_degrees(const Affine& map, double scale) {
  const double cosine = 0.5 * ((map.m[0] + map.m[5] + map.m[10]) / scale - 1);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29577951308232;
}

}  // namespace nook
