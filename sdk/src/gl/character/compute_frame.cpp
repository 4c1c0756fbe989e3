#include "sdk/src/gl/character/compute_frame.h"

#include <cstring>

#include "sdk/src/core/bit_cast.h"
#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

struct Word4 {
  std::uint32_t x = 0, y = 0, z = 0, w = 0;
};

Word4 floats(Vec3 v, std::uint32_t w) {
  return {bit_cast<std::uint32_t>(v.x), bit_cast<std::uint32_t>(v.y), bit_cast<std::uint32_t>(v.z), w};
}

// Positions are sent relative to this point of the instance.
Vec3 origin(const Instance& instance) {
  return instance.input.bound.centre;
}

std::uint32_t exact_count(const Instance& instance) {
  return static_cast<std::uint32_t>(instance.plan.occluders.size()) +
         (instance.plan.ground_sphere.radius > 0);
}

// Calls visit(slot) for the instances that are evaluated, level by level, then for those that only moved.
template <class Visit>
void for_selected(const Scene& scene, const ComputeChunk& chunk, Visit&& visit) {
  for (std::uint32_t level = 0; level < chunk.model->level_count(); ++level)
    for (const std::uint32_t slot : chunk.slots)
      if (slot != ComputeChunk::empty && scene.instances[slot].plan.due &&
          scene.instances[slot].plan.level == level)
        visit(slot);
  for (std::uint32_t place = 0; place < chunk.capacity; ++place) {
    const std::uint32_t slot = chunk.slots[place];
    if (slot == ComputeChunk::empty || scene.instances[slot].plan.due) continue;
    if (chunk.transformed[place] != pose_of(scene.instances[slot])) visit(slot);
  }
}

std::uint64_t aligned(const Device& device, std::uint64_t offset) {
  return (offset + device.storage_alignment - 1) / device.storage_alignment * device.storage_alignment;
}

// The bytes that the whole frame takes.
std::uint64_t lay_out(const Device& device, ComputeScene& placed) {
  const Scene& scene = *placed.scene;
  std::uint64_t end = 0;
  for (ComputeChunk& chunk : placed.chunks) {
    ComputeChunk::Frame& frame = chunk.frame;
    frame = {};
    std::uint64_t caster_words = 0;
    for_selected(scene, chunk, [&](std::uint32_t slot) {
      const Instance& instance = scene.instances[slot];
      ++frame.selected;
      if (!instance.plan.due) return;
      ++frame.due;
      frame.lit += instance.light.count > 0;
      ++frame.due_at_level[instance.plan.level];
      caster_words += NOOK_CASTER_UVEC4S * instance.plan.casters.size() + exact_count(instance);
    });
    frame.records = aligned(device, end);
    frame.bones = aligned(device, frame.records + frame.selected * sizeof(InstanceRecord));
    frame.casters =
        aligned(device, frame.bones + std::uint64_t{frame.selected} * chunk.model->bones() * sizeof(Mat3x4));
    // A bound range may not be empty.
    frame.caster_bytes = (caster_words + 1) * sizeof(Word4);
    if (frame.caster_bytes > device.max_piece_bytes)
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "the links of a chunk need %llu bytes, this OpenGL allows %llu; link fewer instances",
                    static_cast<unsigned long long>(frame.caster_bytes),
                    static_cast<unsigned long long>(device.max_piece_bytes));
    end = frame.selected ? frame.casters + frame.caster_bytes : end;
  }
  return end;
}

void write_pose(const Instance& instance, Mat3x4* out) {
  const Vec3 from = origin(instance);
  for (const Mat3x4& bone : instance.input.bones) {
    Mat3x4 relative = bone;
    relative.m[3] -= from.x;
    relative.m[7] -= from.y;
    relative.m[11] -= from.z;
    std::memcpy(out++, &relative, sizeof relative);
  }
}

Word4 exact_sphere(const Instance& receiver, const Sphere& sphere) {
  return floats(sphere.centre - origin(receiver),
                bit_cast<std::uint32_t>(inverse_sphere_radius(sphere.radius)));
}

std::uint32_t first_sphere(const ComputeScene& placed, std::uint32_t slot) {
  const Placement<ComputeChunk>& placement = placed.placements[slot];
  return placement.chunk->first_sphere + placement.place * placement.chunk->model->spheres();
}

// Casters are seen at the receiver's level. Appends the casters of an instance from `next` on and describes
// them in the record.
void write_casters(const ComputeScene& placed, const Instance& instance, Word4* casters, std::uint32_t& next,
                   InstanceRecord& record) {
  const Scene& scene = *placed.scene;
  record.first_caster = next;
  record.caster_count = static_cast<std::uint32_t>(instance.plan.casters.size());
  for (const std::uint32_t slot : instance.plan.casters) {
    const Instance& caster = scene.instances[slot];
    const LevelRange& level = placed.placements[slot].chunk->model->level(instance.plan.level);
    casters[next++] =
        floats(origin(caster) - origin(instance), first_sphere(placed, slot) + level.first_sphere);
    casters[next++] = {level.spheres, 0, 0, 0};
  }
  record.first_exact = next;
  record.exact_count = exact_count(instance);
  if (instance.plan.ground_sphere.radius > 0)
    casters[next++] = exact_sphere(instance, instance.plan.ground_sphere);
  for (const std::uint32_t slot : instance.plan.occluders)
    casters[next++] = exact_sphere(instance, scene.occluders[slot].sphere);
}

void write_chunk(const ComputeScene& placed, const ComputeChunk& chunk, std::byte* memory) {
  const Scene& scene = *placed.scene;
  auto* const records = reinterpret_cast<InstanceRecord*>(memory + chunk.frame.records);
  auto* const bones = reinterpret_cast<Mat3x4*>(memory + chunk.frame.bones);
  auto* const casters = reinterpret_cast<Word4*>(memory + chunk.frame.casters);
  std::uint32_t written = 0, next_caster = 0;
  for_selected(scene, chunk, [&](std::uint32_t slot) {
    const Instance& instance = scene.instances[slot];
    InstanceRecord record{};
    record.first_bone = written * chunk.model->bones();
    record.first_sphere = first_sphere(placed, slot);
    record.place = placed.placements[slot].place;
    // no_light wraps to 0.
    record.light = placed.lights.first_texel(slot) + 1;
    if (instance.plan.due) write_casters(placed, instance, casters, next_caster, record);
    write_pose(instance, bones + record.first_bone);
    // Mapped memory is written once and in order, never read.
    std::memcpy(records + written++, &record, sizeof record);
  });
}

}  // namespace

bool upload_frame(const Device& device, ComputeScene& placed) {
  const std::uint64_t bytes = lay_out(device, placed);
  if (bytes == 0) return false;
  placed.stream.write(bytes, [&](void* memory) {
    for (const ComputeChunk& chunk : placed.chunks)
      if (chunk.frame.selected) write_chunk(placed, chunk, static_cast<std::byte*>(memory));
  });
  return true;
}

}  // namespace nook::gl
