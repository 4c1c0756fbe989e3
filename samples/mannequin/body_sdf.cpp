#include "samples/mannequin/body_sdf.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nook_samples::mannequin {
namespace {

// Distances of lofts and ellipsoids are estimates that may fall short of the truth; bounds allow for that.
constexpr double kBoundSafety = 0.5;

bool out_of_reach(const Vec3& point_m, const Vec3& centre_m, double radius_m, double limit_m) {
  return (glm::length(point_m - centre_m) - radius_m) * kBoundSafety > limit_m;
}

void bound(Mass& mass) {
  if (const auto* cone = std::get_if<RoundCone>(&mass.shape)) {
    mass.bound_centre_m = (cone->start_m + cone->end_m) * 0.5;
    mass.bound_radius_m =
        0.5 * glm::length(cone->end_m - cone->start_m) + std::max(cone->start_radius_m, cone->end_radius_m);
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&mass.shape)) {
    mass.bound_centre_m = ellipsoid->centre_m;
    mass.bound_radius_m = std::max({ellipsoid->radii_m.x, ellipsoid->radii_m.y, ellipsoid->radii_m.z});
  } else {
    const Loft& loft = std::get<Loft>(mass.shape);
    mass.bound_centre_m = loft.bound_centre_m();
    mass.bound_radius_m = loft.bound_radius_m();
  }
}

Mass bounded(Mass mass) {
  bound(mass);
  return mass;
}

}  // namespace

void Part::add(const RoundCone& cone, double blend_m) {
  masses_.push_back(bounded({cone, blend_m}));
}

void Part::add(const Ellipsoid& ellipsoid, double blend_m) {
  masses_.push_back(bounded({ellipsoid, blend_m}));
}

void Part::add(Loft loft, double blend_m) {
  masses_.push_back(bounded({std::move(loft), blend_m}));
}

void Part::carve(const RoundCone& cone, double blend_m) {
  masses_.push_back(bounded({cone, blend_m, true}));
}

void Part::carve(const Ellipsoid& ellipsoid, double blend_m) {
  masses_.push_back(bounded({ellipsoid, blend_m, true}));
}

void Part::close() {
  bound_centre_m_ = Vec3(0.0);
  for (const Mass& mass : masses_) {
    bound_centre_m_ += mass.bound_centre_m / static_cast<double>(masses_.size());
  }
  for (const Mass& mass : masses_) {
    if (!mass.carved) {
      bound_radius_m_ =
          std::max(bound_radius_m_, glm::length(mass.bound_centre_m - bound_centre_m_) + mass.bound_radius_m);
    }
  }
}

double Part::distance(const Vec3& point_m) const {
  double result = std::numeric_limits<double>::max();
  for (const Mass& mass : masses_) {
    const double limit = mass.carved ? mass.blend_m - std::min(result, mass.blend_m) : result + mass.blend_m;
    if (out_of_reach(point_m, mass.bound_centre_m, mass.bound_radius_m, limit)) {
      continue;
    }
    const double d = std::visit([&](const auto& shape) { return shape.distance(point_m); }, mass.shape);
    result = mass.carved ? smooth_subtract(result, d, mass.blend_m) : smooth_min(result, d, mass.blend_m);
  }
  return result;
}

double Part::join(double known_m, const Vec3& point_m) const {
  if (out_of_reach(point_m, bound_centre_m_, bound_radius_m_, known_m + blend_m_)) {
    return known_m;
  }
  return smooth_min(known_m, distance(point_m), blend_m_);
}

BodySdf::BodySdf() {
  parts_ = {make_torso(), make_head(), make_leg(), make_foot(), make_arm(), make_hand()};
  for (Part& part : parts_) {
    part.close();
  }
}

double BodySdf::distance(const Vec3& point_m) const {
  // The rounded mirror keeps the seam between the halves smooth.
  constexpr double kSeam_m = 0.004;
  const Vec3 folded(std::sqrt(point_m.x * point_m.x + kSeam_m * kSeam_m), point_m.y, point_m.z);
  double result = 10.0;
  for (const Part& part : parts_) {
    result = part.join(result, folded);
  }
  return result;
}

Vec3 BodySdf::gradient(const Vec3& point_m) const {
  constexpr double kStep_m = 2e-4;
  const Vec3 a(1, -1, -1), b(-1, -1, 1), c(-1, 1, -1), d(1, 1, 1);
  return (a * distance(point_m + a * kStep_m) + b * distance(point_m + b * kStep_m) +
          c * distance(point_m + c * kStep_m) + d * distance(point_m + d * kStep_m)) /
         (4.0 * kStep_m);
}

Vec3 BodySdf::project(const Vec3& point_m) const {
  Vec3 p = point_m;
  for (int step = 0; step < 4; ++step) {
    const double d = distance(p);
    if (std::abs(d) < 2e-5) {
      break;
    }
    const Vec3 g = gradient(p);
    const Vec3 move = g * (d / std::max(glm::dot(g, g), 0.05));
    // A bounded step keeps a point from jumping to another finger.
    constexpr double kLongest_m = 0.004;
    p -= move * std::min(1.0, kLongest_m / std::max(glm::length(move), 1e-12));
  }
  return p;
}

}  // namespace nook_samples::mannequin
