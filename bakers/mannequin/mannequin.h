// A character made by code: a human figure with a skeleton, skin weights and eight looping clips (Idle, Walk,
// Run, Crouch, Sit, Wave, Punch, Dance). Samples and tests use it when no file is given, so the repository
// does not need to contain an asset.
//
// Start reading at make_mannequin_glb at the end of mannequin.cpp. It shows the four steps:
//   bones, pose, motions    the bones in the bind pose, poses as rotations away from bind pose, and motions
//   body_sdf                the body as a signed distance field of lofts and muscles (shape_primitives)
//   body_mesh, remesher     a closed mesh on that field, with edges of the right length
//   skin_weights            the bones' weights, spread over the skin
#pragma once

#include <vector>

namespace nook::mannequin {

/// Makes the built-in character: a skinned, animated human figure of about 6,000 vertices, as the bytes of a
/// .glb file. Every call makes the same bytes and takes a few seconds.
std::vector<unsigned char> make_mannequin_glb();

}  // namespace nook::mannequin
