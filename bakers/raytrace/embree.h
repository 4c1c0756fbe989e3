// One interface to Embree 3 (Debian 12) and Embree 4 (Debian 13): owned devices and scenes, and the 16-wide
// occlusion call.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <utility>

namespace nook::bake {

class EmbreeDevice {
 public:
  // The device is single-threaded inside. Callers parallelise over scenes, so that results do not depend on
  // Embree's scheduling.
  EmbreeDevice() : handle_(rtcNewDevice("threads=1,set_affinity=0")) {}
  ~EmbreeDevice() { rtcReleaseDevice(handle_); }
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;
  RTCDevice get() const { return handle_; }

 private:
  RTCDevice handle_;
};

class EmbreeScene {
 public:
  explicit EmbreeScene(RTCDevice device) : handle_(rtcNewScene(device)) {}
  ~EmbreeScene() { rtcReleaseScene(handle_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  RTCScene get() const { return handle_; }

 private:
  RTCScene handle_;
};

// Tests 16 rays for occlusion; tfar of an occluded ray becomes -infinity.
inline void occluded16(RTCScene scene, const int* valid, RTCRay16& rays) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded16(valid, scene, &rays, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, &rays);
#endif
}

// Tests one ray for occlusion; tfar of an occluded ray becomes -infinity.
inline void occluded1(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

// Finds the nearest hit of a ray; both sides of triangles count.
inline void intersect1(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#endif
}

}  // namespace nook::bake
