// Stores probes as the texels that shaders/probe/grid.glsl reads, in a table for a probe or a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/texel_table.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

// Returns the number of texels, which hold four floats each. They are counts and number of lobes; origin; 1 /
// spacing; axis and sharpness of each lobe; then the amplitudes of each probe. x varies fastest, then y, then
// z. If the probes have amplitudes for gloss, these follow in the same order, and the texel of the origin
// says so. They are left out where the table has no room for both.
std::uint64_t probe_texel_count(const probe::Probes& probes, bool gloss);
std::uint64_t first_amplitude_texel(std::uint32_t lobes, std::size_t probe);
Vector<float> probe_texels(const probe::Probes& probes, bool gloss, Memory* memory);

class ProbeTexture {
 public:
  // Binds GL_ARRAY_BUFFER, and the table's target of unit 0. Both functions throw Failure, and a texture
  // buffer then keeps its old texels.
  ProbeTexture(Device& device, const probe::Probes& probes);
  void update(const probe::Probes& probes);

  // Replaces the amplitudes of one probe, also those for gloss, by texels of a GPU buffer, as
  // TexelTable::copy does.
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

// Returns the text for the host's shaders: shaders/probe/host.glsl and everything it includes.
const char* probe_glsl();

}  // namespace nook::gl
