// Traces ambient occlusion, the reference of all AO in Nook: cosine-weighted visibility over the hemisphere
// around a normal. Both sides of triangles occlude; 1 is open.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Points to evaluate, in world space; normals have unit length.
struct Receivers {
  std::span<const Vec3> position;
  std::span<const Vec3> normal;
  std::span<const float> radius = {};  // metres, replaces the settings' radius; empty: use the settings'
                                       // radius
  std::span<const float> origin_offset =
      {};  // metres, replaces the settings' offset; empty: use the settings' offset
};

struct AoSettings {
  std::uint32_t rays = 64;  // per point
  std::uint64_t seed = 1;
  float radius = std::numeric_limits<float>::infinity();  // metres; hits beyond it count as open
  float origin_offset = 0;                                // metres along the normal
};

// Returns false to stop. Worker threads call it, one call at a time.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns the AO of every receiver against one soup. Threads work on blocks of receivers, and the result does
// not depend on their number. progress counts receivers. Throws Failure(NOOK_ERROR_CANCELLED) if it returns
// false.
std::vector<float> trace_ao(const TriangleSoup& occluders, const Receivers& receivers,
                            const AoSettings& settings, const Progress& progress = {});
std::vector<float> trace_ao(const RayScene& scene, const Receivers& receivers, const AoSettings& settings,
                            const Progress& progress = {});

// The AO of receivers, and the mean direction of their open rays: cosine-weighted, in world space. It is
// shorter the wider the opening is (2/3 over a plane), and zero if no ray is open.
struct Openness {
  std::vector<float> ao;
  std::vector<Vec3> direction;
};
// Returns the same AO as trace_ao, bit for bit.
Openness trace_openness(const RayScene& scene, const Receivers& receivers, const AoSettings& settings);

// Receivers for each task: some 10 ms of work, which bounds the wait of a caller who stops.
inline std::size_t receivers_per_task(std::uint32_t rays) {
  constexpr std::uint32_t most_rays = 1 << 16, most_receivers = 256;
  return std::clamp(most_rays / std::max(rays, 1u), 1u, most_receivers);
}

// The AO targets of a character: poses x vertices in 16-bit fixed point (value / 65535). They take half the
// size of floats, and their step is far below the noise of the rays.
struct AoTargets {
  std::size_t vertex_count = 0;
  std::vector<std::uint16_t> value;
  std::size_t pose_count() const { return vertex_count ? value.size() / vertex_count : 0; }
  std::span<const std::uint16_t> row(std::size_t pose) const {
    return {value.data() + pose * vertex_count, vertex_count};
  }
  static constexpr float scale = 1.0f / 65535.0f;
};

// Distributes poses over all threads, with one BVH for each pose. The same seed gives the same targets on any
// number of threads. Throws Failure(NOOK_ERROR_CANCELLED) if progress returns false.
AoTargets trace_character_ao(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint32_t rays,
                             std::uint64_t seed, const Progress& progress = {});

// Returns the expected squared error of such targets: half the mean squared difference to a second,
// independent tracing of some of the poses.
double measure_noise_floor(const SkinnedMesh& mesh, std::span<const Pose> poses, const AoTargets& targets,
                           std::uint32_t rays, std::uint64_t seed);

// Returns the offset of ray origins for a character: 1e-4 of the diagonal of its rest bounding box.
float ray_origin_offset(std::span<const Vec3> rest_positions);

}  // namespace nook::bake
