#include "sdk/src/character/place_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nook {
namespace {

float coordinate(Vec3 p, std::uint8_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// Because of rounding, the computed length of a vector may be smaller than its largest coordinate.
constexpr float rounding = 1 + 1e-6f;

}  // namespace

PlaceTree::PlaceTree(std::span<const Vec3> points, Memory* memory)
    : points_(points), order_(memory), axis_(points.size(), std::uint8_t{0}, memory) {
  order_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) order_.push_back(i);
  divide({0, static_cast<std::uint32_t>(points.size())});
}

void PlaceTree::divide(Run run) {
  if (run.end - run.first < 2) return;
  Vec3 low = points_[order_[run.first]], high = low;
  for (std::uint32_t i = run.first; i < run.end; ++i) {
    const Vec3 p = points_[order_[i]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low;
  const std::uint8_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = run.middle();
  axis_[middle] = axis;
  std::nth_element(order_.begin() + run.first, order_.begin() + middle, order_.begin() + run.end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return coordinate(points_[a], axis) < coordinate(points_[b], axis);
                   });
  divide({run.first, middle});
  divide({middle + 1, run.end});
}

template <class Visitor>
void PlaceTree::visit(Vec3 at, const float& reach, Visitor visitor) const {
  std::array<Run, max_depth> left;
  std::size_t count = 0;
  left[count++] = {0, static_cast<std::uint32_t>(order_.size())};
  while (count > 0) {
    Run run = left[--count];
    while (run.first < run.end && run.distance <= reach * rounding) {
      const std::uint32_t middle = run.middle(), point = order_[middle];
      visitor(point, length(points_[point] - at));
      const float beyond = coordinate(at, axis_[middle]) - coordinate(points_[point], axis_[middle]);
      Run near{run.first, middle, run.distance}, far{middle + 1, run.end, std::abs(beyond)};
      if (beyond > 0) {
        near = {middle + 1, run.end, run.distance};
        far = {run.first, middle, std::abs(beyond)};
      }
      left[count++] = far;
      run = near;
    }
  }
}

float PlaceTree::nearest(Vec3 at, float reach) const {
  float found = INFINITY;
  visit(at, reach, [&](std::uint32_t, float distance) {
    if (distance > reach) return;
    reach = found = distance;
  });
  return found;
}

void PlaceTree::find_within(Vec3 at, float reach, Vector<std::uint32_t>& out) const {
  visit(at, reach, [&](std::uint32_t point, float distance) {
    if (distance <= reach) out.push_back(point);
  });
}

}  // namespace nook
