#include "sdk/src/gl/synthesis/coordinate_texture.h"

#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/material/texture_array.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/state_access.h"

namespace nook::gl {

CoordinateTexture::CoordinateTexture(Device& device, const synthesis::Coordinates& coordinates)
    : source_(device.memory), bytes_(sizeof(synthesis::Cell) * coordinates.cells.size()) {
  const auto most = std::uint32_t(integer(device.gl, GL_MAX_TEXTURE_SIZE));
  if (coordinates.side > most)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the plane is larger than a texture of this OpenGL (got %u texels, need at most %u)",
                  coordinates.side, most);
  char definitions[200];
  std::snprintf(definitions, sizeof definitions,
                "#define NOOK_SYNTHESIS_SIDE %u.0\n#define NOOK_SYNTHESIS_MATERIAL_TEXELS vec2(%u.0, %u.0)\n",
                coordinates.side, coordinates.width, coordinates.height);
  source_ = definitions;
  source_ += embedded_text("synthesis/host.glsl");
  set_plain_unpacking(device.gl);
  const auto side = GLsizei(coordinates.side);
  texture_ = make_texture_array(device, {ArrayUse::coordinates, side, side, 0, 1, 1, 1},
                                coordinates.cells.data(), "nook: synthesis");
}

}  // namespace nook::gl
