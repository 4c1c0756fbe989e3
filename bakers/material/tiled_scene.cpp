#include "bakers/material/tiled_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nook::bake::material {
namespace {

// Tiles on each side of the middle one. A ray of 80 degrees tilt crosses a structure of half a tile's height
// within three; flatter ones, which only inter-reflection casts, are open beyond.
constexpr int copies = 3;

// Tiles; far below a texel, far above the rounding of coordinates up to `copies`.
constexpr float origin_offset = 2e-5f;

std::vector<Vec3> copy_offsets() {
  std::vector<Vec3> offsets;
  for (int y = -copies; y <= copies; ++y)
    for (int x = -copies; x <= copies; ++x) offsets.push_back({float(x), float(y), 0});
  return offsets;
}

}  // namespace

TiledScene::TiledScene(const MesoSurface& surface)
    : surface_(surface),
      tile_(RayDevice(), surface.position, surface.triangle),
      plane_(tile_, copy_offsets()) {
  const auto [low, high] = std::minmax_element(surface.position.begin(), surface.position.end(),
                                               [](Vec3 a, Vec3 b) { return a.z < b.z; });
  bottom_ = low->z;
  top_ = high->z;
}

Vec3 TiledScene::outside(Vec3 position, Vec3 normal) const {
  const Vec3 p = position + origin_offset * normal;
  return {p.x - std::floor(p.x), p.y - std::floor(p.y), p.z};
}

SurfaceHit TiledScene::nearest(Vec3 origin, Vec3 direction) const {
  const RayHit ray = plane_.nearest(origin, direction);
  SurfaceHit hit;
  hit.triangle = ray.triangle;
  if (hit.triangle == SurfaceHit::nothing) return hit;
  hit.u = ray.u;
  hit.v = ray.v;
  hit.position = origin + ray.distance * direction;
  const auto& t = surface_.triangle[hit.triangle];
  const Vec3 a = surface_.position[t[0]];
  hit.normal = normalised(cross(surface_.position[t[1]] - a, surface_.position[t[2]] - a));
  return hit;
}

void TiledScene::open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                                 std::span<unsigned char> open) const {
  const Vec3 origin = outside(from.position, from.normal);
  for (std::size_t first = 0; first < directions.size(); first += RayScene::packet_size) {
    const auto packet = directions.subspan(first, std::min(RayScene::packet_size, directions.size() - first));
    const std::uint32_t is_open = plane_.open_rays(origin, packet, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < packet.size(); ++i) open[first + i] = is_open >> i & 1;
  }
}

}  // namespace nook::bake::material
