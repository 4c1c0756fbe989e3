// A scene of thin objects, which no training scene contains and which are difficult for methods with one
// depth for each pixel.
#pragma once

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

// A picket fence and a wire mesh, bentwood chairs, a plant with blades and leaves, and a hand, on a floor
// with a wall behind them. The same seed gives the same scene.
TrainingScene make_thin_scene(std::uint64_t seed);

}  // namespace nook::bake::nnao
