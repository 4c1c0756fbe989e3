// Ways in which a character darkens the world: Nook's casters and what engines use instead.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"
#include "sdk/src/world/cone.h"

namespace nook::measure {

// A cone of light.
struct LightCone {
  Vec3 axis;  // unit, towards the light
  float half_angle_radians = 0;
  world::ConeParts parts;
};

// One method in one pose.
class Darkener {
 public:
  virtual ~Darkener() = default;
  // world space, metres, +y up.
  virtual void pose(const bake::Pose& pose) = 0;
  // AO, 1 is open.
  virtual float ao(Vec3 point, Vec3 normal) const = 0;
  // The share of the cone that is open.
  virtual float cone(Vec3 point, const LightCone& cone) const = 0;
};

// A method is a family of variants. For each surface, the variant with the smallest error counts: its one
// free scale is picked on the scored poses, in its favour.
struct Method {
  std::string name;
  std::vector<std::unique_ptr<Darkener>> variant;
};

// "nook": the casters as the runtime evaluates them.
Method nook_method(std::vector<WorldCaster> casters);
// "capsules" has one capsule for each bone by principal axes. Each counts as the sphere on its segment that
// is nearest to the point, or to the axis of a cone. The open shares are multiplied, and one scale sets the
// radii.
Method capsule_method(const bake::SkinnedMesh& mesh);
// "ellipsoids": the same with an ellipsoid for each bone, evaluated as the unit sphere in its own space.
Method ellipsoid_method(const bake::SkinnedMesh& mesh);
// "blobs": a round blob on the floor below the body, with a picked radius and strength.
Method blob_method(const bake::SkinnedMesh& mesh);
// "proxy spheres": the spheres that darken linked instances, exp(-sum of weight * form factor).
Method proxy_method(const CharacterModel& model);

}  // namespace nook::measure
