#include "bakers/material/tiled_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/raytrace/ray_scene.h"

namespace nook::bake::material {
namespace {

// Tiles on each side of the middle one. A ray of 80 degrees tilt crosses a structure of half a tile's height
// within three; flatter ones, which only inter-reflection casts, are open beyond.
constexpr int copies = 3;

// Tiles; far below a texel, far above the rounding of coordinates up to `copies`.
constexpr float origin_offset = 2e-5f;

}  // namespace

TiledScene::TiledScene(const MesoSurface& surface)
    : surface_(surface), tile_(device_.get()), plane_(device_.get()) {
  const FlushDenormals flush;
  const auto [low, high] = std::minmax_element(surface.position.begin(), surface.position.end(),
                                               [](Vec3 a, Vec3 b) { return a.z < b.z; });
  bottom_ = low->z;
  top_ = high->z;
  build_scene(device_.get(), tile_.get(), surface.position, surface.triangle);
  for (int y = -copies; y <= copies; ++y)
    for (int x = -copies; x <= copies; ++x) {
      RTCGeometry instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, tile_.get());
      const float columns[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, float(x), float(y), 0};
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
      rtcCommitGeometry(instance);
      rtcAttachGeometry(plane_.get(), instance);
      rtcReleaseGeometry(instance);
    }
  rtcCommitScene(plane_.get());
}

Vec3 TiledScene::outside(Vec3 position, Vec3 normal) const {
  const Vec3 p = position + origin_offset * normal;
  return {p.x - std::floor(p.x), p.y - std::floor(p.y), p.z};
}

SurfaceHit TiledScene::nearest(Vec3 origin, Vec3 direction) const {
  alignas(16) RTCRayHit ray{};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect1(plane_.get(), ray);
  SurfaceHit hit;
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.triangle = ray.hit.primID;
  hit.u = ray.hit.u;
  hit.v = ray.hit.v;
  hit.position = origin + ray.ray.tfar * direction;
  const auto& t = surface_.triangle[hit.triangle];
  const Vec3 a = surface_.position[t[0]];
  hit.normal = normalised(cross(surface_.position[t[1]] - a, surface_.position[t[2]] - a));
  return hit;
}

void TiledScene::open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                                 std::span<unsigned char> open) const {
  const Vec3 origin = outside(from.position, from.normal);
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[16];
  for (std::size_t first = 0; first < directions.size(); first += 16) {
    for (std::size_t lane = 0; lane < 16; ++lane) {
      const bool used = first + lane < directions.size();
      const Vec3 d = used ? directions[first + lane] : Vec3{0, 0, 1};
      valid[lane] = used ? -1 : 0;
      packet.org_x[lane] = origin.x;
      packet.org_y[lane] = origin.y;
      packet.org_z[lane] = origin.z;
      packet.dir_x[lane] = d.x;
      packet.dir_y[lane] = d.y;
      packet.dir_z[lane] = d.z;
      packet.tnear[lane] = 0;
      packet.tfar[lane] = used ? std::numeric_limits<float>::infinity() : -1;
      packet.time[lane] = 0;
      packet.mask[lane] = ~0u;
      packet.id[lane] = unsigned(lane);
      packet.flags[lane] = 0;
    }
    occluded16(plane_.get(), valid, packet);
    for (std::size_t lane = 0; lane < 16 && first + lane < directions.size(); ++lane)
      open[first + lane] = packet.tfar[lane] >= 0;
  }
}

}  // namespace nook::bake::material
