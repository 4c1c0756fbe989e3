#include "bakers/raytrace/ray_scene.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <pmmintrin.h>
#elif defined(_M_ARM64)
#include <intrin.h>
#endif
namespace nook::bake {
namespace {

// These functions read and write the processor's floating-point control register. flush_bits are the bits
// that flush inputs and results to zero.
#if defined(__SSE2__) || defined(_M_X64)

constexpr std::uint64_t flush_bits = _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON;

std::uint64_t floating_point_mode() {
  return _mm_getcsr();
}
void set_floating_point_mode(std::uint64_t mode) {
  _mm_setcsr(unsigned(mode));
}

#elif defined(__aarch64__) || defined(_M_ARM64)

// The bit FPCR.FZ. GCC and Clang have no header for this register, so we use inline assembly.
constexpr std::uint64_t flush_bits = std::uint64_t(1) << 24;

std::uint64_t floating_point_mode() {
#if defined(_M_ARM64)
  return std::uint64_t(_ReadStatusReg(ARM64_FPCR));
#else
  std::uint64_t mode;
  __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
  return mode;
#endif
}
void set_floating_point_mode(std::uint64_t mode) {
#if defined(_M_ARM64)
  _WriteStatusReg(ARM64_FPCR, __int64(mode));
#else
  __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
#endif
}

#else

constexpr std::uint64_t flush_bits = 0;

std::uint64_t floating_point_mode() {
  return 0;
}
void set_floating_point_mode(std::uint64_t) {}

#endif

}  // namespace

FlushDenormals::FlushDenormals() : saved_(floating_point_mode()) {
  set_floating_point_mode(saved_ | flush_bits);
}

FlushDenormals::~FlushDenormals() {
  set_floating_point_mode(saved_);
}

}  // namespace nook::bake

// Debian 12 has Embree 3, Debian 13 has Embree 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "bakers/raytrace/instruction_set.h"
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

// Embree sets tfar of an occluded ray to -infinity.
void occluded16(RTCScene scene, const int* valid, RTCRay16& rays) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded16(valid, scene, &rays, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, &rays);
#endif
}

void occluded1(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

void intersect1(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#endif
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void attach_triangles(RTCDevice device, RTCScene scene, std::span<const Vec3> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), positions.size());
  std::memcpy(vertices, positions.data(), positions.size_bytes());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), triangles.size());
  std::memcpy(indices, triangles.data(), triangles.size_bytes());
  attach(scene, geometry);
}

}  // namespace

// The device uses one thread. Callers parallelise over scenes, so that results do not depend on Embree's
// scheduling.
RayDevice::RayDevice()
    : handle_(rtcNewDevice((std::string("threads=1,set_affinity=0") + embree_isa()).c_str())) {}

RayDevice::~RayDevice() {
  rtcReleaseDevice(handle_);
}

RayScene::RayScene(RTCDevice device) : device_(device), scene_(rtcNewScene(device)) {
  rtcRetainDevice(device);
}

RayScene::RayScene(const TriangleSoup& soup) : RayScene(RayDevice(), soup.position, soup.triangle) {}

RayScene::RayScene(const RayDevice& device, std::span<const Vec3> positions,
                   std::span<const std::array<std::uint32_t, 3>> triangles)
    : RayScene(device.handle_) {
  const FlushDenormals flush;
  if (!triangles.empty()) attach_triangles(device_, scene_, positions, triangles);
  rtcCommitScene(scene_);
}

RayScene::RayScene(const RayScene& original, std::span<const Vec3> offsets) : RayScene(original.device_) {
  const FlushDenormals flush;
  for (Vec3 offset : offsets) {
    RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, original.scene_);
    const float columns[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, offset.x, offset.y, offset.z};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach(scene_, instance);
  }
  rtcCommitScene(scene_);
}

RayScene::~RayScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

RayHit RayScene::nearest(Vec3 origin, Vec3 direction, float beyond) const {
  alignas(16) RTCRayHit ray{};
  ray.ray = unbounded_ray(origin, direction);
  if (beyond > 0) ray.ray.tnear = std::nextafter(beyond, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect1(scene_, ray);
  RayHit hit;
  hit.distance = std::numeric_limits<float>::infinity();
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  const Vec3 normal = normalised({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
  const bool from_behind = dot(normal, direction) > 0;
  return {ray.ray.tfar, from_behind ? -normal : normal, ray.hit.primID, ray.hit.u, ray.hit.v, from_behind};
}

bool RayScene::occluded(Vec3 origin, Vec3 direction) const {
  alignas(16) RTCRay ray = unbounded_ray(origin, direction);
  occluded1(scene_, ray);
  return ray.tfar < 0;
}

std::uint32_t RayScene::open_rays(Vec3 origin, std::span<const Vec3> directions, float reach) const {
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[packet_size];
  for (std::uint32_t lane = 0; lane < packet_size; ++lane) {
    const bool used = lane < directions.size();
    const Vec3 direction = used ? directions[lane] : Vec3{0, 0, 1};
    valid[lane] = used ? -1 : 0;
    packet.org_x[lane] = origin.x;
    packet.org_y[lane] = origin.y;
    packet.org_z[lane] = origin.z;
    packet.dir_x[lane] = direction.x;
    packet.dir_y[lane] = direction.y;
    packet.dir_z[lane] = direction.z;
    packet.tnear[lane] = 0;
    packet.tfar[lane] = used ? reach : -1;
    packet.time[lane] = 0;
    packet.mask[lane] = ~0u;
    packet.id[lane] = lane;
    packet.flags[lane] = 0;
  }
  occluded16(scene_, valid, packet);
  std::uint32_t open = 0;
  for (std::uint32_t lane = 0; lane < directions.size(); ++lane)
    open |= std::uint32_t(packet.tfar[lane] >= 0) << lane;
  return open;
}

std::string embree_version() {
  const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  const auto number = long(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION));
  rtcReleaseDevice(device);
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." +
         std::to_string(number % 100);
}

}  // namespace nook::bake
