// The part of the compute tier that converts poses from the host's buffer.
#include <cstring>
#include <optional>

#include "sdk/src/character/scene_clips.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/character/compute_tier.h"
#include "sdk/src/gl/shader_program.h"

namespace nook::gl {
namespace {

struct Word4 {
  std::uint32_t x, y, z, w;
};

Word4 floats(float x, float y, float z, float w) {
  return {bit_cast<std::uint32_t>(x), bit_cast<std::uint32_t>(y), bit_cast<std::uint32_t>(z),
          bit_cast<std::uint32_t>(w)};
}

// Writes a value to mapped memory. Does not read the memory, because that may be slow.
void put(Word4* at, const Word4& value) {
  std::memcpy(static_cast<void*>(at), &value, sizeof value);
}

void put_rows(Word4* at, const Mat3x4& rows) {
  std::memcpy(static_cast<void*>(at), rows.m, sizeof rows.m);
}

std::uint32_t slot_of(const Scene& scene, const Instance& instance) {
  return static_cast<std::uint32_t>(&instance - scene.instances.data());
}

Vec3 centre_of(const nook_gl_instance_pose& pose) {
  return {pose.bound_centre_ws[0], pose.bound_centre_ws[1], pose.bound_centre_ws[2]};
}

// Returns true if the instance has bones without a transform, and the matrices that they keep are only on the
// CPU. These matrices must be sent to the GPU.
bool needs_seed(const PoseBatch& batch, const Instance& instance) {
  return batch.source.is_partial && !instance.input.is_posed_on_gpu;
}

void check_place(const ComputeScene& placed, const PoseBatch& batch, const Instance& instance,
                 const Instance& first, std::size_t index) {
  if (instance.model.get() != first.model.get())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "instances[%zu] (instance %u) has another model than instances[0]; make a separate call "
                  "for each model",
                  index, instance.id);
  const Placement<ComputeChunk>& placement = placed.placements[slot_of(*placed.scene, instance)];
  if (placement.pose_call == placed.pose_calls)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu] (instance %u) occurs twice in a call", index,
                  instance.id);
  if (batch.source.is_partial && instance.input.is_posed_on_gpu &&
      placement.chunk->posed_of[placement.place] != pose_of(instance))
    throw Failure(NOOK_ERROR_INVALID_HANDLE,
                  "instance %u would keep its last pose for the bones without a transform, but this nook_gl "
                  "does not have that pose; first set all bones in one call",
                  instance.id);
}

// Checks all instances. Throws Failure if one cannot get a pose.
void check_poses(const Scene& scene, ComputeScene& placed, const PoseBatch& batch) {
  if (batch.source.is_partial)
    need_no_pool(scene,
                 "poses with NOOK_POSE_FLAG_PARTIAL need the other bones of far instances; set all bones");
  if (batch.source.is_partial && placed.streaming.is_used)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the scene is in streaming mode (nook_gl_scene_set_streaming), but poses with "
                  "NOOK_POSE_FLAG_PARTIAL need the other bones of pending instances; set all bones");
  ++placed.pose_calls;
  const Instance& first = instance_of(scene, batch.instances[0].instance);
  for (std::size_t i = 0; i < batch.instances.size(); ++i) {
    check_instance_pose(batch, i);
    const Instance& instance = instance_of(scene, batch.instances[i].instance);
    check_place(placed, batch, instance, first, i);
    placed.placements[slot_of(scene, instance)].pose_call = placed.pose_calls;
  }
}

// Assigns the places of a pool again, with the distances of the new poses. Instances that get no place leave
// their new pose in the host's buffer.
void assign_places(Scene& scene, ComputeScene& placed, const PoseBatch& batch) noexcept {
  placed.measure();
  if (scene.has_camera)
    for (const nook_gl_instance_pose& pose : batch.instances)
      placed.placements[slot_of(scene, instance_of(scene, pose.instance))].distance =
          length(centre_of(pose) - scene.camera);
  placed.assign(scene, placed.pose_calls);
}

// Counts the instances of each chunk.
void count_poses(const Scene& scene, ComputeScene& placed, const PoseBatch& batch) noexcept {
  for (ComputeChunk& chunk : placed.chunks) chunk.poses = {};
  for (const nook_gl_instance_pose& pose : batch.instances) {
    const Instance& instance = instance_of(scene, pose.instance);
    ComputeChunk* const chunk = placed.placements[slot_of(scene, instance)].chunk;
    if (!chunk) continue;
    ++chunk->poses.count;
    chunk->poses.seeds += needs_seed(batch, instance);
  }
}

// Assigns a piece of the job buffer to each chunk, and returns the size of the buffer in bytes. Throws
// Failure if a piece is too large to be bound by OpenGL.
std::uint64_t lay_out_jobs(const Device& device, ComputeScene& placed) {
  std::uint64_t end = 0;
  for (ComputeChunk& chunk : placed.chunks) {
    ComputeChunk::PoseFrame& frame = chunk.poses;
    if (frame.count == 0) continue;
    const std::uint64_t bones = chunk.model->bones();
    const std::uint64_t elements = bones * NOOK_POSE_BIND_UVEC4S +
                                   std::uint64_t{frame.count} * NOOK_POSE_JOB_UVEC4S +
                                   frame.seeds * bones * NOOK_BONE_ROWS;
    frame.bytes = elements * sizeof(Word4);
    if (frame.bytes > device.max_piece_bytes)
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "the poses of one group of instances need %llu bytes, but this OpenGL allows %llu; pass "
                    "fewer instances in a call",
                    static_cast<unsigned long long>(frame.bytes),
                    static_cast<unsigned long long>(device.max_piece_bytes));
    frame.offset = (end + device.storage_alignment - 1) / device.storage_alignment * device.storage_alignment;
    end = frame.offset + frame.bytes;
  }
  return end;
}

// Writes, for each bone, the matrix by which its transform is multiplied, its joint, and the index of its
// transform.
void write_bind(const CharacterModel& model, const PoseSource& source, Word4* piece) {
  PoseSource without_place = source;
  without_place.place = {};
  for (std::size_t b = 0; b < model.bone_count(); ++b) {
    Word4* const at = piece + b * NOOK_POSE_BIND_UVEC4S;
    put_rows(at, to_float(bone_matrix(model, without_place, b, Affine{})));
    const std::array<double, 3> joint = joint_origin(model, b);
    Word4 fixed = floats(float(joint[0]), float(joint[1]), float(joint[2]), 0);
    fixed.w = NOOK_POSE_NO_TRANSFORM;
    put(at + NOOK_BONE_ROWS, fixed);
  }
  for_each_transform(model, source, [&](std::size_t bone, std::uint32_t index) {
    std::memcpy(static_cast<void*>(&piece[bone * NOOK_POSE_BIND_UVEC4S + NOOK_BONE_ROWS].w), &index,
                sizeof index);
  });
}

// Writes the bones of a pose that is on the CPU. They are relative to the origin that belongs to that pose.
void write_seed(const Instance& instance, Word4* at) {
  const Vec3 from = instance.input.bound.centre;
  for (const Mat3x4& bone : instance.bones()) {
    Mat3x4 relative = bone;
    relative.m[3] -= from.x;
    relative.m[7] -= from.y;
    relative.m[11] -= from.z;
    put_rows(at, relative);
    at += NOOK_BONE_ROWS;
  }
}

void write_job(const PoseWindows& windows, const nook_gl_instance_pose& pose, const Instance& instance,
               std::uint32_t place, std::uint32_t seed, Word4* at) {
  const Vec3 centre = centre_of(pose);
  Mat3x4 relative;
  std::memcpy(relative.m, pose.place_3x4, sizeof relative.m);
  relative.m[3] -= centre.x;
  relative.m[7] -= centre.y;
  relative.m[11] -= centre.z;
  put_rows(at, relative);
  put(at + 3, {windows.word_of(pose.first_transform), windows.window_of(pose.first_transform), place, seed});
  const Vec3 moved = instance.input.bound.centre - centre;
  put(at + 4, floats(moved.x, moved.y, moved.z, 0));
}

void write_jobs(const Scene& scene, ComputeScene& placed, const PoseBatch& batch, const PoseWindows& windows,
                std::byte* memory) {
  const auto piece_of = [&](const ComputeChunk& chunk) {
    return reinterpret_cast<Word4*>(memory + chunk.poses.offset);
  };
  for (ComputeChunk& chunk : placed.chunks) {
    ComputeChunk::PoseFrame& frame = chunk.poses;
    if (frame.count == 0) continue;
    frame.next_job = chunk.model->bones() * NOOK_POSE_BIND_UVEC4S;
    frame.next_seed = frame.next_job + frame.count * NOOK_POSE_JOB_UVEC4S;
    write_bind(chunk.model->model->model, batch.source, piece_of(chunk));
  }
  for (const nook_gl_instance_pose& pose : batch.instances) {
    const Instance& instance = instance_of(scene, pose.instance);
    const Placement<ComputeChunk>& placement = placed.placements[slot_of(scene, instance)];
    if (!placement.chunk) continue;
    ComputeChunk::PoseFrame& frame = placement.chunk->poses;
    Word4* const piece = piece_of(*placement.chunk);
    std::uint32_t seed = 0;
    if (needs_seed(batch, instance)) {
      seed = frame.next_seed;
      write_seed(instance, piece + seed);
      frame.next_seed += placement.chunk->model->bones() * NOOK_BONE_ROWS;
    }
    write_job(windows, pose, instance, placement.place, seed, piece + frame.next_job);
    frame.next_job += NOOK_POSE_JOB_UVEC4S;
  }
}

void take_poses(Scene& scene, ComputeScene& placed, const PoseBatch& batch) noexcept {
  for (const nook_gl_instance_pose& pose : batch.instances) {
    Instance& instance = instance_of(scene, pose.instance);
    take_gpu_pose(scene, instance, {{centre_of(pose), pose.bound_radius}, pose.scale});
    const Placement<ComputeChunk>& placement = placed.placements[slot_of(scene, instance)];
    if (placement.chunk) placement.chunk->posed_of[placement.place] = pose_of(instance);
  }
}

}  // namespace

void ComputeTier::make_pose_programs() {
  if (!convert_poses_.name()) convert_poses_ = compute_program(device_, "character/pose_convert.comp", "");
  if (!place_poses_.name()) place_poses_ = compute_program(device_, "character/pose_place.comp", "");
}

// Creates the programs and buffers that do not exist yet. Throws Failure if this is not possible.
void ComputeTier::make_pose_objects(ComputeScene& placed) {
  // In a pool, instances move between chunks, and in streaming mode, chunks are added. So every chunk gets
  // its buffer now.
  const bool has_pool = placed.scene->pool.is_used() || placed.streaming.is_used;
  const auto is_missing = [&](const ComputeChunk& chunk) {
    return (chunk.poses.count || has_pool) && !chunk.posed.name();
  };
  if (convert_poses_.name() && place_poses_.name() && placed.jobs.name() &&
      std::none_of(placed.chunks.begin(), placed.chunks.end(), is_missing))
    return;
  device_.report_host_errors();
  make_pose_programs();
  if (!placed.jobs.name())
    placed.jobs = Buffer(device_, "nook: jobs of poses", 4096, nullptr, GL_STREAM_DRAW);
  for (ComputeChunk& chunk : placed.chunks)
    if (is_missing(chunk))
      chunk.posed = Buffer(device_, "nook: poses", chunk.capacity * chunk.posed_vec4s() * 4 * sizeof(float),
                           nullptr, GL_DYNAMIC_COPY);
}

void ComputeTier::set_poses(Scene& scene, const PoseBatch& batch) {
  ComputeScene& placed = *placed_scene(scenes_, scene);
  std::optional<Device::Unchecked> unchecked;
  if (placed.streaming.is_used) {
    unchecked.emplace(device_);
    placed.follow_edits(device_);
  }
  const PoseWindows windows(device_, batch);
  check_poses(scene, placed, batch);
  assign_places(scene, placed, batch);
  count_poses(scene, placed, batch);
  if (batch.source.is_partial)
    for (const nook_gl_instance_pose& pose : batch.instances)
      decode_late_bones(instance_of(scene, pose.instance));
  make_pose_objects(placed);
  const std::uint64_t bytes = lay_out_jobs(device_, placed);
  if (bytes > 0)
    placed.jobs.write(bytes, [&](void* memory) {
      write_jobs(scene, placed, batch, windows, static_cast<std::byte*>(memory));
    });
  take_poses(scene, placed, batch);
  if (bytes > 0) convert_poses(placed, batch, windows);
  placed.write_table(device_);
}

void ComputeTier::convert_poses(const ComputeScene& placed, const PoseBatch& batch,
                                const PoseWindows& windows) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(convert_poses_.name());
  gl.Uniform1i(NOOK_LOCATION_POSE_LAYOUT, batch.source.layout);
  gl.Uniform1i(NOOK_LOCATION_POSE_IS_HALF, batch.is_half);
  gl.Uniform1ui(NOOK_LOCATION_POSE_STRIDE_WORDS,
                static_cast<GLuint>(batch.source.stride / sizeof(std::uint32_t)));
  for (std::uint32_t window = 0; window < windows.count(); ++window) {
    gl.Uniform1ui(NOOK_LOCATION_POSE_WINDOW, window);
    windows.bind(device_, NOOK_BINDING_MODEL, window);
    for (const ComputeChunk& chunk : placed.chunks) {
      if (chunk.poses.count == 0) continue;
      gl.Uniform1ui(NOOK_LOCATION_POSE_BONE_COUNT, chunk.model->bones());
      bind_piece(gl, NOOK_BINDING_STREAM, placed.jobs, chunk.poses.offset, chunk.poses.bytes);
      bind_whole(gl, NOOK_BINDING_SPHERES, chunk.posed);
      gl.DispatchCompute(chunk.poses.count, 1, 1);
    }
  }
  // Updates read the bones afterwards, and the host's shaders may overwrite the transforms. Both must wait
  // for the dispatches above.
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void ComputeTier::place_poses(const Update& update) const {
  const Functions& gl = device_.gl;
  write_bones(update, place_poses_, &ComputeChunk::Frame::posed, [&](const ComputeChunk& chunk) {
    bind_whole(gl, NOOK_BINDING_MODEL, chunk.posed);
    gl.Uniform1ui(NOOK_LOCATION_PLACED_BONE_COUNT, chunk.model->bones());
    gl.DispatchCompute(chunk.frame.selected, 1, 1);
  });
}

void ComputeTier::read_pose(const Scene& scene, nook_instance_id id, std::span<Mat3x4> bones) const {
  const Instance& instance = instance_of(scene, id);
  const ComputeScene* const placed = placed_scene(scenes_, scene);
  const std::uint32_t slot = slot_of(scene, instance);
  const bool has_place = placed && slot < placed->placements.size() && placed->placements[slot].id == id;
  const ComputeChunk* const chunk = has_place ? placed->placements[slot].chunk : nullptr;
  if (!chunk || !instance.input.is_posed_on_gpu ||
      chunk->posed_of[placed->placements[slot].place] != pose_of(instance))
    throw Failure(NOOK_ERROR_INVALID_HANDLE,
                  "this nook_gl does not have the pose of instance %u; first call nook_gl_scene_set_poses",
                  id);
  device_.report_host_errors();
  device_.gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  constexpr std::uint64_t vec4 = 4 * sizeof(float);
  const std::uint64_t first = placed->placements[slot].place * chunk->posed_vec4s() + 1;
  read_buffer_bytes(device_, chunk->posed.name(), first * vec4, bones.size_bytes(), bones.data());
  device_.check("reading a pose");
  const Vec3 centre = instance.input.bound.centre;
  for (Mat3x4& bone : bones) {
    bone.m[3] += centre.x;
    bone.m[7] += centre.y;
    bone.m[11] += centre.z;
  }
}

}  // namespace nook::gl
