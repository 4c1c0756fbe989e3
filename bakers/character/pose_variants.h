// New poses made of given ones.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bakers/character/joint_motion.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Finds the mirror symmetry of a rig from the places where its joints rest.

struct MirrorRig {
  Vec3 normal;                      // normal of the plane of symmetry, unit length
  std::vector<std::uint32_t> twin;  // mirror image of each bone; a bone in the middle of the body is its own
};

// Finds the symmetry about an upright plane across x or z. The mirrored rest position of every joint must be
// at its twin, within 2 % of the rig's extent. Twins must have twin parents, and not all joints may be their
// own twins. Returns nothing for other rigs.
std::optional<MirrorRig> find_mirror(const SkinnedMesh& mesh, const BodyTree& tree);

// Returns the mirror image of a pose. Mirroring twice gives the pose back.
std::vector<JointMotion> mirrored(const MirrorRig& mirror, std::span<const JointMotion> motions);

// Makes poses from given ones: mirrors them, puts limbs of one on the body of another, and goes between and
// beyond two.

// Makes count poses. The same seed gives the same poses. Returns nothing if no pose is given.
std::vector<Pose> pose_variants(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed,
                                const RigCorrections& corrections = {});

}  // namespace nook::bake
