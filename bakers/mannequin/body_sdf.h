#pragma once

#include <variant>
#include <vector>

#include "bakers/mannequin/shape_primitives.h"

namespace nook::mannequin {

/// One shape of the figure, and how it is joined to the previous shapes.
struct Mass {
  std::variant<RoundCone, Ellipsoid, Loft> shape;
  double blend_m;
  bool carved = false;  ///< True if the mass is subtracted instead of added.
  Vec3 bound_centre_m{0.0};
  double bound_radius_m = 0.0;
};

/// A group of shapes. They are joined to each other first, and then to the rest of the figure.
class Part {
 public:
  explicit Part(double blend_m) : blend_m_(blend_m) {}

  void add(const RoundCone& cone, double blend_m);
  void add(const Ellipsoid& ellipsoid, double blend_m);
  void add(Loft loft, double blend_m);
  void carve(const RoundCone& cone, double blend_m);
  void carve(const Ellipsoid& ellipsoid, double blend_m);

  /// Joins this part with the rest of the figure, whose distance is `known_m`, and returns the joined
  /// distance. If the part is too far away to have an effect, the call costs a single comparison.
  double join(double known_m, const Vec3& point_m) const;
  void close();  ///< Computes the bounding sphere. Call this once, after the last mass.

 private:
  double distance(const Vec3& point_m) const;

  double blend_m_;
  std::vector<Mass> masses_;
  Vec3 bound_centre_m_{0.0};
  double bound_radius_m_ = 0.0;
};

/// The signed distance to the skin in metres, negative inside. The distance is approximate away from the
/// skin. The figure is symmetric in x.
class BodySdf {
 public:
  BodySdf();

  double distance(const Vec3& point_m) const;
  Vec3 gradient(const Vec3& point_m) const;
  /// Moves a point near the skin onto the skin.
  Vec3 project(const Vec3& point_m) const;

 private:
  std::vector<Part> parts_;
};

Part make_torso();
Part make_head();
Part make_leg();
Part make_foot();
Part make_arm();
Part make_hand();

}  // namespace nook::mannequin
