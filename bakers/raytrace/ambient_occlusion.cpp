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

// Counts the finished work, and lets the caller's progress function stop it.
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

}  // namespace

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
                             std::uint64_t seed, const Progress& progress) {
  AoTargets targets;
  targets.vertex_count = mesh.vertex_count();
  targets.value.resize(poses.size() * mesh.vertex_count());
  const float offset = ray_origin_offset(mesh.position);
  const HemispherePatterns patterns(rays, seed);
  const RayDevice device;
  struct Workspace {
    std::vector<Vec3> position, normal;
  };
  tbb::enumerable_thread_specific<Workspace> workspaces;
  Pace pace(progress, poses.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, poses.size(), 1),
      [&](const auto& range) {
        const FlushDenormals flush;
        Workspace& work = workspaces.local();
        for (std::size_t p = range.begin(); p < range.end() && !pace.is_stopped(); ++p) {
          skin_positions(mesh, poses[p], work.position);
          posed_normals(mesh, poses[p], work.position, work.normal);
          const RayScene scene(device, work.position, mesh.triangle);
          std::uint16_t* row = &targets.value[p * targets.vertex_count];
          for (std::size_t v = 0; v < targets.vertex_count; ++v) {
            const std::uint64_t random = mix_bits(mix_bits(seed + p) ^ v);
            const float ao = trace_point(scene, work.position[v], work.normal[v], patterns,
                                         std::numeric_limits<float>::infinity(), offset, random);
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
                           std::uint32_t rays, std::uint64_t seed) {
  constexpr std::size_t sample_poses = 8;
  std::vector<Pose> sample;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < std::min(sample_poses, poses.size()); ++i) {
    index.push_back(i * poses.size() / std::min(sample_poses, poses.size()));
    sample.push_back(poses[index.back()]);
  }
  const AoTargets again = trace_character_ao(mesh, sample, rays, mix_bits(~seed));
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
