// A probe or a grid in a texture buffer.
#pragma once

#include "sdk/src/gl/object.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

class ProbeTexture {
 public:
  // Binds GL_ARRAY_BUFFER, and GL_TEXTURE_BUFFER of unit 0. Both functions throw Failure and then leave the
  // old texels.
  ProbeTexture(Device& device, const probe::Probes& probes);
  void update(const probe::Probes& probes);

  GLuint name() const { return texture_.name(); }
  std::uint64_t bytes() const { return buffer_.bytes(); }

 private:
  Device& device_;
  Buffer buffer_;
  Object texture_;
};

// Returns the text for the host's shaders: shaders/probe/host.glsl with everything that it includes.
const char* probe_glsl();

}  // namespace nook::gl
