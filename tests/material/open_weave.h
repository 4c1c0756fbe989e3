// A material that means something, made without a bake: an open weave of round threads, sphere-traced into a
// BTF and a VOTF, and stored without loss as a CTA whose clusters hold four views each.
#pragma once

#include "sdk/src/material/material.h"

namespace nook::material::test {

struct WeaveSize {
  std::uint32_t lights = 12, views = 48, texels = 32;  // views: a multiple of 4
  VisibilityForm visibility = VisibilityForm::distance;
  float radius = 0.085f;  // of a thread, in tiles; a side has four threads
};

Material open_weave(const WeaveSize& size = {});

}  // namespace nook::material::test
