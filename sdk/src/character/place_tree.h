// A k-d tree of points: a query costs about the logarithm of their number, wherever they lie.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

class PlaceTree {
 public:
  // The points outlive the tree.
  PlaceTree(std::span<const Vec3> points, Memory* memory);

  // The distance from `at` to the nearest point, or INFINITY if none is within `reach`.
  float nearest(Vec3 at, float reach) const;

  // Appends the points within `reach` of `at`, as length() gives their distances, in no order.
  void find_within(Vec3 at, float reach, Vector<std::uint32_t>& out) const;

 private:
  struct Run {  // of order_; its middle point divides it along an axis
    std::uint32_t first = 0, end = 0;
    float distance = 0;  // no point of the run is nearer
    std::uint32_t middle() const { return first + (end - first) / 2; }
  };
  // A run is halved until nothing is left.
  static constexpr std::size_t max_depth = 40;

  void divide(Run run);
  // Visits points, near ones first, without those beyond `reach`, which the visitor may lessen.
  template <class Visitor>
  void visit(Vec3 at, const float& reach, Visitor visitor) const;

  std::span<const Vec3> points_;
  Vector<std::uint32_t> order_;
  Vector<std::uint8_t> axis_;  // of the middle point of each run
};

}  // namespace nook
