// Colours for texels through which a view passes. Were they black, filtering, mipmaps and compression would
// mix the black into what is visible beside them, and silhouettes would be darkened twice: by that, and by
// their visibility.
#pragma once

#include <span>

#include "bakers/material/raw_material.h"

namespace nook::bake::material {

// coverage: view x width x height, the share of a texel that the view meets, 0 to 1. On entry the BTF is that
// share times the colour of what is met; on return the colour alone. Where the coverage is 0, values are not
// read, but filled from around by pull and push: the mean colour, weighted by coverage, of the smallest block
// of 2 x 2, 4 x 4, ... texels that holds any, linear between blocks. Means over larger areas, which mipmaps
// are, so stay near those of what is visible. A view that meets nothing becomes black. The texture repeats.
// The same bits on any number of threads.
void fill_gaps(RawMaterial& raw, std::span<const float> coverage);

// The same for one image, x * height + y.
void fill_image_gaps(std::span<float> image, std::span<const float> coverage, std::uint32_t width,
                     std::uint32_t height);

}  // namespace nook::bake::material
