// Triangles for ray tracing, and the camera rays of a picture.
#pragma once

#include <pmmintrin.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/embree.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Occluders in world space and metres.
struct TriangleSoup {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

// Embree needs denormals flushed on every thread that traces. The caller's mode is restored afterwards.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

void build_scene(RTCDevice device, RTCScene scene, std::span<const Vec3> positions,
                 std::span<const std::array<std::uint32_t, 3>> triangles);

// The first hit of a ray.
struct RayHit {
  float distance = 0;  // in lengths of the ray's direction; infinite if there is no hit
  Vec3 normal;         // geometric, unit length, against the ray
  std::uint32_t triangle = ~0u;
  float u = 0, v = 0;        // barycentric weights of the triangle's second and third vertex
  bool from_behind = false;  // the ray hit the side from which the vertices are clockwise
};

// A soup with its BVH, which may be empty. Any thread may trace.
class RayScene {
 public:
  explicit RayScene(const TriangleSoup& soup);
  RTCScene get() const { return scene_.get(); }
  // Hits up to and at `beyond`, in lengths of the direction, do not count.
  RayHit nearest(Vec3 origin, Vec3 direction, float beyond = 0) const;
  bool occluded(Vec3 origin, Vec3 direction) const;  // by any triangle at any distance

 private:
  EmbreeDevice device_;
  EmbreeScene scene_;
};

}  // namespace nook::bake
