#include "bakers/world/cone_rays.h"

#include <cmath>
#include <numbers>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake {

float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn) {
  constexpr double golden_angle = 2.399963229728653;
  const Frame frame = turned_frame(cone.axis, 1, 0);
  const double versine = 2 * std::pow(std::sin(0.5 * double(cone.half_angle_radians)), 2);
  std::uint32_t open = 0;
  for (std::uint32_t r = 0; r < rays; ++r) {
    const double w = versine * (r + 0.5) / rays, sine = std::sqrt(w * (2 - w));
    const double angle = golden_angle * r + 2 * std::numbers::pi * double(turn);
    const Vec3 direction{float(sine * std::cos(angle)), float(sine * std::sin(angle)), float(1 - w)};
    open += !scene.occluded(origin, to_world(frame, direction));
  }
  return float(open) / float(rays);
}

}  // namespace nook::bake
