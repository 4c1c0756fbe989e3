// A k-d tree of points. A query takes about O(log n) time for n points, however the points are distributed.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

class PlaceTree {
 public:
  // `points` must outlive the tree.
  PlaceTree(std::span<const Vec3> points, Memory* memory);

  // Returns the distance from `at` to the nearest point, or INFINITY if no point is within `reach`.
  float nearest(Vec3 at, float reach) const;

  // Appends the points within `reach` of `at` to `out`, in no particular order. Distances are computed by
  // length().
  void find_within(Vec3 at, float reach, Vector<std::uint32_t>& out) const;

 private:
  struct Run {  // a range of order_; the middle point of the range splits it along an axis
    std::uint32_t first = 0, end = 0;
    float distance = 0;  // lower bound for the distance from the query's place to the points of the run
    std::uint32_t middle() const { return first + (end - first) / 2; }
  };
  // Runs are halved until they are empty. 40 levels are enough for any number of points.
  static constexpr std::size_t max_depth = 40;

  void divide(Run run);
  // Visits the points within `reach`, near points first. The visitor may reduce `reach` during the visit.
  template <class Visitor>
  void visit(Vec3 at, const float& reach, Visitor visitor) const;

  std::span<const Vec3> points_;
  Vector<std::uint32_t> order_;
  Vector<std::uint8_t> axis_;  // split axis of the run, stored at its middle point
};

}  // namespace nook
