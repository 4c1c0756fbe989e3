// Sets of points in space, and the map that leads from one set to another.
#pragma once

#include <array>
#include <span>

#include "sdk/src/core/affine.h"

namespace nook {

using Point3 = std::array<double, 3>;

double distance(const Point3& a, const Point3& b);

// The root mean square distance of points from their mean; 0 for no points.
double spread(std::span<const Point3> points);

// The affine map from one set to another of as many points that is best in the least-squares sense. Returns
// false where the first lie in a plane.
bool best_map(std::span<const Point3> from, std::span<const Point3> to, Affine& map);

// The scale of a map that is a similarity, mirrored or not, to 1 %; else 0.
double scale_of_similarity(const Affine& map);

// The turn of a similarity of a known scale, degrees.
double turn_degrees(const Affine& map, double scale);

}  // namespace nook
