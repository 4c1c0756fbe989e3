// The cameras of the training set, which stand where players and viewers do.
#pragma once

#include "bakers/nnao/cameras.h"

namespace nook::bake::nnao {

// Returns a camera of one of six kinds. Lengths are multiples of the scene's size:
//   0.30  in the scene's camera box
//   0.20  a walker, 0.9 to 1.9 m above the ground, whose view falls by 40 degrees or rises by 8 at most
//   0.17  grazing, 0.04 to 0.5 m above a floor, a wall or a thing, along it
//   0.15  a close-up from 0.12 to 0.8 m
//   0.10  from afar, 2.5 to 10 times the distance of the first kind, through a long lens
//   0.08  from above, by 35 to 75 degrees, 2 to 12 m away
// The vertical field of view has a uniform logarithm from 25 to 100 degrees, if the horizontal one is below
// 125. Of the screens 55 % have the sides that are given; the others have as many pixels, with sides as 4:3,
// 21:9, 3:4 and 9:16. Most of the screen shows surfaces, of which 6 to 30 % lie at edges or bends where such
// a place is found.
Camera place_training_camera(const RayScene& rays, const TrainingScene& scene, Random& random,
                             std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::nnao
