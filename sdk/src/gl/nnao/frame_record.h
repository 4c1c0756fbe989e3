// Records a host's frame as plain data that can be replayed on another machine. Textures are read back as the
// floats that a shader reads, with identical bits on every OpenGL.
#pragma once

#include <nook/nook_nnao.h>

#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/nnao/recording.h"

namespace nook::gl {

// Texels are copied through a strip with this many rows, so that even large images need little OpenGL memory.
inline constexpr int texel_strip_rows = 64;

// Reads back textures. All functions change the state of the users `screen` and `screen_reads`, and may throw
// Failure.
class TexelReader {
 public:
  TexelReader(Device& device, int width);

  // Returns the first `channels` channels of the texels in the viewport, from level 0, row by row from the
  // bottom. The viewport must not be wider than the reader. Waits for the GPU.
  Vector<float> read(GLuint texture, const Viewport& viewport, int channels);

 private:
  Device& device_;
  Object program_, sampler_, vertex_array_;
  RenderTexture strip_;
  Vector<std::uint32_t> bits_;
};

// Draws a frame that passed check_frame into the pass's own texture, and reads back the result and the
// frame's inputs. `made_with` has the settings of the pass, and `network` is the file of its network. `note`
// may be null. Changes the state of the frame's users and of `screen_reads`. Throws Failure.
nnao::Recording record_frame(Device& device, NnaoPass& pass, const nook_nnao_desc& made_with,
                             std::span<const std::byte> network, const NnaoFrame& frame, const char* note);

}  // namespace nook::gl
