// A probe or a grid in a table of texels.
#pragma once

#include "sdk/src/gl/texel_table.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

class ProbeTexture {
 public:
  // Binds GL_ARRAY_BUFFER, and the table's target of unit 0. Both functions throw Failure; a texture buffer
  // keeps its old texels then.
  ProbeTexture(Device& device, const probe::Probes& probes);
  void update(const probe::Probes& probes);

  // Replaces the amplitudes of one probe by texels of a buffer of the GPU, as TexelTable::copy does.
  void copy_probe(std::size_t index, GLuint buffer, std::uint64_t offset_bytes) const;

  const probe::Basis& basis() const { return basis_; }
  const probe::Grid& grid() const { return grid_; }
  GLuint name() const { return table_.texture(); }
  std::uint64_t bytes() const { return table_.bytes(); }

 private:
  Device& device_;
  TexelTable table_;
  probe::Basis basis_;
  probe::Grid grid_;
};

// Returns the text for the host's shaders: shaders/probe/host.glsl with everything that it includes.
const char* probe_glsl();

}  // namespace nook::gl
