// Textures from encoded images. Only the tool compiles this file, because the library would otherwise load
// OpenImageIO.
#pragma once

#include "bakers/raytrace/texture.h"

namespace nook::bake {

// Fails with BAD_FILE if OpenImageIO cannot read the image, or if it has more than 2^26 texels; the message
// starts with the image's name.
Texture decode_texture(const EncodedImage& image);

}  // namespace nook::bake
