// Records a frame of a host as plain data that can be replayed elsewhere. Textures are read back as the
// floats that a shader gets, with the same bits on every OpenGL.
#pragma once

#include <nook/nook_nnao.h>

#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/nnao/recording.h"

namespace nook::gl {

// The texels go through a strip of this many rows, so that large images take little OpenGL memory.
inline constexpr int texel_strip_rows = 64;

// Its functions touch the state of the users screen and screen_reads, and throw Failure.
class TexelReader {
 public:
  TexelReader(Device& device, int width);

  // Returns the first channels of each texel of level 0 in the viewport, row by row from the bottom. The
  // viewport may be at most as wide as the reader. Waits for the GPU.
  Vector<float> read(GLuint texture, const Viewport& viewport, int channels);

 private:
  Device& device_;
  Object program_, sampler_, vertex_array_;
  RenderTexture strip_;
  Vector<std::uint32_t> bits_;
};

// Draws a frame that passed check_frame into the pass's own texture, and reads back the result and the
// frame's inputs. made_with: the pass's settings. network: its file. note may be null. Touches the state of a
// frame's users and of screen_reads. Throws Failure.
nnao::Recording record_frame(Device& device, NnaoPass& pass, const nook_nnao_desc& made_with,
                             std::span<const std::byte> network, const NnaoFrame& frame, const char* note);

}  // namespace nook::gl
