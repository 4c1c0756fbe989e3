// The tables of baked clips in two 2D textures, which shaders/clips/host.glsl reads.
#pragma once

#include "sdk/src/character/loaded_clips.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

class ClipTextures {
 public:
  // Changes the state of the user `clips` in touched_state.h; the caller must hold a StateGuard. Throws
  // Failure.
  ClipTextures(Device& device, const LoadedClips& clips, std::uint32_t mode_count);

  GLuint modes() const { return modes_.name(); }
  GLuint weights() const { return weights_.name(); }
  std::uint64_t bytes() const { return bytes_; }
  // Returns the number of texels for each vertex and for each frame. It is the value of the uniform
  // nook_clip_vec4s.
  std::uint32_t vec4s() const { return vec4s_; }

 private:
  Object modes_, weights_;
  std::uint64_t bytes_ = 0;
  std::uint32_t vec4s_ = 0;
};

// Returns the GLSL text for the host's shaders.
const char* clips_glsl();

}  // namespace nook::gl
