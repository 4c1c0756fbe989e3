// Textures from encoded images. Compiled into the tool alone: the library would otherwise load OpenImageIO
// for nothing.
#pragma once

#include "bakers/raytrace/texture.h"

namespace nook::bake {

// Fails with BAD_FILE on what OpenImageIO cannot read and on more than 2^26 texels; the message begins with
// the image's name.
Texture decode_texture(const EncodedImage& image);

}  // namespace nook::bake
