// The C functions of nook_gl_poses.h.
#include <nook/experimental/nook_gl_poses.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/scene_handle.h"
#include "sdk/src/api/pose_descriptor.h"
#include "sdk/src/core/checks.h"

using namespace nook;

namespace {

// Checks the fields of the descriptor that do not depend on the instances. Throws Failure if a field is
// invalid.
void check_range_of(const nook_gl_poses& poses) {
  constexpr std::size_t size = offsetof(nook_gl_poses, size) + sizeof(std::uint64_t);
  if (poses.struct_size < size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                  poses.struct_size, size);
  check_known("poses.format", poses.format, NOOK_FORMAT_HALF);
  need(poses.pose, "poses.pose");
  if (poses.texture)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "poses.texture is %u, but Nook cannot read transforms from a texture; copy the texels to a "
                  "buffer, and set poses.buffer",
                  poses.texture);
  if (!poses.buffer)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "poses.buffer is 0; set it to the name of an OpenGL buffer");
  constexpr std::uint64_t most = std::uint64_t{1} << 40;
  if (poses.offset % 4 || poses.size % 4 || poses.offset > most || poses.size > most || poses.size == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.offset and poses.size are %llu and %llu; need multiples of 4, and a size above 0",
                  static_cast<unsigned long long>(poses.offset), static_cast<unsigned long long>(poses.size));
}

// The transforms are in a buffer, so the descriptor must not contain a pointer to transforms or a place.
PoseSource checked_source(const CharacterModel& model, const nook_gl_poses& poses) {
  PoseSource source = api::source_of(model, poses.pose);
  if (source.transforms)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.pose->transforms is not NULL; set it to NULL, because Nook reads the transforms "
                  "from poses.buffer");
  if (poses.pose->place_3x4)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.pose->place_3x4 is not NULL; set instances[].place_3x4 for each instance instead");
  if (source.is_strict)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.pose->flags has NOOK_POSE_FLAG_STRICT, which needs the transforms on the CPU; leave "
                  "the flag out");
  const std::size_t bytes = floats_of_layout(source.layout) * (poses.format == NOOK_FORMAT_HALF ? 2 : 4);
  const std::size_t stride = source.stride ? source.stride : bytes;
  if (stride < bytes || stride % 4)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "poses.pose->stride is out of range (got %zu bytes, need 0, or a multiple of 4 that is at least %zu)",
        stride, bytes);
  constexpr std::size_t most = std::size_t{1} << 30;
  check_at_most("poses.pose->stride", static_cast<std::uint32_t>(std::min(stride, most + 4)), most);
  // check_pose_source requires a pointer to transforms on the CPU, but does not read from it. So any pointer
  // that is not null is enough.
  constexpr float somewhere = 0;
  source.transforms = &somewhere;
  source.stride = 0;
  check_pose_source(model, source);
  // Throws Failure if a bone has no transform.
  for_each_transform(model, source, [](std::size_t, std::uint32_t) {});
  source.transforms = nullptr;
  source.stride = stride;
  return source;
}

// Asks OpenGL for the size of the buffer, in debug contexts only.
void check_buffer(const gl::Device& device, const nook_gl_poses& poses) {
  if (!device.debug) return;
  device.report_host_errors();
  GLint64 size = 0;
  device.gl.BindBuffer(GL_ARRAY_BUFFER, poses.buffer);
  device.gl.GetBufferParameteri64v(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
  device.check("binding the host's buffer");
  if (poses.offset + poses.size > static_cast<std::uint64_t>(size))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "poses.buffer %u is too small (it has %llu bytes, but poses.offset + poses.size is %llu)",
                  poses.buffer, static_cast<unsigned long long>(size),
                  static_cast<unsigned long long>(poses.offset + poses.size));
}

}  // namespace

nook_result nook_gl_scene_set_poses(nook_gl gl, nook_scene scene, const nook_gl_poses* poses,
                                    const nook_gl_instance_pose* instances, uint32_t count) {
  return api::with_gl_scene("nook_gl_scene_set_poses", gl, scene, [&] {
    need(poses, "poses");
    if (count == 0) return;
    need(instances, "instances");
    check_range_of(*poses);
    if (scene->scene.settings.strict_poses)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the scene was created with strict_poses, which needs the transforms on the CPU; call "
                    "nook_scene_set_pose, or create the scene without strict_poses");
    const CharacterModel& model = instance_of(scene->scene, instances[0].instance).model->model;
    gl::PoseBatch batch;
    batch.source = checked_source(model, *poses);
    batch.is_half = poses->format == NOOK_FORMAT_HALF;
    batch.buffer = poses->buffer;
    batch.offset = poses->offset;
    batch.size = poses->size;
    batch.instances = {instances, count};
    gl->guarded([&] {
      check_buffer(gl->device, *poses);
      gl->characters->set_poses(api::handle_of(scene), batch);
    });
  });
}

nook_result nook_gl_scene_read_pose(nook_gl gl, nook_scene scene, nook_instance_id instance, float* bones_3x4,
                                    uint32_t bone_count) {
  return api::with_gl_scene("nook_gl_scene_read_pose", gl, scene, [&] {
    need(bones_3x4, "bones_3x4");
    check_bone_count(bone_count, instance_of(scene->scene, instance).model->model.bone_count());
    gl->guarded([&] {
      gl->characters->read_pose(scene->scene, instance, {reinterpret_cast<Mat3x4*>(bones_3x4), bone_count});
    });
  });
}
