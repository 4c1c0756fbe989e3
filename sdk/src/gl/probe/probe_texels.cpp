#include "sdk/src/gl/probe/probe_texels.h"

namespace nook::gl {

std::uint64_t probe_texel_count(const probe::Probes& probes) {
  return 3 + std::uint64_t(probes.basis.count) * (1 + probes.grid.size());
}

std::uint64_t first_amplitude_texel(std::uint32_t lobes, std::size_t probe) {
  return 3 + std::uint64_t(lobes) * (1 + probe);
}

Vector<float> probe_texels(const probe::Probes& probes, Memory* memory) {
  Vector<float> texels(memory);
  texels.reserve(4 * probe_texel_count(probes));
  const auto add = [&](Vec3 v, float w) { texels.insert(texels.end(), {v.x, v.y, v.z, w}); };
  const probe::Basis& basis = probes.basis;
  const probe::Grid& grid = probes.grid;
  // Whole numbers up to 2^24 are exact.
  add({float(grid.counts[0]), float(grid.counts[1]), float(grid.counts[2])}, float(basis.count));
  add(grid.origin_ws, 0);
  add({1 / grid.spacing_ws.x, 1 / grid.spacing_ws.y, 1 / grid.spacing_ws.z}, 0);
  for (std::uint32_t i = 0; i < basis.count; ++i) add(basis.axis[i], basis.sharpness[i]);
  for (const Vec3 coefficient : probes.coefficients) add(coefficient, 0);
  return texels;
}

}  // namespace nook::gl
