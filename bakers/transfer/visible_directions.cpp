#include "bakers/transfer/visible_directions.h"

#include <limits>

namespace nook::bake::transfer {
namespace {

constexpr std::uint32_t lanes = 16;

// Rays from one point, until 16 are there.
struct Packet {
  alignas(64) RTCRay16 rays;
  alignas(64) int valid[lanes];
  std::uint32_t direction[lanes];
  std::uint32_t count = 0;
};

void add(Packet& packet, Vec3 origin, Vec3 d, std::uint32_t index) {
  const std::uint32_t lane = packet.count++;
  packet.direction[lane] = index;
  packet.rays.org_x[lane] = origin.x;
  packet.rays.org_y[lane] = origin.y;
  packet.rays.org_z[lane] = origin.z;
  packet.rays.dir_x[lane] = d.x;
  packet.rays.dir_y[lane] = d.y;
  packet.rays.dir_z[lane] = d.z;
  packet.rays.tnear[lane] = 0;
  packet.rays.tfar[lane] = std::numeric_limits<float>::infinity();
  packet.rays.time[lane] = 0;
  packet.rays.mask[lane] = ~0u;
  packet.rays.id[lane] = lane;
  packet.rays.flags[lane] = 0;
}

void trace(const RayScene& scene, const SurfaceHoles* holes, Packet& packet,
           std::vector<VisibleDirection>& visible) {
  for (std::uint32_t lane = 0; lane < lanes; ++lane) {
    packet.valid[lane] = lane < packet.count ? -1 : 0;
    if (lane >= packet.count) packet.rays.tfar[lane] = -1;
  }
  occluded16(scene.get(), packet.valid, packet.rays);
  for (std::uint32_t lane = 0; lane < packet.count; ++lane) {
    float share = packet.rays.tfar[lane] >= 0 ? 1.0f : 0.0f;
    if (share == 0 && holes)
      share = holes->share_through(
          scene, {packet.rays.org_x[lane], packet.rays.org_y[lane], packet.rays.org_z[lane]},
          {packet.rays.dir_x[lane], packet.rays.dir_y[lane], packet.rays.dir_z[lane]});
    if (share > 0) visible.push_back({packet.direction[lane], share});
  }
  packet.count = 0;
}

}  // namespace

void visible_directions(const RayScene& scene, Vec3 origin, Vec3 normal, std::span<const Vec3> directions,
                        const SurfaceHoles* holes, std::vector<VisibleDirection>& visible) {
  Packet packet;
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    if (!(dot(normal, directions[i]) > 0)) continue;
    add(packet, origin, directions[i], i);
    if (packet.count == lanes) trace(scene, holes, packet, visible);
  }
  if (packet.count > 0) trace(scene, holes, packet, visible);
}

}  // namespace nook::bake::transfer
