#include "bakers/raytrace/ray_scene.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace nook::bake {
namespace {

RTCRay unbounded_ray(Vec3 origin, Vec3 direction) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

}  // namespace

void build_scene(RTCDevice device, RTCScene scene, std::span<const Vec3> positions,
                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), positions.size());
  std::memcpy(vertices, positions.data(), positions.size_bytes());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), triangles.size());
  std::memcpy(indices, triangles.data(), triangles.size_bytes());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
}

RayScene::RayScene(const TriangleSoup& soup) : scene_(device_.get()) {
  const FlushDenormals flush;
  if (soup.triangle.empty())
    rtcCommitScene(scene_.get());
  else
    build_scene(device_.get(), scene_.get(), soup.position, soup.triangle);
}

RayHit RayScene::nearest(Vec3 origin, Vec3 direction, float beyond) const {
  alignas(16) RTCRayHit ray{};
  ray.ray = unbounded_ray(origin, direction);
  if (beyond > 0) ray.ray.tnear = std::nextafter(beyond, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect1(scene_.get(), ray);
  RayHit hit;
  hit.distance = std::numeric_limits<float>::infinity();
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  const Vec3 normal = normalised({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
  const bool from_behind = dot(normal, direction) > 0;
  return {ray.ray.tfar, from_behind ? -normal : normal, ray.hit.primID, ray.hit.u, ray.hit.v, from_behind};
}

bool RayScene::occluded(Vec3 origin, Vec3 direction) const {
  alignas(16) RTCRay ray = unbounded_ray(origin, direction);
  occluded1(scene_.get(), ray);
  return ray.tfar < 0;
}

}  // namespace nook::bake
