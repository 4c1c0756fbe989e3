// A k-d tree of points. A query costs about O(log n) for n points, for any distribution of the points.
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
    float distance = 0;  // lower bound of the distance to any point of the run
    std::uint32_t middle() const { return first + (end - first) / 2; }
  };
  // The tree halves runs until they are empty.
  static constexpr std::size_t max_depth = 40;

  void divide(Run run);
  // Visits the points within `reach`, near points first. The visitor may reduce `reach` on the way.
  template <class Visitor>
  void visit(Vec3 at, const float& reach, Visitor visitor) const;

  std::span<const Vec3> points_;
  Vector<std::uint32_t> order_;
  Vector<std::uint8_t> axis_;  // split axis of the run, stored at its middle point
};

}  // namespace nook
