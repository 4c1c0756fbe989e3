#include "sdk/src/gl/probe/probe_texture.h"

#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/probe/probe_texels.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {

ProbeTexture::ProbeTexture(Device& device, const probe::Probes& probes) : device_(device) {
  texture_ = Object::make(device, Object::Kind::texture);
  update(probes);
}

void ProbeTexture::update(const probe::Probes& probes) {
  if (probes.basis.kind != probe::BasisKind::gaussians)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the probe is not of lobes; upload one that was fitted with NOOK_PROBE_GAUSSIANS");
  const std::uint64_t count = probe_texel_count(probes);
  if (count > device_.max_texels)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the grid is too large for a texture buffer of this OpenGL (%u lobes at %zu places are %llu "
        "texels, need at most %u); split the grid or use fewer lobes",
        probes.basis.count, probes.grid.size(), static_cast<unsigned long long>(count), device_.max_texels);
  const Vector<float> texels = probe_texels(probes, device_.memory);
  // The new texels have a buffer of their own, so that the old ones stay until everything has succeeded.
  Buffer buffer(device_, "nook: probe", texels.size() * sizeof(float), texels.data(), GL_STATIC_DRAW);
  device_.gl.ActiveTexture(GL_TEXTURE0);
  device_.gl.BindTexture(GL_TEXTURE_BUFFER, texture_.name());
  device_.gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer.name());
  device_.check("uploading a probe");
  device_.label(GL_TEXTURE, texture_.name(), "nook: probe");
  buffer_ = std::move(buffer);
}

const char* probe_glsl() {
  return embedded_text("probe/host.glsl");
}

}  // namespace nook::gl
