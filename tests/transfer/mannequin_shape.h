// The built-in character's skin as a shape of radiance transfer.
#pragma once

#include "tests/transfer/shapes.h"

namespace nook::transfer::test {

// The body in its bind pose, over a plane. The skin has no texture coordinates of its own: each triangle
// takes the coordinates along the axis nearest to its normal, six tiles a metre, and vertices on borders are
// there once for each axis.
Shape mannequin_over_plane();

}  // namespace nook::transfer::test
