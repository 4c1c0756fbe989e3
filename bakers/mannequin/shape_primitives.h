#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace nook::mannequin {

using Vec3 = glm::dvec3;
using Mat3 = glm::dmat3;

inline const Vec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

/// Joins two distances with a fillet about `blend_m` wide. Equals min() if the distances differ by more than
/// `blend_m`.
double smooth_min(double a_m, double b_m, double blend_m);

/// Subtracts the body with distance `b_m` from the body with distance `a_m`, with a rounded rim.
double smooth_subtract(double a_m, double b_m, double blend_m);

/// A capsule with a different radius at each end.
struct RoundCone {
  Vec3 start_m;
  Vec3 end_m;
  double start_radius_m;
  double end_radius_m;

  double distance(const Vec3& point_m) const;
};

/// An ellipsoid. The columns of `axes` are the orthonormal directions of its semi-axes.
struct Ellipsoid {
  Vec3 centre_m;
  Vec3 radii_m;
  Mat3 axes{1.0};

  double distance(const Vec3& point_m) const;
};

/// One cross-section of a loft. Its outline consists of four quarter ellipses, so that each of the four sides
/// can have its own radius.
struct LoftSection {
  double along_m;
  double centre_u_m, centre_v_m;
  double plus_u_m, minus_u_m, plus_v_m, minus_v_m;
};

/// A body along the axis `w`. A cubic spline interpolates between its cross-sections.
class Loft {
 public:
  /// `squareness` is the exponent of the outline: 2 is elliptic, larger values are more like a box.
  Loft(const Vec3& origin_m, const Vec3& u, const Vec3& v, const Vec3& w, std::vector<LoftSection> sections,
       double cap_m, double squareness = 2.0);

  double distance(const Vec3& point_m) const;
  Vec3 bound_centre_m() const { return bound_centre_m_; }
  double bound_radius_m() const { return bound_radius_m_; }

 private:
  using Values = std::array<double, 6>;
  Values section_at(double along_m) const;

  Vec3 origin_m_, u_, v_, w_;
  std::vector<double> along_m_;
  std::vector<Values> values_m_;
  std::vector<Values> slopes_;
  double cap_m_;
  double squareness_;
  Vec3 bound_centre_m_{0.0};
  double bound_radius_m_ = 0.0;
};

/// Returns a rotation matrix. Its first column is the direction of `first`. Its second column is `second`,
/// made perpendicular to `first`.
Mat3 axes_from(const Vec3& first, const Vec3& second);

/// Rises smoothly from 0 at `from` to 1 at `to`. Constant outside this range.
inline double ramp(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace nook::mannequin
