// Traces rays against triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// While an object of this class exists, its thread treats denormals as zero.

// Keep one object on every thread that traces, because Embree is much slower with denormals. The destructor
// restores the caller's mode. The class does nothing on processors other than x86 and ARM64.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  std::uint64_t saved_;
};

}  // namespace nook::bake

// Embree's handles. Only ray_scene.cpp includes Embree.
struct RTCDeviceTy;
struct RTCSceneTy;
namespace nook::bake {

// Occluders in world space and metres.
struct TriangleSoup {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

// The first hit of a ray.
struct RayHit {
  float distance = 0;  // in units of the direction's length; infinite if there is no hit
  Vec3 normal;         // geometric normal, unit length, on the side of the ray's origin
  std::uint32_t triangle = ~0u;
  float u = 0, v = 0;        // barycentric weights of the triangle's second and third vertex
  bool from_behind = false;  // true if the ray hit the side from which the vertices appear clockwise
};

// Embree's device. Scenes that are built one after another should share a device, because making a device
// takes longer than making a small scene. You may use it from any thread.
class RayDevice {
 public:
  RayDevice();
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;

 private:
  friend class RayScene;
  RTCDeviceTy* handle_;
};

// Triangles with their BVH. The number of triangles may be 0. You can trace from any thread that has a
// FlushDenormals object.
class RayScene {
 public:
  explicit RayScene(const TriangleSoup& soup);
  RayScene(const RayDevice& device, std::span<const Vec3> positions,
           std::span<const std::array<std::uint32_t, 3>> triangles);
  // Makes a scene with one copy of `original` for each offset. Hits have the triangle indices of `original`.
  RayScene(const RayScene& original, std::span<const Vec3> offsets);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Ignores hits at distances up to and including `beyond`, in units of the direction's length. Both sides of
  // triangles can be hit.
  RayHit nearest(Vec3 origin, Vec3 direction, float beyond = 0) const;
  bool occluded(Vec3 origin, Vec3 direction) const;  // true if any triangle is hit at any distance

  // Traces up to 16 rays from one origin. Bit i of the result is 1 if no triangle is within `reach` along
  // directions[i]. The unit of `reach` is the direction's length.
  static constexpr std::size_t packet_size = 16;
  std::uint32_t open_rays(Vec3 origin, std::span<const Vec3> directions, float reach) const;

 private:
  explicit RayScene(RTCDeviceTy* device);

  RTCDeviceTy* device_;
  RTCSceneTy* scene_;
};

// The bounding box of a set of points.

struct Bounds {
  Vec3 low, high;
};

// `points` must not be empty.
inline Bounds bounds_of(std::span<const Vec3> points) {
  Bounds b{points.front(), points.front()};
  for (const Vec3 p : points) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
  }
  return b;
}

}  // namespace nook::bake
