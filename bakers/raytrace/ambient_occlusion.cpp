#include "bakers/raytrace/ambient_occlusion.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/stand_ins.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// If open_sum is not null, it receives the sum of the directions of open rays.
float trace_point(const RayScene& scene, Vec3 position, Vec3 normal, const HemispherePatterns& patterns,
                  float radius, float origin_offset, std::uint64_t random, Vec3* open_sum = nullptr) {
  const float angle = 6.2831853f * unit_float(random);
  const Frame frame = turned_frame(normal, std::cos(angle), std::sin(angle));
  const Vec3* local = patterns.pattern(std::uint32_t(random));
  const Vec3 origin = position + origin_offset * normal;
  const std::uint32_t rays = patterns.rays();
  int open = 0;
  std::array<Vec3, RayScene::packet_size> direction;
  for (std::uint32_t first = 0; first < rays; first += std::uint32_t(direction.size())) {
    const std::uint32_t count = std::min(rays - first, std::uint32_t(direction.size()));
    for (std::uint32_t i = 0; i < count; ++i) direction[i] = to_world(frame, local[first + i]);
    const std::uint32_t is_open = scene.open_rays(origin, {direction.data(), count}, radius);
    open += std::popcount(is_open);
    if (open_sum)
      for (std::uint32_t i = 0; i < count; ++i)
        if (is_open >> i & 1) *open_sum += direction[i];
  }
  return float(open) / float(rays);
}

// Counts the finished work and reports it to the caller's progress function, which can stop the work.
class Pace {
 public:
  Pace(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

  bool is_stopped() const { return stopped_; }
  void add(std::size_t count) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    done_ += count;
    if (!stopped_ && !progress_(done_, total_)) stopped_ = true;
  }
  // Call this after all workers have ended. `what` names the things that are counted.
  void throw_if_stopped(const char* what) const {
    if (stopped_)
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu %s done)", done_, total_,
                    what);
  }

 private:
  const Progress& progress_;
  std::size_t total_, done_ = 0;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
};

// `direction` may be empty.
void trace_receivers(const RayScene& scene, const Receivers& receivers, const AoSettings& settings,
                     std::span<float> ao, std::span<Vec3> direction, const Progress& progress = {}) {
  const HemispherePatterns patterns(settings.rays, settings.seed);
  Pace pace(progress, ao.size());
  const auto trace = [&](const auto& range) {
    if (pace.is_stopped()) return;
    const FlushDenormals flush;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const float radius = receivers.radius.empty() ? settings.radius : receivers.radius[i];
      const float offset =
          receivers.origin_offset.empty() ? settings.origin_offset : receivers.origin_offset[i];
      Vec3 open_sum;
      ao[i] = trace_point(scene, receivers.position[i], receivers.normal[i], patterns, radius, offset,
                          mix_bits(settings.seed ^ mix_bits(i)), direction.empty() ? nullptr : &open_sum);
      if (!direction.empty() && ao[i] > 0) direction[i] = open_sum * (1 / (ao[i] * float(settings.rays)));
    }
    pace.add(range.size());
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ao.size(), receivers_per_task(settings.rays)), trace,
                    tbb::simple_partitioner());
  pace.throw_if_stopped("points");
}

constexpr float unlimited = std::numeric_limits<float>::infinity();

// The vertices of a mesh in a pose.
struct PosedSurface {
  std::vector<Vec3> position, normal;
  std::vector<float> ao;

  void pose(const SkinnedMesh& mesh, const Pose& pose) {
    skin_positions(mesh, pose, position);
    posed_normals(mesh, pose, position, normal);
  }
};

float trace_surface_point(const RayScene& scene, const PosedSurface& surface, const SurfacePoint& point,
                          const HemispherePatterns& patterns, float offset, std::uint64_t random) {
  Vec3 position, normal;
  for (int i = 0; i < 3; ++i) {
    position += point.weight[i] * surface.position[point.vertex[i]];
    normal += point.weight[i] * surface.normal[point.vertex[i]];
  }
  if (!(length(normal) > 0)) return 0;
  return trace_point(scene, position, normalised(normal), patterns, unlimited, offset, random);
}

// Returns the AO of a hidden vertex that makes interpolation come closest to the AO of its visible stand-ins,
// by least squares. `own` contains the AO of all vertices. Other hidden vertices of a triangle are assumed to
// have the same unknown AO. Returns `least` if no stand-in is visible.
float shown_ao(const RayScene& scene, const PosedSurface& surface, std::span<const StandIns::Point> points,
               std::span<const float> own, float least, const HemispherePatterns& patterns, float offset,
               std::uint64_t random) {
  float products = 0, squares = 0;
  for (const StandIns::Point& point : points) {
    random = mix_bits(random);
    float rest = trace_surface_point(scene, surface, point.at, patterns, offset, random), unknown = 0;
    if (rest < hidden_below) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const float ao = own[point.at.vertex[i]];
      if (ao < hidden_below)
        unknown += point.at.weight[i];
      else
        rest -= point.at.weight[i] * ao;
    }
    products += point.weight * unknown * rest;
    squares += point.weight * unknown * unknown;
  }
  return squares > 0 ? std::clamp(products / squares, 0.0f, 1.0f) : least;
}

// For each vertex, returns points at a quarter, half and three quarters of its edges, and the centroids of
// its triangles. The vertex is the first one of each point's triangle. The weight of a point is the length of
// its edge. For a centroid, it is the square root of the triangle's area.
StandIns all_stand_ins(const SkinnedMesh& mesh) {
  std::vector<std::vector<StandIns::Point>> points(mesh.vertex_count());
  for (const auto& t : mesh.triangle) {
    const Vec3 a = mesh.position[t[0]], b = mesh.position[t[1]], c = mesh.position[t[2]];
    const float size = std::sqrt(0.5f * length(cross(b - a, c - a)));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = t[corner], next = t[(corner + 1) % 3], last = t[(corner + 2) % 3];
      // An inner edge belongs to two triangles, which contain it in opposite directions. Each triangle adds
      // it for one vertex, so each vertex gets the edge once.
      const float edge = length(mesh.position[next] - mesh.position[v]);
      for (const float along : {0.25f, 0.5f, 0.75f})
        points[v].push_back({{{v, next, last}, {1 - along, along, 0}}, edge});
      points[v].push_back({{{v, next, last}, {1 / 3.0f, 1 / 3.0f, 1 / 3.0f}}, size});
    }
  }
  StandIns all;
  for (const auto& own : points) {
    all.first.push_back(std::uint32_t(all.points.size()));
    all.points.insert(all.points.end(), own.begin(), own.end());
  }
  all.first.push_back(std::uint32_t(all.points.size()));
  return all;
}

// Adds up the weights of each point over the poses in which it is visible and its vertex is hidden.
std::vector<float> count_uses(const SkinnedMesh& mesh, std::span<const Pose> poses, const StandIns& all,
                              std::uint64_t seed, const Progress& progress) {
  constexpr std::uint32_t rays = 32;
  constexpr std::size_t vertices_per_task = 32;  // one hidden vertex traces tens of points
  const float offset = ray_origin_offset(mesh.position);
  const HemispherePatterns patterns(rays, seed);
  const RayDevice device;
  std::vector<float> uses(all.points.size());
  Pace pace(progress, poses.size());
  for (std::size_t p = 0; p < poses.size() && !pace.is_stopped(); ++p) {
    PosedSurface surface;
    surface.pose(mesh, poses[p]);
    const RayScene scene(device, surface.position, mesh.triangle);
    const auto count = [&](std::size_t v) {
      std::uint64_t random = mix_bits(mix_bits(seed + p) ^ v);
      if (trace_point(scene, surface.position[v], surface.normal[v], patterns, unlimited, offset, random) >=
          hidden_below)
        return;
      for (std::uint32_t i = all.first[v]; i < all.first[v + 1]; ++i) {
        random = mix_bits(random);
        if (trace_surface_point(scene, surface, all.points[i].at, patterns, offset, random) >= hidden_below)
          uses[i] += all.points[i].weight * all.points[i].at.weight[0];
      }
    };
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, mesh.vertex_count(), vertices_per_task),
        [&](const auto& range) {
          if (pace.is_stopped()) return;
          const FlushDenormals flush;
          for (std::size_t v = range.begin(); v < range.end(); ++v) count(v);
          pace.add(0);
        },
        tbb::simple_partitioner());
  }
  pace.throw_if_stopped("poses");
  return uses;
}

}  // namespace

StandIns choose_stand_ins(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint64_t seed) {
  return choose_stand_ins(mesh, poses, seed, {});
}

StandIns choose_stand_ins(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint64_t seed,
                          const Progress& progress) {
  constexpr std::size_t most_poses = 24, most_points = 4;
  std::vector<Pose> sample;
  const std::size_t count = std::min(most_poses, poses.size());
  for (std::size_t i = 0; i < count; ++i) sample.push_back(poses[i * poses.size() / count]);
  const StandIns all = all_stand_ins(mesh);
  const Progress no_pose_yet = [&](std::size_t, std::size_t) {
    return !progress || progress(0, poses.size());
  };
  const std::vector<float> uses = count_uses(mesh, sample, all, seed, no_pose_yet);
  StandIns chosen;
  std::vector<std::uint32_t> order;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    chosen.first.push_back(std::uint32_t(chosen.points.size()));
    order.clear();
    for (std::uint32_t i = all.first[v]; i < all.first[v + 1]; ++i)
      if (uses[i] > 0) order.push_back(i);
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::uint32_t i) { return uses[i]; });
    order.resize(std::min(order.size(), most_points));
    for (const std::uint32_t i : order) chosen.points.push_back(all.points[i]);
  }
  chosen.first.push_back(std::uint32_t(chosen.points.size()));
  return chosen;
}

float ray_origin_offset(std::span<const Vec3> rest_positions) {
  Vec3 low = rest_positions.front(), high = low;
  for (Vec3 p : rest_positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 1e-4f * length(high - low);
}

std::vector<float> trace_ao(const TriangleSoup& occluders, const Receivers& receivers,
                            const AoSettings& settings, const Progress& progress) {
  return trace_ao(RayScene(occluders), receivers, settings, progress);
}

std::vector<float> trace_ao(const RayScene& scene, const Receivers& receivers, const AoSettings& settings,
                            const Progress& progress) {
  std::vector<float> ao(receivers.position.size());
  trace_receivers(scene, receivers, settings, ao, {}, progress);
  return ao;
}

Openness trace_openness(const RayScene& scene, const Receivers& receivers, const AoSettings& settings) {
  const std::size_t count = receivers.position.size();
  Openness open{std::vector<float>(count), std::vector<Vec3>(count)};
  trace_receivers(scene, receivers, settings, open.ao, open.direction);
  return open;
}

AoTargets trace_character_ao(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint32_t rays,
                             std::uint64_t seed, const Progress& progress, const StandIns& stand_ins) {
  AoTargets targets;
  targets.vertex_count = mesh.vertex_count();
  targets.value.resize(poses.size() * mesh.vertex_count());
  const float offset = ray_origin_offset(mesh.position);
  const HemispherePatterns patterns(rays, seed);
  const RayDevice device;
  tbb::enumerable_thread_specific<PosedSurface> workspaces;
  Pace pace(progress, poses.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, poses.size(), 1),
      [&](const auto& range) {
        const FlushDenormals flush;
        PosedSurface& work = workspaces.local();
        for (std::size_t p = range.begin(); p < range.end() && !pace.is_stopped(); ++p) {
          work.pose(mesh, poses[p]);
          const RayScene scene(device, work.position, mesh.triangle);
          work.ao.resize(targets.vertex_count);
          const auto random_of = [&](std::size_t v) { return mix_bits(mix_bits(seed + p) ^ v); };
          for (std::size_t v = 0; v < targets.vertex_count; ++v)
            work.ao[v] = trace_point(scene, work.position[v], work.normal[v], patterns, unlimited, offset,
                                     random_of(v));
          std::uint16_t* row = &targets.value[p * targets.vertex_count];
          for (std::size_t v = 0; v < targets.vertex_count; ++v) {
            float ao = work.ao[v];
            if (ao < hidden_below)
              ao = shown_ao(scene, work, stand_ins.of(v), work.ao, ao, patterns, offset, random_of(v));
            row[v] = std::uint16_t(std::lround(ao * 65535));
          }
          pace.add(1);
        }
      },
      tbb::simple_partitioner());
  pace.throw_if_stopped("poses");
  return targets;
}

double measure_noise_floor(const SkinnedMesh& mesh, std::span<const Pose> poses, const AoTargets& targets,
                           std::uint32_t rays, std::uint64_t seed, const StandIns& stand_ins) {
  constexpr std::size_t sample_poses = 8;
  std::vector<Pose> sample;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < std::min(sample_poses, poses.size()); ++i) {
    index.push_back(i * poses.size() / std::min(sample_poses, poses.size()));
    sample.push_back(poses[index.back()]);
  }
  const AoTargets again = trace_character_ao(mesh, sample, rays, mix_bits(~seed), {}, stand_ins);
  double sum = 0;
  for (std::size_t s = 0; s < sample.size(); ++s)
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      const double d =
          (double(again.row(s)[i]) - double(targets.row(index[s])[i])) * double(AoTargets::scale);
      sum += d * d;
    }
  return 0.5 * sum / (double(sample.size()) * double(mesh.vertex_count()));
}

}  // namespace nook::bake
