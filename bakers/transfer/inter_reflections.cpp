#include "bakers/transfer/inter_reflections.h"

#include <numbers>

#include "sdk/src/core/floats.h"

namespace nook::bake::transfer {

IrradianceBands direct_irradiance(Vec3 normal, const nook::transfer::CubeCells& cells,
                                  std::span<const VisibleDirection> visible) {
  IrradianceBands sum{};
  for (const auto& [i, share] : visible) {
    const float weight = dot(normal, cells.direction[i]) * share * cells.solid_angle[i];
    const IrradianceBands at = nook::transfer::bands_at(cells.direction[i]);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * at[k];
  }
  return sum;
}

IrradianceBands reflected_irradiance(const Reflection& reflection, std::size_t vertex,
                                     std::span<const IrradianceBands> before) {
  const SurfaceMesh& mesh = reflection.mesh;
  const Vec3 normal = mesh.normal[vertex];
  const Vec3 origin = mesh.position[vertex] + normal * reflection.origin_offset;
  const auto& cells = reflection.cells;
  // Finds the directions that see the sky first. Most directions do, and packets of rays find them faster.
  std::vector<VisibleDirection> open;
  visible_directions(reflection.scene, origin, normal, cells.direction, nullptr, open);
  auto next = open.begin();
  IrradianceBands sum{};
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const Vec3 d = cells.direction[i];
    const float cosine = dot(normal, d);
    if (!(cosine > 0)) continue;
    if (next != open.end() && next->direction == i) {
      ++next;
      continue;
    }
    const float weight = cosine * cells.solid_angle[i] * (1 / std::numbers::pi_v<float>);
    walk_surfaces(reflection.scene, reflection.holes, origin, d, [&](const RayHit& hit, float share) {
      const auto& corner = mesh.triangle[hit.triangle];
      const float at[3] = {1 - hit.u - hit.v, hit.u, hit.v};
      Vec3 faces;
      for (std::size_t k = 0; k < 3; ++k) faces += mesh.normal[corner[k]] * at[k];
      if (!(dot(faces, d) < 0)) return;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t b = 0; b < sum.size(); ++b) sum[b] += weight * share * at[k] * before[corner[k]][b];
    });
  }
  return sum;
}

void reflect(const Reflection& reflection, std::uint32_t bounces, VertexLoop& loop,
             std::vector<IrradianceBands> received, nook::transfer::Transfer& transfer) {
  constexpr std::size_t bands = nook::transfer::band_count;
  struct Nothing {};
  transfer.bounces = bounces;
  transfer.indirect.resize(received.size() * bounces * bands);
  for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
    std::vector<IrradianceBands> reflected(received.size());
    loop.run<Nothing>(received.size(), [&](std::size_t v, Nothing&) {
      reflected[v] = reflected_irradiance(reflection, v, received);
      for (std::size_t k = 0; k < bands; ++k)
        transfer.indirect[(v * bounces + bounce) * bands + k] = to_half(reflected[v][k]);
    });
    received = std::move(reflected);
  }
}

}  // namespace nook::bake::transfer
