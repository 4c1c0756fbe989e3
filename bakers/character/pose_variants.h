// New poses made of given ones.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bakers/character/joint_motion.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// The mirror symmetry of a rig, found from where its joints rest.

struct MirrorRig {
  Vec3 normal;                      // of the plane of symmetry, unit length
  std::vector<std::uint32_t> twin;  // a bone's mirror image; its own index in the middle of the body
};

// The symmetry about an upright plane across x or z: the mirrored rest position of every joint is that of
// its twin, within 2 % of the rig's extent, twins have twin parents, and not all joints are their own twins.
// Nothing where there is none.
std::optional<MirrorRig> find_mirror(const SkinnedMesh& mesh, const BodyTree& tree);

// The mirror image of a pose. Twice gives the pose back.
std::vector<JointMotion> mirrored(const MirrorRig& mirror, std::span<const JointMotion> motions);

// New poses made of given ones: mirrored, with limbs of one on the body of another, and between and beyond
// two.

// count poses; the same seed gives the same poses. Empty where no pose is given.
std::vector<Pose> pose_variants(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed);

}  // namespace nook::bake
