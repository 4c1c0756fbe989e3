#include "bakers/transfer/visible_directions.h"

#include <array>
#include <limits>

namespace nook::bake::transfer {
namespace {

// Rays from one point, until the packet is full.
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

}  // namespace nook::bake::transfer
