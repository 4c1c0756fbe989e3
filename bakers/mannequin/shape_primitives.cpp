#include "bakers/mannequin/shape_primitives.h"

#include <algorithm>
#include <cmath>

namespace nook::mannequin {

double smooth_min(double a_m, double b_m, double blend_m) {
  const double nearness = std::max(blend_m - std::abs(a_m - b_m), 0.0) / blend_m;
  return std::min(a_m, b_m) - nearness * nearness * blend_m * 0.25;
}

double smooth_subtract(double a_m, double b_m, double blend_m) {
  return -smooth_min(-a_m, b_m, blend_m);
}

double RoundCone::distance(const Vec3& point_m) const {
  // The cone that touches both end spheres divides space into three regions: two caps, and the cone between
  // them.
  const Vec3 axis = end_m - start_m;
  const double length2 = glm::dot(axis, axis);
  const double shrink = start_radius_m - end_radius_m;
  const double slant2 = length2 - shrink * shrink;
  const Vec3 offset = point_m - start_m;
  const double along = glm::dot(offset, axis);
  const double beyond = along - length2;
  const Vec3 across = offset * length2 - axis * along;
  const double across2 = glm::dot(across, across);
  const double along2 = along * along * length2;
  const double beyond2 = beyond * beyond * length2;
  const double side = (shrink > 0.0 ? 1.0 : -1.0) * shrink * shrink * across2;
  if ((beyond > 0.0 ? 1.0 : -1.0) * slant2 * beyond2 > side) {
    return std::sqrt(across2 + beyond2) / length2 - end_radius_m;
  }
  if ((along > 0.0 ? 1.0 : -1.0) * slant2 * along2 < side) {
    return std::sqrt(across2 + along2) / length2 - start_radius_m;
  }
  return (std::sqrt(across2 * slant2 / length2) + along * shrink) / length2 - start_radius_m;
}

double Ellipsoid::distance(const Vec3& point_m) const {
  const Vec3 local = (point_m - centre_m) * axes;
  const Vec3 scaled = local / radii_m;
  const double level = glm::length(scaled);
  const double slope = glm::length(scaled / radii_m);
  if (slope < 1e-9) {
    return -std::min({radii_m.x, radii_m.y, radii_m.z});
  }
  return level * (level - 1.0) / slope;
}

Loft::Loft(const Vec3& origin_m, const Vec3& u, const Vec3& v, const Vec3& w,
           std::vector<LoftSection> sections, double cap_m, double squareness)
    : origin_m_(origin_m), u_(u), v_(v), w_(w), cap_m_(cap_m), squareness_(squareness) {
  std::sort(sections.begin(), sections.end(),
            [](const LoftSection& a, const LoftSection& b) { return a.along_m < b.along_m; });
  for (const LoftSection& s : sections) {
    along_m_.push_back(s.along_m);
    values_m_.push_back({s.centre_u_m, s.centre_v_m, s.plus_u_m, s.minus_u_m, s.plus_v_m, s.minus_v_m});
  }
  const std::size_t count = along_m_.size();
  slopes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, count - 1);
    for (std::size_t k = 0; k < 6; ++k) {
      slopes_[i][k] = (values_m_[after][k] - values_m_[before][k]) / (along_m_[after] - along_m_[before]);
    }
  }
  const double middle = 0.5 * (along_m_.front() + along_m_.back());
  bound_centre_m_ = origin_m_ + w_ * middle + u_ * values_m_[count / 2][0] + v_ * values_m_[count / 2][1];
  for (std::size_t i = 0; i < count; ++i) {
    const Values& s = values_m_[i];
    const Vec3 centre = origin_m_ + w_ * along_m_[i] + u_ * s[0] + v_ * s[1];
    const double reach = std::max(s[2], s[3]) + std::max(s[4], s[5]) + cap_m_;
    bound_radius_m_ = std::max(bound_radius_m_, glm::length(centre - bound_centre_m_) + reach);
  }
}

Loft::Values Loft::section_at(double along_m) const {
  std::size_t i = 0;
  while (i + 2 < along_m_.size() && along_m > along_m_[i + 1]) {
    ++i;
  }
  const double span = along_m_[i + 1] - along_m_[i];
  const double t = (along_m - along_m_[i]) / span;
  const double t2 = t * t, t3 = t2 * t;
  const double start = 2 * t3 - 3 * t2 + 1, start_slope = (t3 - 2 * t2 + t) * span;
  const double end = 3 * t2 - 2 * t3, end_slope = (t3 - t2) * span;
  Values result{};
  for (std::size_t k = 0; k < 6; ++k) {
    result[k] = start * values_m_[i][k] + start_slope * slopes_[i][k] + end * values_m_[i + 1][k] +
                end_slope * slopes_[i + 1][k];
  }
  return result;
}

double Loft::distance(const Vec3& point_m) const {
  const Vec3 offset = point_m - origin_m_;
  const double along = glm::dot(offset, w_);
  const double inside = std::clamp(along, along_m_.front(), along_m_.back());
  const Values s = section_at(inside);
  const double du = glm::dot(offset, u_) - s[0];
  const double dv = glm::dot(offset, v_) - s[1];
  const Vec3 radii(du > 0.0 ? s[2] : s[3], dv > 0.0 ? s[4] : s[5], cap_m_);
  const Vec3 scaled = glm::abs(Vec3(du, dv, along - inside)) / radii;
  if (squareness_ == 2.0) {
    const double level = glm::length(scaled);
    const double slope = glm::length(scaled / radii);
    return slope < 1e-9 ? -std::min(radii.x, radii.y) : level * (level - 1.0) / slope;
  }
  const double n = squareness_;
  const Vec3 lowered(std::pow(scaled.x, n - 1.0), std::pow(scaled.y, n - 1.0), std::pow(scaled.z, n - 1.0));
  const double level = std::pow(glm::dot(lowered, scaled), 1.0 / n);
  const double slope = glm::length(lowered / radii);
  return level < 0.05 ? -0.9 * std::min(radii.x, radii.y)
                      : (level - 1.0) * std::pow(level, n - 1.0) / std::max(slope, 1e-12);
}

Mat3 axes_from(const Vec3& first, const Vec3& second) {
  const Vec3 a = glm::normalize(first);
  const Vec3 b = glm::normalize(second - a * glm::dot(second, a));
  return Mat3(a, b, glm::cross(a, b));
}

}  // namespace nook::mannequin
