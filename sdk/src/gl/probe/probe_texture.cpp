#include "sdk/src/gl/probe/probe_texture.h"

#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"

namespace nook::gl {

std::uint64_t probe_texel_count(const probe::Probes& probes, bool gloss) {
  const std::uint64_t amplitudes = std::uint64_t(probes.basis.count) * probes.grid.size();
  return 3 + probes.basis.count + amplitudes * (gloss ? 2 : 1);
}

std::uint64_t first_amplitude_texel(std::uint32_t lobes, std::size_t probe) {
  return 3 + std::uint64_t(lobes) * (1 + probe);
}

Vector<float> probe_texels(const probe::Probes& probes, bool gloss, Memory* memory) {
  Vector<float> texels(memory);
  texels.reserve(4 * probe_texel_count(probes, gloss));
  const auto add = [&](Vec3 v, float w) { texels.insert(texels.end(), {v.x, v.y, v.z, w}); };
  const probe::Basis& basis = probes.basis;
  const probe::Grid& grid = probes.grid;
  // Counts are stored as floats, which represent integers up to 2^24 exactly.
  add({float(grid.counts[0]), float(grid.counts[1]), float(grid.counts[2])}, float(basis.count));
  add(grid.origin_ws, gloss ? 1 : 0);
  add({1 / grid.spacing_ws.x, 1 / grid.spacing_ws.y, 1 / grid.spacing_ws.z}, 0);
  for (std::uint32_t i = 0; i < basis.count; ++i) add(basis.axis[i], basis.sharpness[i]);
  for (const Vec3 coefficient : probes.coefficients) add(coefficient, 0);
  if (gloss)
    for (const Vec3 amplitude : probes.gloss) add(amplitude, 0);
  return texels;
}

ProbeTexture::ProbeTexture(Device& device, const probe::Probes& probes)
    : device_(device), table_(device.memory) {
  update(probes);
}

void ProbeTexture::update(const probe::Probes& probes) {
  if (probes.basis.kind != probe::BasisKind::gaussians)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the probe does not consist of lobes; upload one that was fitted with NOOK_PROBE_BASIS_LOBES");
  const bool gloss = probes.has_gloss() && probe_texel_count(probes, true) <= device_.max_texels;
  const std::uint64_t count = probe_texel_count(probes, gloss);
  if (count > device_.max_texels)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the grid is too large for a texture buffer of this OpenGL (%u lobes at %zu places are %llu "
        "texels, need at most %u); split the grid or use fewer lobes",
        probes.basis.count, probes.grid.size(), static_cast<unsigned long long>(count), device_.max_texels);
  if (gloss != probes.has_gloss())
    device_.context.log(
        NOOK_LOG_WARNING,
        "nook_gl: the grid's gloss amplitudes do not fit into a texture buffer of this OpenGL (%llu texels, "
        "at most %u); glossy reflections use the amplitudes of the light instead, and may have black patches",
        static_cast<unsigned long long>(probe_texel_count(probes, true)), device_.max_texels);
  const Vector<float> texels = probe_texels(probes, gloss, device_.memory);
  table_.replace(device_, GL_RGBA32F, count, texels.data(), "nook: probe");
  basis_ = probes.basis;
  grid_ = probes.grid;
  has_gloss_ = gloss;
}

void ProbeTexture::copy_probe(std::size_t index, GLuint buffer, std::uint64_t offset_bytes) const {
  table_.copy(device_, buffer, offset_bytes, first_amplitude_texel(basis_.count, index), basis_.count);
  // The new data contain no separate amplitudes for gloss, so the amplitudes of the light are copied there,
  // too.
  if (has_gloss_)
    table_.copy(device_, buffer, offset_bytes, first_amplitude_texel(basis_.count, grid_.size() + index),
                basis_.count);
}

const char* probe_glsl() {
  return embedded_text("probe/host.glsl");
}

}  // namespace nook::gl
