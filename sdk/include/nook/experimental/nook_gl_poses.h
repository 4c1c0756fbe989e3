/* Poses that your animation system leaves on the GPU, for a crowd in one call, on OpenGL 4.3 and OpenGL
 * ES 3.1. Where the tier of nook_gl_info is NOOK_GL_TIER_33 or NOOK_GL_TIER_ES30, the calls fail with
 * NOOK_ERROR_UNSUPPORTED: play a crowd by baked clips there (nook_clips.h), or call nook_scene_set_pose.
 *
 * Write the transforms of all instances to a buffer of yours, call nook_gl_scene_set_poses once for each
 * model, and then nook_gl_scene_update. Culling, the ground, neighbours and levels of detail need a sphere
 * around each body on the CPU; you pass it with the instance.
 *
 * Barriers and fences. If shaders wrote the transforms, call glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT)
 * before nook_gl_scene_set_poses. Other writes, such as glBufferSubData, transform feedback and unmapping,
 * need no barrier. Nook reads the range with commands that nook_gl_scene_set_poses issues, and never later.
 * So commands that you issue after the call may write the range at once. Before you write through a
 * persistent mapping, wait for a fence that you put after the call. The buffer may be persistently mapped
 * during the call, but not mapped in another way.
 *
 * An instance that is not in a call keeps its last pose. It has its pose on the GPU until nook_scene_set_pose
 * or nook_scene_set_clip gives it another one. Until then the CPU does not know its bones. Calls that need
 * them refuse the instance, or a scene that has it, with NOOK_ERROR_UNSUPPORTED: nook_scene_update,
 * nook_scene_read and nook_world_sample; nook_scene_read_spheres, nook_scene_read_key_points and
 * nook_scene_record_pose; nook_scene_set_model, and nook_scene_set_pose with NOOK_POSE_FLAG_PARTIAL.
 * nook_world_render leaves the instance out as a caster, and logs it once. nook_scene_describe_instance and
 * nook_scene_read_links work.
 *
 * Only the nook_gl of the call has the poses. After nook_gl_scene_release or a lost OpenGL context, and with
 * another nook_gl, nook_gl_scene_update fails with NOOK_ERROR_INVALID_HANDLE until you set the poses again.
 */
#ifndef NOOK_GL_POSES_H
#define NOOK_GL_POSES_H

#include "../nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The pose of one instance. */
typedef struct nook_gl_instance_pose {
  nook_instance_id instance;
  /* The instance's transforms begin with this one of the range, in units of nook_pose_desc.stride. */
  uint32_t first_transform;
  /* A sphere around the posed body, world space. The centre should move with the root bone, because
   * neighbours and levels of detail follow it. If the sphere is too small, occluders that matter may be left
   * out. */
  float bound_centre_ws[3];
  float bound_radius;
  /* The largest scale of a bone, with the place; 1 for a body in metres. */
  float scale;
  /* A 3x4 row-major matrix that is applied after every transform: the root of the instance. It may scale and
   * mirror. Pass the identity if the transforms lead to the world. */
  float place_3x4[12];
} nook_gl_instance_pose;

/* Where the poses of instances are. Set all fields to 0 first. */
typedef struct nook_gl_poses {
  /* sizeof(nook_gl_poses). */
  uint32_t struct_size;
  /* The numbers: NOOK_FORMAT_FLOAT or NOOK_FORMAT_HALF. A half has three digits: give translations relative
   * to place_3x4, and joint matrices, dual quaternions or translation, quaternion and scale. With half floats
   * of skinning or rest-to-world matrices, AO at the hands of a body may differ by 0.02. */
  nook_format format;
  /* Required: kind, layout, stride, skin, flags and map of the transforms, as in nook_scene_set_pose.
   * transform_count is the number for one instance. The stride is in bytes, a multiple of 4; 0 means tightly
   * packed numbers of the format. `transforms` and `place_3x4` must be NULL, and NOOK_POSE_FLAG_STRICT must
   * not be set, because only the GPU sees the numbers: uneven bones are projected as on the CPU, without a
   * log. */
  const nook_pose_desc* pose;
  /* The OpenGL name of your buffer. */
  uint32_t buffer;
  /* Must be 0: transforms in textures are not supported. */
  uint32_t texture;
  /* The range of the buffer in bytes, both multiples of 4. It must lie inside the buffer. Nook does not ask
   * OpenGL for the buffer's size, except with nook_gl_desc.debug. */
  uint64_t offset;
  uint64_t size;
} nook_gl_poses;

/* Sets the poses of `count` different instances of one model. Call it once per frame for each model whose
 * instances move, before nook_gl_scene_update. The call takes all poses or none. If a number of a pose is not
 * finite or far too large, the instance is open (AO 1) and casts nothing until its next pose. With
 * NOOK_POSE_FLAG_PARTIAL, bones without a transform keep their matrices in the world. AO agrees with the same
 * poses on the CPU within 1e-5, root mean square over a body.
 *
 * The call neither waits nor queries OpenGL, except where nook_gl_desc asks for it. It allocates if
 * instances were added since the last update, or if the model's first instance gets a pose on the GPU. The
 * poses of an instance take 48 bytes for each bone, and 16, of OpenGL memory. Context thread. Errors:
 * INVALID_ARGUMENT (as nook_scene_set_pose, where the CPU can tell; also: the range is too small or
 * misaligned, an instance occurs twice or has another model than the first one, the scene has strict_poses),
 * INVALID_HANDLE, UNSUPPORTED (the tier has no compute shaders; a texture), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_set_poses(nook_gl gl, nook_scene scene, const nook_gl_poses* poses,
                                             const nook_gl_instance_pose* instances, uint32_t count);

/* Copies the bones of an instance that has its pose on the GPU to host memory: 12 floats for each bone, from
 * rest space to the world, as nook_model_convert_pose writes them. Numbers that are not finite stay so. The
 * call WAITS FOR THE GPU: use it in tests. Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (gl does
 * not have the pose of the instance), UNSUPPORTED, GL. */
NOOK_API nook_result nook_gl_scene_read_pose(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                             float* bones_3x4, uint32_t bone_count);

#ifdef __cplusplus
}
#endif
#endif
