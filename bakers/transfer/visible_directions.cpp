#include "bakers/transfer/visible_directions.h"

#include <array>
#include <limits>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/transfer/distant_light.h"

namespace nook::bake::transfer {
namespace {

// Collects rays from one point until the packet is full.
struct Packet {
  Vec3 origin;
  std::array<Vec3, RayScene::packet_size> direction;
  std::array<std::uint32_t, RayScene::packet_size> index;
  std::uint32_t count = 0;
};

void trace(const RayScene& scene, const SurfaceHoles* holes, Packet& packet,
           std::vector<VisibleDirection>& visible) {
  const std::uint32_t open = scene.open_rays(packet.origin, {packet.direction.data(), packet.count},
                                             std::numeric_limits<float>::infinity());
  for (std::uint32_t i = 0; i < packet.count; ++i) {
    float share = open >> i & 1 ? 1.0f : 0.0f;
    if (share == 0 && holes) share = holes->share_through(scene, packet.origin, packet.direction[i]);
    if (share > 0) visible.push_back({packet.index[i], share});
  }
  packet.count = 0;
}

}  // namespace

void visible_directions(const RayScene& scene, Vec3 origin, Vec3 normal, std::span<const Vec3> directions,
                        const SurfaceHoles* holes, std::vector<VisibleDirection>& visible) {
  Packet packet;
  packet.origin = origin;
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    if (!(dot(normal, directions[i]) > 0)) continue;
    packet.direction[packet.count] = directions[i];
    packet.index[packet.count++] = i;
    if (packet.count == packet.direction.size()) trace(scene, holes, packet, visible);
  }
  if (packet.count > 0) trace(scene, holes, packet, visible);
}

namespace {

// Lobes are cut off where they fall to exp(-reach) = 1e-4 of their height. This is accurate enough for a
// share with 8 bits.
constexpr float reach = 9;

}  // namespace

LobesOfDirections lobes_of(const nook::transfer::CubeCells& cells, std::uint32_t lobes) {
  const float sharpness = nook::transfer::sharpness_of(lobes), cap = 1 - reach / sharpness;
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  LobesOfDirections out;
  out.integral = gaussian_integral(sharpness);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out.begin.push_back(std::uint32_t(out.lobe.size()));
    for (std::uint32_t j = 0; j < lobes; ++j) {
      if (dot(axes[j], cells.direction[i]) < cap) continue;
      out.lobe.push_back(j);
      out.weight.push_back(gaussian_value(axes[j], sharpness, cells.direction[i]) * cells.solid_angle[i]);
    }
  }
  out.begin.push_back(std::uint32_t(out.lobe.size()));
  return out;
}

}  // namespace nook::bake::transfer
