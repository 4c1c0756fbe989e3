#include "sdk/src/gl/character/compute_scene.h"

#include <cstring>

#include "sdk/src/character/instance_views.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/character/light_texture.h"

namespace nook::gl {
namespace {

struct Word4 {
  std::uint32_t x, y, z, w;
};

Word4 floats(Vec3 v, std::uint32_t w) {
  return {bit_cast<std::uint32_t>(v.x), bit_cast<std::uint32_t>(v.y), bit_cast<std::uint32_t>(v.z), w};
}

// Returns the point of the instance to which the positions in the stream are relative.
Vec3 origin(const Instance& instance) {
  return instance.input.bound.centre;
}

// Calls visit(slot) for the instances that are due, level by level. Then calls it for the instances that only
// moved.
template <class Visit>
void for_selected(const Scene& scene, const ComputeChunk& chunk, Visit&& visit) {
  for (std::uint32_t level = 0; level < chunk.model->level_count(); ++level)
    for (const std::uint32_t slot : chunk.slots)
      if (slot != ComputeChunk::empty && scene.instances[slot].plan.due &&
          scene.instances[slot].plan.level == level)
        visit(slot);
  for (std::uint32_t place = 0; place < chunk.capacity; ++place) {
    const std::uint32_t slot = chunk.slots[place];
    if (slot == ComputeChunk::empty) continue;
    if (scene.instances[slot].plan.due || scene.instances[slot].plan.is_far) continue;
    if (chunk.transformed[place] != pose_of(scene.instances[slot])) visit(slot);
  }
}

std::uint64_t aligned(const Device& device, std::uint64_t offset) {
  return (offset + device.storage_alignment - 1) / device.storage_alignment * device.storage_alignment;
}

// A piece is the part of the stream buffer that belongs to one chunk. Computes the offsets of the arrays in
// the piece. Throws Failure if the piece is too large to be bound by OpenGL.
void lay_out_piece(const Device& device, ComputeChunk& chunk, std::uint64_t casters, std::uint64_t lights) {
  ComputeChunk::Frame& frame = chunk.frame;
  const std::uint64_t bones = std::uint64_t{frame.selected} * NOOK_RECORD_UVEC4S;
  const std::uint64_t first_caster = bones + std::uint64_t{frame.selected} * chunk.model->bone_uvec4s();
  const std::uint64_t first_light = first_caster + casters;
  frame.bytes = (first_light + lights) * sizeof(Word4);
  if (frame.bytes > device.max_piece_bytes)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the poses, links and lights of one group of instances need %llu bytes, but this OpenGL "
                  "allows %llu; link fewer instances",
                  static_cast<unsigned long long>(frame.bytes),
                  static_cast<unsigned long long>(device.max_piece_bytes));
  frame.bones = static_cast<std::uint32_t>(bones);
  frame.casters = static_cast<std::uint32_t>(first_caster);
  frame.lights = static_cast<std::uint32_t>(first_light);
}

// Throws Failure if the buffers of this nook_gl do not contain the pose of the instance. This happens if the
// pose was set with another nook_gl, or if this nook_gl has released it.
void need_pose(const ComputeChunk& chunk, const Placement<ComputeChunk>& placement,
               const Instance& instance) {
  if (chunk.posed_of[placement.place] != pose_of(instance))
    throw Failure(NOOK_ERROR_INVALID_HANDLE,
                  "the pose of instance %u is on the GPU, but not in this nook_gl; call "
                  "nook_gl_scene_set_poses with this nook_gl",
                  instance.id);
}

// Lays out the pieces of all chunks, and returns their total size in bytes.
std::uint64_t lay_out(const Device& device, ComputeScene& placed) {
  const Scene& scene = *placed.scene;
  std::uint64_t end = 0;
  for (ComputeChunk& chunk : placed.chunks) {
    ComputeChunk::Frame& frame = chunk.frame;
    frame = {};
    std::uint64_t casters = 0, lights = 0;
    for_selected(scene, chunk, [&](std::uint32_t slot) {
      const Instance& instance = scene.instances[slot];
      ++frame.selected;
      if (instance.input.is_posed_on_gpu) {
        need_pose(chunk, placed.placements[slot], instance);
        ++frame.posed;
      }
      frame.late += instance.input.clip.is_late;
      if (!instance.plan.due) return;
      ++frame.due;
      frame.lit += instance.light().count > 0;
      ++frame.due_at_level[instance.plan.level];
      casters += NOOK_CASTER_UVEC4S * instance.plan.casters.size() + free_sphere_count(instance);
      lights += light_texels(instance.light());
    });
    if (frame.selected == 0) continue;
    lay_out_piece(device, chunk, casters, lights);
    frame.offset = aligned(device, end);
    end = frame.offset + frame.bytes;
  }
  return end;
}

void write_pose(const Instance& instance, Mat3x4* out) {
  const Vec3 from = origin(instance);
  for (const Mat3x4& bone : instance.bones()) {
    Mat3x4 relative = bone;
    relative.m[3] -= from.x;
    relative.m[7] -= from.y;
    relative.m[11] -= from.z;
    std::memcpy(out++, &relative, sizeof relative);
  }
}

// Writes the input from which clip_bones.comp computes the bones.
void write_clip(const Instance& instance, Word4* at) {
  const InstanceClip& clip = instance.input.clip;
  const Vec3 from = origin(instance);
  Mat3x4 relative = clip.place;
  relative.m[3] -= from.x;
  relative.m[7] -= from.y;
  relative.m[11] -= from.z;
  const Word4 frames{clip.mix.first, clip.mix.second, bit_cast<std::uint32_t>(clip.mix.share), 0};
  std::memcpy(static_cast<void*>(at), relative.m, sizeof relative.m);
  std::memcpy(static_cast<void*>(at + NOOK_BONE_ROWS), &frames, sizeof frames);
}

Word4 exact_sphere(const Instance& receiver, const Sphere& sphere) {
  return floats(sphere.centre - origin(receiver),
                bit_cast<std::uint32_t>(inverse_sphere_radius(sphere.radius)));
}

std::uint32_t first_sphere(const ComputeScene& placed, std::uint32_t slot) {
  const Placement<ComputeChunk>& placement = placed.placements[slot];
  return placement.chunk->first_sphere + placement.place * placement.chunk->model->spheres();
}

// Writes the casters of an instance from index `next` on. The casters have the receiver's level of detail.
// Stores their index and count in the record.
void write_casters(const ComputeScene& placed, const Instance& instance, Word4* piece, std::uint32_t& next,
                   InstanceRecord& record) {
  const Scene& scene = *placed.scene;
  record.first_caster = next;
  record.caster_count = static_cast<std::uint32_t>(instance.plan.casters.size());
  for (const std::uint32_t slot : instance.plan.casters) {
    const Instance& caster = scene.instances[slot];
    const LevelRange& level = placed.placements[slot].chunk->model->level(instance.plan.level);
    piece[next++] =
        floats(origin(caster) - origin(instance), first_sphere(placed, slot) + level.first_sphere);
    piece[next++] = {level.spheres, 0, 0, 0};
  }
  record.first_exact = next;
  record.exact_count = free_sphere_count(instance) | record.exact_count;
  if (instance.plan.ground_sphere.radius > 0)
    piece[next++] = exact_sphere(instance, instance.plan.ground_sphere);
  for (const std::uint32_t slot : instance.plan.occluders)
    piece[next++] = exact_sphere(instance, scene.occluders[slot].sphere);
}

void write_chunk(const ComputeScene& placed, const ComputeChunk& chunk, Word4* piece) {
  const Scene& scene = *placed.scene;
  const ComputeChunk::Frame& frame = chunk.frame;
  std::uint32_t written = 0, next_caster = frame.casters, next_light = frame.lights;
  for_selected(scene, chunk, [&](std::uint32_t slot) {
    const Instance& instance = scene.instances[slot];
    InstanceRecord record{};
    record.first_bone = frame.bones + written * chunk.model->bone_uvec4s();
    record.first_sphere = first_sphere(placed, slot);
    record.place = placed.placements[slot].place |
                   (has_self_shadow(scene, instance) ? NOOK_RECORD_SELF : 0u) |
                   (instance.input.is_posed_on_gpu ? NOOK_RECORD_POSED : 0u);
    if (instance.input.clip.is_late)
      record.place |= placed.number_of_clips(instance) << NOOK_RECORD_CLIPS_SHIFT;
    record.exact_count = placed.hidden_steps(slot) << NOOK_RECORD_HIDDEN_SHIFT;
    if (instance.plan.due) {
      write_casters(placed, instance, piece, next_caster, record);
      if (instance.light().count > 0) {
        record.light = next_light;
        write_light(instance, reinterpret_cast<LightTexel*>(piece + next_light));
        next_light += light_texels(instance.light());
      }
    }
    // If the pose is on the GPU, pose_place.comp writes the bones later.
    if (instance.input.clip.is_late)
      write_clip(instance, piece + record.first_bone);
    else if (!instance.input.is_posed_on_gpu)
      write_pose(instance, reinterpret_cast<Mat3x4*>(piece + record.first_bone));
    // Mapped memory may be slow to read. So the record is completed in a local variable, and then copied.
    std::memcpy(static_cast<void*>(piece + NOOK_RECORD_UVEC4S * written++), &record, sizeof record);
  });
}

}  // namespace

bool upload_frame(const Device& device, ComputeScene& placed) {
  const std::uint64_t bytes = lay_out(device, placed);
  if (bytes == 0) return false;
  placed.stream.write(bytes, [&](void* memory) {
    for (const ComputeChunk& chunk : placed.chunks)
      if (chunk.frame.selected)
        write_chunk(placed, chunk,
                    reinterpret_cast<Word4*>(static_cast<std::byte*>(memory) + chunk.frame.offset));
  });
  return true;
}

}  // namespace nook::gl
