/* Sets the poses of a crowd in one call, from transforms that your animation system has computed on the GPU.
 * This needs OpenGL 4.3 or OpenGL ES 3.1. On the tiers NOOK_GL_TIER_33 and NOOK_GL_TIER_ES30
 * (nook_gl_info.tier), the calls fail with NOOK_ERROR_UNSUPPORTED. On these tiers, use baked clips
 * (nook_clips.h) or nook_scene_set_pose.
 *
 * Write the transforms of all instances to your own buffer, call nook_gl_scene_set_poses once for each model,
 * and then nook_gl_scene_update. Culling, the ground, neighbours and levels of detail run on the CPU and need
 * a bounding sphere of each body, which you pass with the instance.
 *
 * Barriers and fences. If shaders wrote the transforms, call glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT)
 * before nook_gl_scene_set_poses. Other writes, such as glBufferSubData, transform feedback and unmapping,
 * need no barrier. Only OpenGL commands that nook_gl_scene_set_poses issues read the buffer. So OpenGL
 * commands that you issue after the call may overwrite the range immediately. Before you write through a
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
 * requires it. It allocates if you added instances since the last update, or if an instance of this model
 * gets its first pose on the GPU. In OpenGL memory, the pose of an instance takes 48 bytes for each bone,
 * plus 16 bytes. Context thread. Errors: INVALID_ARGUMENT (as nook_scene_set_pose, as far as the CPU can
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

/* A pool saves memory in a crowd in which most instances are far away. Without a pool, each instance has
 * arrays of tens of kilobytes, even if nobody sees its AO. With a pool, only instances near the camera have
 * arrays. All other instances are far: their AO is 1. If you set instance_count, a far instance takes about
 * 500 bytes of host memory and no OpenGL memory. If it plays a clip, your shader still multiplies by the
 * clip's AO. Pose the crowd with nook_scene_set_clips or nook_gl_scene_set_poses. nook_scene_set_pose and
 * nook_scene_set_clip take more memory: they allocate at the first pose of each instance, which then keeps
 * its bones on the CPU until you remove it.
 *
 * Near instances. nook_gl_scene_update gives a place to each posed instance whose bounding sphere has its
 * centre within `distance` of the camera (nook_scene_set_camera; without a camera, all are near). The same
 * update evaluates its AO. An instance leaves its place beyond 1.1 times `distance`. If a model has more near
 * instances than places, the nearest instances get the places, and the others stay far. The distance of an
 * instance in a place is divided by 1.1, so that instances do not swap places in every frame. For poses on
 * the GPU, nook_gl_scene_set_poses assigns the places, because your buffer may be overwritten later. So set
 * the camera before this call, and pass each instance that comes near. If the nook_gl lost the pose of an
 * instance, the instance is far until its next pose, and no call fails.
 *
 * Views. All far instances of a model share one buffer of ones. So when an instance gets or leaves a place,
 * in nook_gl_scene_update or nook_gl_scene_set_poses, its view changes. nook_gl_scene_read_pool gives the
 * views of many instances, each with a generation number that changes with the view. After
 * nook_gl_scene_release, get all views again. For a far instance, nook_gl_scene_read and nook_gl_scene_write
 * give AO 1.
 *
 * Far instances do not darken other instances or the world (nook_world_render), and nook_scene_link_nearest
 * does not find them. Their links and their ground stay set, and have an effect again when they are near. If
 * every near instance should be darkened by all its neighbours, add the reach of a neighbour to `distance`.
 *
 * If a scene has a pool, some calls fail with NOOK_ERROR_UNSUPPORTED. nook_scene_update and nook_world_sample
 * fail because they need the bones of all instances on the CPU. nook_scene_set_light, nook_gl_scene_set_poses
 * with NOOK_POSE_FLAG_PARTIAL, and calls with a nook_gl without compute shaders fail too. For an instance
 * without bones on the CPU, nook_scene_read (AO and bent normals), nook_scene_read_spheres,
 * nook_scene_read_key_points, nook_scene_record_pose and nook_scene_set_model fail. */
typedef struct nook_gl_pool_desc {
  /* sizeof(nook_gl_pool_desc). */
  uint32_t struct_size;
  /* The number of places for the instances of each model, at least 1. For a model with fewer instances, Nook
   * makes only as many places as it has instances. */
  uint32_t places;
  /* Instances within this distance of the camera are near: metres, above 0. */
  float distance;
  /* The number of instances that you will add, or 0. Nook allocates host memory for this number. With 0, the
   * memory grows in large steps, and part of it stays unused. */
  uint32_t instance_count;
} nook_gl_pool_desc;

/* Gives a scene a pool. Call it before you add instances; while the scene has instances, only the distance
 * may change. nook_gl_scene_prepare creates the places of the instances that you added; after that, no update
 * allocates. The pool belongs to the scene: each nook_gl that evaluates the scene has places for it. Context
 * thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (gl has no compute shaders), OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_set_pool(nook_gl gl, nook_scene scene, const nook_gl_pool_desc* desc);

/* The view of one instance in a scene that has a pool; like nook_gl_view, with a stride of 4. */
typedef struct nook_gl_pool_view {
  uint64_t offset;
  uint32_t buffer;
  /* The model's file_vertex_count. */
  uint32_t count;
  /* This number is different after each change of the view. */
  uint32_t generation;
  /* 1: the instance has a place in the pool; 0: it is far. */
  uint32_t is_near;
} nook_gl_pool_view;

/* How full a pool is. */
typedef struct nook_gl_pool_info {
  uint32_t struct_size;
  /* The number of instances that have a place. */
  uint32_t near_count;
  /* The number of instances that are near enough, but stay far because their model has no free place. */
  uint32_t waiting_count;
} nook_gl_pool_info;

/* Gives the views of `count` instances, and how full the pool was at the last update. `info` may be NULL. The
 * call makes no OpenGL call and does not allocate. Context thread. Errors: INVALID_ARGUMENT (also if the
 * scene has no pool), INVALID_HANDLE (an id is unknown, an instance is not prepared yet), GL. */
NOOK_API nook_result nook_gl_scene_read_pool(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                             uint32_t count, nook_gl_pool_view* views,
                                             nook_gl_pool_info* info);

/* A table on the GPU that has one entry for each instance of a scene with a pool. If you draw a crowd with
 * indirect or multi-draw calls, your shaders use this table instead of views to find the AO.
 *
 * The table begins at the start of the buffer. The entry of an instance has the index (instance & 0xfffffu) -
 * 1, and consists of four 32-bit numbers, a uvec4 in std430:
 *   x  the OpenGL name of the buffer with the instance's AO; 0: far, so AO is 1
 *   y  the index of the first vertex's AO in this buffer, in floats; 0 if far
 *   z  the generation of the view (nook_gl_pool_view.generation)
 *   w  the level of detail of the last update (nook_scene_instance_info.level); 0 if far
 * Entries without an instance are 0. Bind one of the model's AO buffers and pass its name to the shader. Then
 * read the AO of a vertex, in file order:
 *   uvec4 entry = entries[(instance & 0xfffffu) - 1u];
 *   float ao = entry.x == bound_buffer ? values[entry.y + vertex] : 1.0;
 * If a model has several AO buffers, bind them all and choose by entry.x, or draw once for each buffer. */
typedef struct nook_gl_pool_table {
  uint32_t struct_size;
  /* The OpenGL name of the buffer. Bind it for reading only, at any binding point. */
  uint32_t buffer;
  uint32_t entry_count;
  /* The number of buffers that hold the AO of the model's near instances. */
  uint32_t ao_buffer_count;
} nook_gl_pool_table;

/* Gives the table of a scene, and the OpenGL names of the AO buffers of a model: as many as fit into
 * `ao_buffers`, which may be NULL if `capacity` is 0. The first call creates the table, which takes 16 bytes
 * of OpenGL memory and 16 bytes of host memory for each instance. From then on, nook_gl_scene_update,
 * nook_gl_scene_set_poses and nook_gl_scene_prepare write the entries that change, with glBufferSubData. So
 * OpenGL commands that you issue after these calls read the new entries and their AO without a barrier. If an
 * update fails, the entries stay as they were until the next call. The buffers stay until you add or remove
 * instances, change a model, or call nook_gl_scene_release. Then call this function again, after
 * nook_gl_scene_prepare or nook_gl_scene_update. The table's buffer stays as long as you have at most
 * nook_gl_pool_desc.instance_count instances. The call prepares the scene, as nook_gl_scene_prepare does.
 * Context thread. Errors: INVALID_ARGUMENT (also if the scene has no pool), UNSUPPORTED,
 * GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_read_pool_table(nook_gl gl, nook_scene scene, nook_model model,
                                                   nook_gl_pool_table* table, uint32_t* ao_buffers,
                                                   uint32_t capacity);

#ifdef __cplusplus
}
#endif
#endif
