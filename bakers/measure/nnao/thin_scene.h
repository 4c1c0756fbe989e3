// Thin things that no training scene has: what methods that see one depth a pixel get wrong first.
#pragma once

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

// A picket fence and a wire mesh, bentwood chairs, a plant with blades and leaves, a hand; on a floor with a
// wall behind. The same for the same seed.
TrainingScene make_thin_scene(std::uint64_t seed);

}  // namespace nook::bake::nnao
