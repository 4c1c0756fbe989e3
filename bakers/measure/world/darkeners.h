// Methods that compute how a character darkens the world: Nook's casters, and the methods that engines use.
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
  // Sets the pose. World space, metres, +y up.
  virtual void pose(const bake::Pose& pose) = 0;
  // Returns the AO at a point; 1 is open.
  virtual float ao(Vec3 point, Vec3 normal) const = 0;
  // Returns the open share of the cone.
  virtual float cone(Vec3 point, const LightCone& cone) const = 0;
};

// A method has several variants, which differ in one free scale. For each surface, only the variant with the
// smallest error counts. It is chosen on the same poses on which the methods are scored. This favours the
// baselines.
struct Method {
  std::string name;
  std::vector<std::unique_ptr<Darkener>> variant;
};

// "nook": the casters as the runtime evaluates them.
Method nook_method(std::vector<WorldCaster> casters);
// "capsules" has one capsule for each bone, fitted by principal axes. Each capsule is evaluated as one sphere
// with its centre on the capsule's segment. For AO, it is the sphere nearest to the point. For a cone of
// light, it is the sphere nearest to the cone's axis. The open shares of the capsules are multiplied
// together. One scale applies to all radii.
Method capsule_method(const bake::SkinnedMesh& mesh);
// "ellipsoids" works like "capsules", but with one ellipsoid for each bone. Space is scaled so that the
// ellipsoid becomes the unit sphere, and this sphere is evaluated.
Method ellipsoid_method(const bake::SkinnedMesh& mesh);
// "blobs" is a round blob on the floor below the body. The best radius and strength are chosen.
Method blob_method(const bake::SkinnedMesh& mesh);
// "proxy spheres" uses the spheres that darken linked instances: exp(-sum of weight * form factor).
Method proxy_method(const CharacterModel& model);

}  // namespace nook::measure
