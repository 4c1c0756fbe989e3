// Reads the texels of a host's texture back as the floats that a shader gets from it, with the same bits on
// every OpenGL.
#pragma once

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/render_texture.h"

namespace nook::gl {

// The texels go through a strip of this many rows, so that large images take little OpenGL memory.
inline constexpr int texel_strip_rows = 64;

// Its functions touch the state of the users screen and screen_reads. They throw Failure.
class TexelReader {
 public:
  TexelReader(Device& device, int width);

  // Returns the first channels of each texel of level 0 in the viewport, at most as wide as the reader, row
  // by row from the bottom. Waits for the GPU.
  Vector<float> read(GLuint texture, const Viewport& viewport, int channels);

 private:
  Device& device_;
  Object program_, sampler_, vertex_array_;
  RenderTexture strip_;
  Vector<std::uint32_t> bits_;
};

}  // namespace nook::gl
