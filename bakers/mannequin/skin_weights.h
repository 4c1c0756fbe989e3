#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/mannequin/body_mesh.h"
#include "bakers/mannequin/bones.h"

namespace nook::mannequin {

/// Up to four bones that move a vertex. The weights fall from the first to the last and sum to one. Unused
/// slots are zero.
struct VertexWeights {
  std::array<std::uint16_t, 4> bones{};
  std::array<float, 4> weights{};
};

/// Seeds every vertex with the bones of its stretch of the body and lets the seeds spread over the skin, as
/// far as the body is thick there. Spreading runs along the surface, so it never jumps from finger to finger
/// or from arm to chest.
std::vector<VertexWeights> make_skin_weights(const TriangleMesh& mesh, const Skeleton& skeleton);

}  // namespace nook::mannequin
