#include "sdk/src/material/direction_mesh.h"

#include <algorithm>
#include <cmath>

namespace nook::material {
namespace {

// Measured directions often lie in rings. Then many points are on one circle or line, and their Delaunay
// triangulation is not unique. To make it unique, each point is moved by up to this distance. The move is
// deterministic. The distance is far below the minimum distance of two directions and far above rounding
// errors.
constexpr double jitter = 1e-7;
double jittered(float value, std::uint32_t number) {
  const std::uint32_t hash = (number + 1) * 2654435761u;
  return double(value) + jitter * (double(hash >> 8) / 8388608.0 - 1);
}

// The triangulation starts with one large triangle around all points. The corners of this triangle are this
// far away. With such distant corners, the border of the mesh is nearly convex. The small gaps that remain at
// the border are treated as outside.
constexpr double far_away = 1e3;

template <class Point>
double cross(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

DirectionMesh::DirectionMesh(std::span<const Vec3> directions, Memory* memory)
    : points_(memory), triangles_(memory), border_(memory), cavity_(memory) {
  points_.reserve(directions.size() + 3);
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    const ParabolicPoint p = to_parabolic(directions[i]);
    points_.push_back({jittered(p.x, 2 * i), jittered(p.y, 2 * i + 1)});
  }
  if (directions.size() >= 3) triangulate(directions.size());
  find_border();
}

// Uses the Bowyer-Watson algorithm. To insert a point, it removes all triangles whose circumcircle contains
// the point. Then it fills the hole with triangles that have the new point as a corner.
void DirectionMesh::triangulate(std::size_t directions) {
  const auto count = static_cast<std::uint16_t>(directions);
  points_.push_back({-far_away, -far_away});
  points_.push_back({far_away, -far_away});
  points_.push_back({0, far_away});
  triangles_.push_back({count, std::uint16_t(count + 1), std::uint16_t(count + 2)});
  for (std::uint16_t i = 0; i < count; ++i) insert(i);
  std::erase_if(triangles_,
                [&](const Triangle& t) { return *std::max_element(t.begin(), t.end()) >= count; });
  points_.resize(directions);
}

void DirectionMesh::insert(std::uint16_t point) {
  cavity_.clear();
  std::erase_if(triangles_, [&](const Triangle& t) {
    if (!circle_holds(t, points_[point])) return false;
    for (int i = 0; i < 3; ++i) cavity_.push_back({t[i], t[(i + 1) % 3]});
    return true;
  });
  for (const Edge& edge : cavity_)
    if (std::find(cavity_.begin(), cavity_.end(), Edge{edge[1], edge[0]}) == cavity_.end())
      triangles_.push_back({edge[0], edge[1], point});
}

void DirectionMesh::find_border() {
  cavity_.clear();
  for (const Triangle& t : triangles_)
    for (int i = 0; i < 3; ++i) cavity_.push_back({t[i], t[(i + 1) % 3]});
  for (const Edge& edge : cavity_)
    if (std::find(cavity_.begin(), cavity_.end(), Edge{edge[1], edge[0]}) == cavity_.end())
      border_.push_back(edge);
  if (!triangles_.empty()) return;
  // There are only one or two directions, or all directions lie on a line.
  const std::size_t last = points_.size() - 1;
  for (std::size_t i = 0; i < std::max<std::size_t>(last, 1); ++i)
    border_.push_back({std::uint16_t(i), std::uint16_t(std::min(i + 1, last))});
}

bool DirectionMesh::circle_holds(const Triangle& t, const Point& p) const {
  double m[3][3];
  for (int i = 0; i < 3; ++i) {
    m[i][0] = points_[t[i]].x - p.x;
    m[i][1] = points_[t[i]].y - p.y;
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) >
         0;
}

bool DirectionMesh::weights_in(const Triangle& t, const Point& p, std::array<double, 3>& weight) const {
  const Point &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
  const double area = cross(a, b, c);
  weight = {cross(b, c, p) / area, cross(c, a, p) / area, cross(a, b, p) / area};
  return weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0;
}

DirectionMix DirectionMesh::locate(ParabolicPoint at, std::size_t& hint) const {
  const Point p{at.x, at.y};
  std::array<double, 3> weight{};
  for (std::size_t tried = 0; tried < triangles_.size(); ++tried) {
    // Tries triangle `hint` first, then all other triangles in order.
    const std::size_t candidate =
        tried == 0 ? std::min(hint, triangles_.size() - 1) : tried - (tried <= hint);
    if (!weights_in(triangles_[candidate], p, weight)) continue;
    hint = candidate;
    return {triangles_[candidate], {float(weight[0]), float(weight[1]), float(weight[2])}};
  }
  DirectionMix nearest;
  double least = INFINITY;
  for (const Edge& edge : border_) {
    const Point &a = points_[edge[0]], &b = points_[edge[1]];
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const double along = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
    const double t = std::clamp(along, 0.0, 1.0);
    const double away = std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
    if (away >= least) continue;
    least = away;
    nearest = {{edge[0], edge[1], edge[1]}, {float(1 - t), float(t), 0}};
  }
  return nearest;
}

}  // namespace nook::material
