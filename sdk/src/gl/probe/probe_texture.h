// Stores a probe or a grid of probes in a table of texels, in the layout that shaders/probe/grid.glsl reads.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/texel_table.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

// Returns the number of texels, with four floats each. The table contains, in this order: one texel with the
// grid's counts and the number of lobes, the origin, 1 / spacing, axis and sharpness of each lobe, and the
// amplitudes of each probe. Probes are ordered with x varying fastest, then y, then z. If the probes have
// amplitudes for gloss, these follow in the same order, and a flag in the texel of the origin is set. They
// are omitted if the table is too small for both.
std::uint64_t probe_texel_count(const probe::Probes& probes, bool gloss);
std::uint64_t first_amplitude_texel(std::uint32_t lobes, std::size_t probe);
Vector<float> probe_texels(const probe::Probes& probes, bool gloss, Memory* memory);

class ProbeTexture {
 public:
  // Changes GL_ARRAY_BUFFER and the table's texture target of unit 0. The constructor and update may throw
  // Failure; a texture buffer then keeps its old texels.
  ProbeTexture(Device& device, const probe::Probes& probes);
  void update(const probe::Probes& probes);

  // Replaces the amplitudes of one probe, including its amplitudes for gloss, by texels of a GPU buffer; see
  // TexelTable::copy.
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
  bool has_gloss_ = false;
};

// Returns the GLSL text for the host's shaders: shaders/probe/host.glsl with everything that it includes.
const char* probe_glsl();

}  // namespace nook::gl
