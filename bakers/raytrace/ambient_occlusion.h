// Traces ambient occlusion, the reference for all AO in Nook. AO is the cosine-weighted visibility over the
// hemisphere around a normal; 1 is open. Both sides of triangles occlude.
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
  std::span<const float> radius = {};         // per receiver, metres; empty: use the radius of the settings
  std::span<const float> origin_offset = {};  // per receiver, metres; empty: use the offset of the settings
};

struct AoSettings {
  std::uint32_t rays = 64;  // per point
  std::uint64_t seed = 1;
  float radius = std::numeric_limits<float>::infinity();  // metres; hits beyond this distance count as open
  float origin_offset = 0;                                // metres along the normal
};

// Worker threads call the function, but never two at the same time. Return false to stop.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns the AO of every receiver in a scene of triangles. Threads work on blocks of receivers. The result
// does not depend on the number of threads. `progress` counts receivers. Throws Failure(NOOK_ERROR_CANCELLED)
// if `progress` returns false.
std::vector<float> trace_ao(const TriangleSoup& occluders, const Receivers& receivers,
                            const AoSettings& settings, const Progress& progress = {});
std::vector<float> trace_ao(const RayScene& scene, const Receivers& receivers, const AoSettings& settings,
                            const Progress& progress = {});

// The AO of receivers, and the cosine-weighted mean direction of their open rays in world space. The wider
// the opening, the shorter the vector. Over an infinite plane, its length is 2/3. It is zero if no ray is
// open.
struct Openness {
  std::vector<float> ao;
  std::vector<Vec3> direction;
};
// The AO is the same as from trace_ao, bit for bit.
Openness trace_openness(const RayScene& scene, const Receivers& receivers, const AoSettings& settings);

// Returns the number of receivers per task. A task takes about 10 ms, so a caller that cancels waits no
// longer than that.
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

// A vertex is hidden in a pose if its traced AO is below this value. Such a vertex is inside the body or in a
// fist. Two open rays of 128 are enough to reach the value.
inline constexpr float hidden_below = 0.01f;

// A point on a triangle. It moves with the triangle's vertices.
struct SurfacePoint {
  std::array<std::uint32_t, 3> vertex{};
  std::array<float, 3> weight{};  // barycentric
};

// Points that stand in for hidden vertices. No camera sees a hidden vertex, but renderers interpolate its AO
// over its triangles. Parts of these triangles may be visible, for example on a rod whose ends are inside
// joints, or on a leg under a hem. With the vertex's own AO of 0, these parts would be black.
struct StandIns {
  struct Point {
    SurfacePoint at;
    float weight = 0;  // weight among the visible points of a vertex: the size of the edge or the triangle
  };
  std::vector<std::uint32_t> first;  // index of the first point of each vertex, and the end; empty: no points
  std::vector<Point> points;

  std::span<const Point> of(std::size_t vertex) const {
    if (first.empty()) return {};
    return {points.data() + first[vertex], points.data() + first[vertex + 1]};
  }
};

// Looks for hidden vertices in at most 24 of the poses, and for points on their edges and triangles that are
// visible in the same poses. Keeps up to 4 points for each vertex. A vertex that is hidden only in other
// poses gets no points. The same seed gives the same points on any number of threads.
StandIns choose_stand_ins(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint64_t seed);

// Traces poses in parallel, with one BVH per pose. The target of a hidden vertex is the AO that makes
// interpolation come closest to its visible stand-ins (least squares), or its own AO if no stand-in is
// visible. Pass stand-ins when you fit a model to the targets. Pass none when you measure errors against
// them. The same seed gives the same targets on any number of threads. Throws Failure(NOOK_ERROR_CANCELLED)
// if progress returns false.
AoTargets trace_character_ao(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint32_t rays,
                             std::uint64_t seed, const Progress& progress = {},
                             const StandIns& stand_ins = {});

// Returns the expected squared error of these targets. It is half the mean squared difference between the
// targets and a second, independent trace of some of the poses.
double measure_noise_floor(const SkinnedMesh& mesh, std::span<const Pose> poses, const AoTargets& targets,
                           std::uint32_t rays, std::uint64_t seed, const StandIns& stand_ins = {});

// Returns the offset of ray origins for a character: 1e-4 of the diagonal of its bounding box at rest.
float ray_origin_offset(std::span<const Vec3> rest_positions);

}  // namespace nook::bake
