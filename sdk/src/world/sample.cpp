#include "sdk/src/world/sample.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/world/world_kernels.h"

namespace nook::world {

const WorldKernels* world_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::world_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

namespace {

// The number of points that are evaluated together. It is a multiple of the width of every vector type, and
// small enough for arrays on the stack.
constexpr std::uint32_t block_points = 128;

struct Block {
  alignas(64) float x[block_points], y[block_points], z[block_points];
  alignas(64) float nx[block_points], ny[block_points], nz[block_points];
  alignas(64) float open[block_points];
  alignas(64) float part[cone_parts][block_points];
  alignas(64) float gathered[GatheredSoa::lanes][block_points];
  alignas(64) float rgb[3][block_points];
  bool sound[block_points];
  std::uint32_t count = 0;
  Vec3 centre;  // centre of a sphere that contains the points
  float radius = 0;

  GatheredSoa terms() {
    GatheredSoa soa;
    for (int lane = 0; lane < GatheredSoa::lanes; ++lane) soa.lane[lane] = gathered[lane];
    return soa;
  }
  PointSoa points() const { return {x, y, z, nx, ny, nz, block_points}; }
};

void load_points(const SampleRequest& request, std::uint32_t first, Block& block) {
  block.count = std::min(block_points, request.count - first);
  Vec3 low, high;
  bool any = false;
  for (std::uint32_t i = 0; i < block_points; ++i) {
    const bool used = i < block.count;
    Vec3 p, n{0, 1, 0};
    block.sound[i] = false;
    if (used) {
      const float* const at = request.positions + (first + i) * request.stride;
      const float* const facing = request.normals + (first + i) * request.stride;
      const Vec3 position{at[0], at[1], at[2]}, normal{facing[0], facing[1], facing[2]};
      // The sum is finite only if every coordinate is finite.
      const float sum = (std::abs(position.x) + std::abs(position.y) + std::abs(position.z)) +
                        (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
      if (sum < 1e15f) {
        block.sound[i] = true;
        p = position;
        n = normal;
      }
    }
    if (block.sound[i]) {
      low = any ? Vec3{std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)} : p;
      high = any ? Vec3{std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)} : p;
      any = true;
    }
    block.x[i] = p.x;
    block.y[i] = p.y;
    block.z[i] = p.z;
    block.nx[i] = n.x;
    block.ny[i] = n.y;
    block.nz[i] = n.z;
  }
  block.centre = 0.5f * (low + high);
  block.radius = 0.5f * length(high - low);
}

// Returns true if the casters may reduce AO by cutoff_error or more at some point of the block. Returns false
// if a value is NaN.
bool reaches(const CasterGroup& group, const Block& block, float cutoff_error) {
  const float gap = length(group.centre - block.centre) - group.radius - block.radius;
  if (gap <= 0) return true;
  return group.strength >= cutoff_error * gap * gap;
}

// Returns true if the casters may hide a part of the cone at some point of the block. The parts of a cone
// extend beyond the cone's edge by at most half their width.
bool stands_before(const CasterGroup& group, const Block& block, const SampleRequest& request, float wide) {
  const Vec3 d = group.centre - block.centre;
  const float reach = group.radius + block.radius, distance = length(d);
  if (distance <= reach) return true;
  if (!(distance > 0)) return false;
  const float apart = std::acos(std::clamp(dot(d, request.light_axis) / distance, -1.0f, 1.0f));
  return apart <= wide + std::asin(std::min(reach / distance, 1.0f));
}

}  // namespace

void sample(const WorldKernels& kernels, const Parallel& parallel, const SampleRequest& request,
            const CasterGroups& groups, float* ao, float* light, float* rgb) noexcept {
  ConeParts parts;
  const bool lit = request.has_light && light, coloured = request.terms && rgb;
  if (lit) parts = cone_parts_of(request.light_axis, request.light_half_angle_radians);
  // A thin capsule is treated as a rectangle. The corners of the rectangle extend beyond the round ends by
  // less than a third of a part.
  const float wide = request.light_half_angle_radians + 2 * std::atan(parts.slope);
  const auto run = [&](std::uint32_t index) noexcept {
    Block block;
    const std::uint32_t first = index * block_points;
    load_points(request, first, block);
    std::fill_n(block.open, block_points, 1.0f);
    const GatheredSoa gathered = block.terms();
    if (coloured)
      for (float* const lane : gathered.lane) std::fill_n(lane, block_points, 0.0f);
    if (lit)
      for (auto& part : block.part) std::fill_n(part, block_points, 1.0f);
    for (std::uint32_t g = 0; g < groups.count; ++g) {
      PosedCaster room;
      const CasterGroup group = groups.group(groups.user, g, room);
      const auto count = static_cast<std::uint32_t>(group.casters.size());
      if (count == 0) continue;
      if ((ao || coloured) && reaches(group, block, request.cutoff_error)) {
        if (coloured)
          kernels.gather_hemisphere(group.casters.data(), count, block.points(), block.open, gathered);
        else
          kernels.open_hemisphere(group.casters.data(), count, block.points(), block.open);
      }
      if (lit && stands_before(group, block, request, wide))
        for (int p = 0; p < cone_parts; ++p)
          kernels.open_part(group.casters.data(), count, block.points(), parts.axis[p], parts.slope,
                            block.part[p]);
    }
    float* const channels[3] = {block.rgb[0], block.rgb[1], block.rgb[2]};
    if (coloured) kernels.open_light(*request.terms, block.points(), gathered, block.open, channels);
    for (std::uint32_t i = 0; i < block.count; ++i) {
      if (coloured)
        for (std::size_t c = 0; c < 3; ++c)
          rgb[3 * std::size_t{first + i} + c] = block.sound[i] ? channels[c][i] : 1.0f;
      if (ao) ao[first + i] = block.sound[i] ? std::clamp(block.open[i], 0.0f, 1.0f) : 1.0f;
      if (!lit) continue;
      float sum = 0;
      for (const auto& part : block.part) sum += part[i];
      light[first + i] = block.sound[i] ? std::clamp(sum / float(cone_parts), 0.0f, 1.0f) : 1.0f;
    }
  };
  parallel_for(parallel, (request.count + block_points - 1) / block_points, run);
}

}  // namespace nook::world
