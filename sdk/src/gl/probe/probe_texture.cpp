#include "sdk/src/gl/probe/probe_texture.h"

#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/probe/probe_texels.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {

ProbeTexture::ProbeTexture(Device& device, const probe::Probes& probes)
    : device_(device), table_(device.memory) {
  update(probes);
}

void ProbeTexture::update(const probe::Probes& probes) {
  if (probes.basis.kind != probe::BasisKind::gaussians)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the probe is not of lobes; upload one that was fitted with NOOK_PROBE_BASIS_LOBES");
  const std::uint64_t count = probe_texel_count(probes);
  if (count > device_.max_texels)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the grid is too large for a texture buffer of this OpenGL (%u lobes at %zu places are %llu "
        "texels, need at most %u); split the grid or use fewer lobes",
        probes.basis.count, probes.grid.size(), static_cast<unsigned long long>(count), device_.max_texels);
  const Vector<float> texels = probe_texels(probes, device_.memory);
  table_.replace(device_, GL_RGBA32F, count, texels.data(), "nook: probe");
  basis_ = probes.basis;
  grid_ = probes.grid;
}

void ProbeTexture::copy_probe(std::size_t index, GLuint buffer, std::uint64_t offset_bytes) const {
  table_.copy(device_, buffer, offset_bytes, first_amplitude_texel(basis_.count, index), basis_.count);
}

const char* probe_glsl() {
  return embedded_text("probe/host.glsl");
}

}  // namespace nook::gl
