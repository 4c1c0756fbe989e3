// Makes new poses from given ones.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bakers/character/joint_motion.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Finds the mirror symmetry of a rig from the rest positions of its joints.

struct MirrorRig {
  Vec3 normal;                      // normal of the plane of symmetry, unit length
  std::vector<std::uint32_t> twin;  // mirror image of each bone; itself for a bone in the middle
};

// Finds an upright plane, perpendicular to x or z, in which the rig is symmetric. Returns nothing if there is
// none. The mirrored
// rest position of every joint must be within 2 % of the rig's extent from its twin. The parents of twins
// must be twins too. At least one joint must have a twin other than itself.
std::optional<MirrorRig> find_mirror(const SkinnedMesh& mesh, const BodyTree& tree);

// Returns the mirror image of a pose. Mirroring the result again gives the original pose.
std::vector<JointMotion> mirrored(const MirrorRig& mirror, std::span<const JointMotion> motions);

// Makes poses from given ones: mirrors a pose, puts limbs of one pose on the body of another, and
// interpolates and extrapolates between two poses.

// Makes `count` poses. The same seed gives the same poses. Returns nothing if no pose is given.
std::vector<Pose> pose_variants(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed,
                                const RigCorrections& corrections = {});

}  // namespace nook::bake
