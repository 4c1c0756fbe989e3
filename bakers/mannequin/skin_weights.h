#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/mannequin/body_mesh.h"
#include "bakers/mannequin/bones.h"

namespace nook::mannequin {

/// Up to four bones that move a vertex. The weights are in descending order and sum to one. Unused entries
/// are zero.
struct VertexWeights {
  std::array<std::uint16_t, 4> bones{};
  std::array<float, 4> weights{};
};

/// Assigns to every vertex the bones of its part of the body, and then blurs these weights over the skin. The
/// blur radius is about the thickness of the body at the vertex. The blur follows the surface, so weights
/// never spread from finger to finger or from arm to chest.
std::vector<VertexWeights> make_skin_weights(const TriangleMesh& mesh, const Skeleton& skeleton);

}  // namespace nook::mannequin
