/* Sets the poses of a crowd in one call, from transforms that your animation system has computed on the GPU.
 * This needs OpenGL 4.3 or OpenGL ES 3.1. On the tiers NOOK_GL_TIER_33 and NOOK_GL_TIER_ES30
 * (nook_gl_info.tier), the calls fail with NOOK_ERROR_UNSUPPORTED. There, use baked clips (nook_clips.h) or
 * nook_scene_set_pose.
 *
 * Write the transforms of all instances to a buffer of yours, call nook_gl_scene_set_poses once for each
 * model, and then nook_gl_scene_update. Culling, the ground, neighbours and levels of detail run on the CPU
 * and need a bounding sphere of each body, which you pass with the instance.
 *
 * Barriers and fences. If shaders wrote the transforms, call glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT)
 * before nook_gl_scene_set_poses. Other writes, such as glBufferSubData, transform feedback and unmapping,
 * need no barrier. Only OpenGL commands that nook_gl_scene_set_poses issues read the buffer. So OpenGL
 * commands that you issue after the call may overwrite the range at once. Before you write through a
 * persistent mapping, wait for a fence that you issued after the call. During the call, the buffer may be
 * mapped persistently, but not in another way.
 *
 * Instances that you do not pass keep their last poses. After the call, the pose of an instance exists only
 * on the GPU, until nook_scene_set_pose or nook_scene_set_clip sets a new pose. Until then, calls that need
 * the bones on the CPU fail with NOOK_ERROR_UNSUPPORTED for this instance, or for a scene that contains it.
 * These calls are nook_scene_update, nook_scene_read and nook_world_sample; nook_scene_read_spheres,
 * nook_scene_read_key_points and nook_scene_record_pose; nook_scene_set_model, and nook_scene_set_pose with
 * NOOK_POSE_FLAG_PARTIAL. nook_world_render does not use the instance as a caster, and logs this once.
 * nook_scene_describe_instance and nook_scene_read_links still work.
 *
 * Only the nook_gl that you passed to the call has the poses. After nook_gl_scene_release, after the OpenGL
 * context is lost, and with another nook_gl, nook_gl_scene_update fails with NOOK_ERROR_INVALID_HANDLE until
 * you set the poses again. */
#ifndef NOOK_GL_POSES_H
#define NOOK_GL_POSES_H

#include "../nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The pose of one instance. */
typedef struct nook_gl_instance_pose {
  nook_instance_id instance;
  /* The index of the instance's first transform in the range, in units of nook_pose_desc.stride. */
  uint32_t first_transform;
  /* A sphere around the posed body, in world space and metres. The centre should move with the root bone,
   * because neighbours and levels of detail depend on the centre. If the sphere is too small, updates may
   * skip occluders that matter. */
  float bound_centre_ws[3];
  float bound_radius;
  /* The largest scale of a bone, including the scale of place_3x4; 1 for an unscaled body in metres. */
  float scale;
  /* A 3x4 row-major matrix that is applied after every transform, such as the root transform of the instance.
   * It may scale and mirror. If the transforms already map to world space, pass the identity. */
  float place_3x4[12];
} nook_gl_instance_pose;

/* The buffer that contains the poses. Set all fields to 0 first. */
typedef struct nook_gl_poses {
  /* sizeof(nook_gl_poses). */
  uint32_t struct_size;
  /* The format of the numbers: NOOK_FORMAT_FLOAT or NOOK_FORMAT_HALF. A half float has only three digits. So
   * with half floats, pass translations relative to place_3x4, and use joint matrices, dual quaternions or
   * NOOK_TRANSFORM_TRS. With half floats in skinning or rest-to-world matrices, the AO of a body's hands may
   * be wrong by 0.02. */
  nook_format format;
  /* Required. Set `kind`, `layout`, `stride`, `skin`, `flags` and `transform_of_bone` of the transforms as
   * for nook_scene_set_pose. transform_count is the number of transforms of one instance. `stride` is in
   * bytes, a multiple of 4; 0 means tightly packed. `transforms` and `place_3x4` must be NULL.
   * NOOK_POSE_FLAG_STRICT must not be set, because only the GPU reads the numbers. Bones that are sheared or
   * scaled unevenly are corrected as on the CPU, but not logged. */
  const nook_pose_desc* pose;
  /* The OpenGL name of your buffer. */
  uint32_t buffer;
  /* Must be 0: transforms in textures are not supported. */
  uint32_t texture;
  /* The range of the buffer that holds the transforms: its offset and size in bytes, both multiples of 4. The
   * range must lie inside the buffer. Nook checks this only with nook_gl_desc.debug, because the check
   * queries OpenGL. */
  uint64_t offset;
  uint64_t size;
} nook_gl_poses;

/* Sets the poses of `count` different instances of one model. Call it once per frame for each model whose
 * instances move, before nook_gl_scene_update. On failure, no pose is changed. If a number of a pose is not
 * finite or far too large, the instance has AO 1 and does not cast until its next pose. With
 * NOOK_POSE_FLAG_PARTIAL, bones without a transform keep their rest-to-world matrices. AO agrees with the
 * same poses set on the CPU within 1e-5, root mean square over a body.
 *
 * The call does not wait for the GPU. It queries OpenGL only if nook_gl_desc.state_mode or nook_gl_desc.debug
 * requires it. It allocates if you added instances since the last update, or if it sets the first pose on the
 * GPU of an instance of this model. The pose of an instance takes 48 bytes for each bone, plus 16 bytes, of
 * OpenGL memory. Context thread. Errors: INVALID_ARGUMENT (as nook_scene_set_pose, as far as the CPU can
 * check; also if the range is too small or misaligned, an instance occurs twice, the instances have different
 * models, or the scene has strict_poses), INVALID_HANDLE, UNSUPPORTED (the tier has no compute shaders, or
 * `texture` is not 0), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_set_poses(nook_gl gl, nook_scene scene, const nook_gl_poses* poses,
                                             const nook_gl_instance_pose* instances, uint32_t count);

/* Copies the pose of an instance from the GPU to host memory: 12 floats for each bone, from rest space to
 * world space, as nook_model_convert_pose writes them. Numbers that are not finite are copied unchanged. The
 * call WAITS FOR THE GPU: use it in tests. Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (`gl`
 * does not have the pose of the instance), UNSUPPORTED, GL. */
NOOK_API nook_result nook_gl_scene_read_pose(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                             float* bones_3x4, uint32_t bone_count);

#ifdef __cplusplus
}
#endif
#endif
