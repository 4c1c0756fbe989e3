#pragma once

#include <vector>

#include "samples/mannequin/clips.h"
#include "samples/mannequin/skeleton.h"
#include "samples/mannequin/skin_weights.h"
#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

/// Packs the character into one binary glTF 2.0 file: one skinned mesh, one skin, one animation for each
/// clip.
std::vector<unsigned char> write_glb(const TriangleMesh& mesh, const std::vector<VertexWeights>& weights,
                                     const Skeleton& skeleton, const std::vector<Clip>& clips);

}  // namespace nook_samples::mannequin
