/* Dynamic ambient occlusion of skinned characters: baked models, scenes of instances, evaluation on the CPU.
 * The method is B. H. Le et al., I3D 2019. Proxy spheres are rigidly attached to bones and cast shadow on key
 * points; each vertex blends the shadows of a few key points. A scene holds instances of models with their
 * poses. Linked instances, the ground and free occluders darken an instance too, without a new bake. */
#ifndef NOOK_CHARACTER_H
#define NOOK_CHARACTER_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The ids of instances and of occluders in a scene. 0 is never an id; ids are never reused. */
typedef uint32_t nook_instance_id;
typedef uint32_t nook_occluder_id;

/* ---- Models: immutable, shared by any number of scenes and threads ---- */

/* Loads a model from the bytes of a .nook file, which you may free afterwards. The library validates all
 * bytes, so you can load files that you do not trust. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_load(nook_context context, const void* bytes, size_t size, nook_model* out);

/* Releases your reference and sets *model to NULL; scenes that use the model keep it alive. Any thread. */
NOOK_API void nook_model_destroy(nook_model* model);

typedef struct nook_model_info {
  uint32_t struct_size;
  /* The number of bones. A pose has one matrix for each bone. */
  uint32_t bone_count;
  uint32_t sphere_count, key_point_count;
  /* The number of vertices after welding. */
  uint32_t vertex_count;
  /* The number of AO values: one for each vertex of the imported file, in the order of its primitives. */
  uint32_t file_vertex_count;
  uint32_t primitive_count;
  /* The number of levels of detail, full detail included; at least 1. */
  uint32_t lod_count;
  /* The radius of the rest pose in metres, measured from the centre of its bounding box. */
  float bounding_radius;
  /* The exponent of the shadow norm (Le et al. 2019, slide 20). */
  float gamma;
  /* The number of skins for nook_model_describe_skin; 0 if the model has no bind data. */
  uint32_t skin_count;
  /* The number of check vertices, at most 64 (nook_model_describe_check_vertex); 0 without bind data. */
  uint32_t check_vertex_count;
  /* Bytes of host memory that all instances share, without the overhead of the allocator. */
  uint64_t model_bytes;
  /* Bytes of host memory of an instance that the CPU updates, without links: without and with a light. */
  uint64_t instance_bytes, lit_instance_bytes;
} nook_model_info;

/* Describes a model. For its GPU memory, call nook_gl_model_memory. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_model_describe(nook_model model, nook_model_info* info);

/* Returns the name of a bone, valid while the model lives, or NULL for an index out of range. Any thread. */
NOOK_API const char* nook_model_bone_name(nook_model model, uint32_t bone);

/* Gives the range of AO values of a primitive; `primitive` is less than nook_model_info.primitive_count.
 * Primitives are in the order of the file's nodes, and within a node in the order of its mesh.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_model_describe_primitive(nook_model model, uint32_t primitive, nook_range* out);

/* The arrays of nook_model_read, with one entry for each vertex. */
enum {
  /* One float: the ray-traced AO of the rest pose, the same value that a static AO bake gives. */
  NOOK_MODEL_STATIC_AO = 0,
  /* Eight signed bytes, where 127 means 1: the mean occluded direction for AO = 0 (x, y, z, 0), then the mean
   * occluded direction for AO = 1. Pass both to your vertex shader as normalised attributes of GL_BYTE. They
   * are in the space of the file's NORMAL attribute if the model has bind data, otherwise in rest space. */
  NOOK_MODEL_OCCLUDED_DIRECTIONS = 1
};
typedef int32_t nook_model_array;

/* Copies an array in the file's vertex order. `count` must be file_vertex_count; `stride` is in bytes (0:
 * tightly packed). Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model does not have this array). */
NOOK_API nook_result nook_model_read(nook_model model, nook_model_array array, void* out, uint32_t count,
                                     size_t stride);

/* ---- Bent normals: the mean direction of the light that reaches a vertex ----
 *
 * A bent normal points in the mean open direction of a vertex; use it for specular occlusion. After `nook
 * bake bent` a model has two vectors for each vertex, NOOK_MODEL_OCCLUDED_DIRECTIONS: the cosine-weighted
 * mean of the directions that the body occludes, if AO is 0 (`dark`) and if AO is 1 (`open`). Rotate both
 * vectors as you rotate the normal n, and compute normalize(2/3 n - mix(dark, open, AO)) in the vertex
 * shader, as the function nook_scene_bent_normal in nook_gl_view.glsl does. Bent normals need no update of
 * their own, and are the same on all tiers. Occlusion by other bodies and the ground is treated like
 * self-occlusion. */

/* ---- Scenes ---- */

typedef struct nook_scene_desc {
  uint32_t struct_size, type;
  const void* next;
  /* How the shadow of casters outside the bake (linked instances, occluders, ground) is combined with the
   * self-shadow. NOOK_FORM_DEFAULT (default): as a separate factor, AO = self * (1 - added). NOOK_FORM_PAPER:
   * in the norm of the self-shadow, as in Le et al. 2019. */
  nook_form form;
  /* A difference of AO in [0, 1], default 1/1024. An update skips a linked caster, an occluder or a ground
   * that cannot darken the instance by more than this. */
  float cutoff_error;
  /* A root mean square AO error, >= 0. An update uses the coarsest level of detail whose baked self-shadow
   * error is below lod_error * (distance to the camera / lod_distance). Default 0: full detail. */
  float lod_error;
  /* The distance to which lod_error refers, > 0. The default 0 means 10 metres. */
  float lod_distance;
  /* A distant instance is updated at least once in this many frames; >= 1. Default 1: in every frame. */
  uint32_t lod_max_interval;
  /* The radius of the sphere that represents the ground. 0 (default): 11,000 bounding radii of the body. */
  float ground_radius;
  /* 0 (default): a bone that is sheared or scaled unevenly is replaced by the nearest rotation with uniform
   * scale, as in the baker, and logged once per instance. 1: setting such a pose fails. */
  uint32_t strict_poses;
  /* The AO change, root mean square over a body, that you allow when nook_scene_update replaces distant
   * spheres by fewer, larger ones; 0 to 1, default 1/1024. The spheres of a linked caster become 16, 6 or 2
   * groups. The body's own spheres are grouped only with the default kernel, at most 256 spheres, full detail
   * and no light. The AO of a single vertex can change by 18 times this value. 0 turns grouping off.
   * NOOK_FORM_PAPER and the tiers 43 and ES31 ignore this field. */
  float far_error;
} nook_scene_desc;
static inline nook_result nook_scene_desc_init(nook_scene_desc* desc) {
  return nook_desc_init(NOOK_DESC_SCENE, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates an empty scene. On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_create(nook_context context, const nook_scene_desc* desc, nook_scene* out);

/* Destroys the scene and sets *scene to NULL. Its OpenGL objects may exist longer. One at a time. */
NOOK_API void nook_scene_destroy(nook_scene* scene);

/* Adds an instance in the rest pose, without a ground and without links. The call allocates.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_instance(nook_scene scene, nook_model model, nook_instance_id* out);

/* Removes an instance and all of its links. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_instance(nook_scene scene, nook_instance_id instance);

/* Gives an instance another model with the same number of bones, such as a new bake of the character, or the
 * model of a coarser mesh. The instance keeps its pose, links, ground and light; its AO is 1 until the next
 * update. Call nook_gl_scene_view again afterwards. The call allocates.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_set_model(nook_scene scene, nook_instance_id instance, nook_model model);

/* Lets `caster` darken `receiver` until you call nook_scene_unlink. A second call for the same pair has no
 * effect. The call allocates. One at a time. Errors: INVALID_ARGUMENT (receiver and caster are the same),
 * INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_link(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* Removes a link. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE (an id or the link is unknown). */
NOOK_API nook_result nook_scene_unlink(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* From the next update on, links each instance to its `k` nearest instances, in addition to the links of
 * nook_scene_link. `k` is 0 (off) to 16. `max_distance` limits the distance between the centres of bounding
 * spheres, in the unit of your poses. Each update searches for the nearest instances again; if the instances
 * are spread out, the time grows linearly with their number. This call may allocate, so that the update does
 * not have to. One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_link_nearest(nook_scene scene, uint32_t k, float max_distance);

/* Sets the ground under an instance: the points p with dot(normal, p) = offset, in world space. plane_xyzd
 * holds the normal, which points upwards and has unit length to 1e-3, and the offset in the unit of your
 * poses; NULL removes the ground. Nook represents the ground by a large sphere that touches the plane under
 * the instance. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_ground(nook_scene scene, nook_instance_id instance,
                                           const float* plane_xyzd);

/* A sphere that you place to darken instances, such as a shield or a ball. */
typedef struct nook_occluder {
  /* World space, in the unit of your poses (metres). */
  float centre_ws[3];
  /* > 0, in the same unit. */
  float radius;
  /* The only instance that the sphere darkens, such as the bearer of a shield. 0: all instances. */
  nook_instance_id receiver;
} nook_occluder;

/* Adds an occluder. If you remove its receiver, the occluder stays but darkens nothing. The call allocates.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE (occluder->receiver is unknown), OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_occluder(nook_scene scene, const nook_occluder* occluder,
                                             nook_occluder_id* out);

/* Replaces an occluder, without an allocation.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE (id or occluder->receiver is unknown). */
NOOK_API nook_result nook_scene_set_occluder(nook_scene scene, nook_occluder_id id,
                                             const nook_occluder* occluder);

/* Removes an occluder. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_occluder(nook_scene scene, nook_occluder_id occluder);

/* ---- Directional occlusion: the occlusion of a probe's light, by colour channel ----
 *
 * Light that comes from few directions is only occluded by objects in these directions. If you set lobes, a
 * sphere that covers the share f of its receiver's hemisphere takes away f * rho of the light instead of f.
 * For each channel, rho is the lobes' mean radiance behind the sphere divided by the lobes' mean radiance in
 * the receiver's hemisphere. All spheres of a linked instance share one rho; the ground uses the rho of the
 * half-space below its plane. The result is a colour for each vertex. If your shader computes albedo / pi * E
 * * AO, replace AO by this colour; E is the irradiance of the same lobes. Under constant light, the colour is
 * equal to AO. All updates compute this colour; nook_gl.h shows how a shader uses it. */

/* Sets the light of an instance for the next updates. Pass at most NOOK_PROBE_MAX_FUNCTIONS lobes, such as
 * from nook_probe_read_lobes at the instance's position; the call copies them. `lobe_count` 0 or `lobes` NULL
 * removes the light. With 12 lobes, an update of an instance takes 0.1 to 0.2 ms longer on one core with
 * AVX2, and another 0.1 to 0.2 ms for each linked instance. The call allocates when an instance gets its
 * first light. One at a time. Errors: INVALID_ARGUMENT (the message names the lobe), INVALID_HANDLE,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_set_light(nook_scene scene, nook_instance_id instance, const nook_lobe* lobes,
                                          uint32_t lobe_count);

/* Sets the camera position, in world space, in the unit of your poses. Updates choose levels of detail by the
 * distance to the camera. Before the first call, or with NULL, all instances have full detail. One at a time.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_camera(nook_scene scene, const float position_ws[3]);

/* Evaluates the shadows of all instances at their key points on the CPU. The call uses the context's
 * parallel_for if you set one. It takes no locks. It allocates only if compute shaders updated the scene
 * before. One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_update(nook_scene scene);

/* Reads a channel of an instance for each vertex, in the imported file's vertex order. Valid formats:
 *   NOOK_CHANNEL_AO              FLOAT, HALF, UNORM8
 *   NOOK_CHANNEL_DIRECTIONAL_AO  FLOAT
 *   NOOK_CHANNEL_BENT_NORMAL     SNORM8
 * The values come from the last nook_scene_update. AO is 1 until an update has evaluated the instance. If the
 * instance had no light in the update, directional AO is the AO in all three channels. Bent normals use the
 * current pose; each vertex rotates with the key point that has the largest weight. `count` must be
 * nook_model_info.file_vertex_count. `stride` is in bytes (0: tightly packed); bytes between the values are
 * not changed. The call does not allocate. Any thread, while no call changes the scene. Errors:
 * INVALID_ARGUMENT (also if the channel does not support the format), INVALID_HANDLE, UNSUPPORTED (the model
 * was baked without bent normals or without rest normals). */
NOOK_API nook_result nook_scene_read(nook_scene scene, nook_instance_id instance, nook_channel channel,
                                     nook_format format, void* out, uint32_t count, size_t stride);

typedef struct nook_scene_info {
  uint32_t struct_size;
  /* The number of all instances, and the number of instances that the last update evaluated. */
  uint32_t instances, instances_updated;
  /* The number of receiver-caster pairs that the last update evaluated, and the number of casters, occluders
   * and grounds that it skipped. */
  uint32_t links, links_culled;
  /* The number of instances with a bone that Nook corrected because it was sheared or scaled unevenly. */
  uint32_t uneven_instances;
  /* The number of pairs of a sphere and a key point that the last update evaluated. */
  uint64_t evaluations;
  /* Bytes of host memory that the scene holds now, without its models. */
  uint64_t memory_bytes;
} nook_scene_info;

/* Describes a scene. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_describe(nook_scene scene, nook_scene_info* info);

/* ---- Poses ----
 *
 * Pass the matrices that your engine already has: the skinning matrices of your vertex shader
 * (NOOK_POSE_SKINNING), or the world matrices of the joints (NOOK_POSE_JOINT_TO_WORLD). Nook converts them to
 * its own rest-to-world matrices. Rest space is the bind pose in metres with the node transforms of the file
 * applied. Do not convert your matrices yourself: in many files, a node above the skeleton scales by 0.01 or
 * rotates by 90 degrees. If AO looks wrong, call nook_model_check_pose. docs/poses.md has the formula. */

/* The kind of matrices that you pass. Each kind transforms from another space. All kinds transform to world
 * space, or, if you set place_3x4, to the space that place_3x4 maps to world space. */
enum {
  /* From rest space: Nook's own matrices, as nook_model_convert_pose writes them, one for each bone. Models
   * without bind data accept only this kind. */
  NOOK_POSE_REST_TO_WORLD = 0,
  /* From the joint's own space: the world matrices of joints, bones or nodes, one for each bone. */
  NOOK_POSE_JOINT_TO_WORLD = 1,
  /* From the space of the mesh: joint matrix times inverse bind matrix, as in your vertex shader. Pass one
   * for each joint of the skin `skin` in the order of the file. */
  NOOK_POSE_SKINNING = 2
};
typedef int32_t nook_pose_kind;

/* The layout of one transform. All layouts consist of floats. */
enum {
  /* 12 floats: three rows of rotation and scale | translation. */
  NOOK_TRANSFORM_ROWS_3X4 = 0,
  /* 16 floats: four rows, the last one 0 0 0 1, for column vectors, such as Ogre::Matrix4. */
  NOOK_TRANSFORM_ROWS_4X4 = 1,
  /* 16 floats: four columns, the last one the translation and 1: glTF, glm, OpenGL. Also for matrices of
   * libraries with row vectors (DirectXMath, osg::Matrixf); do not transpose them. */
  NOOK_TRANSFORM_COLUMNS_4X4 = 2,
  /* 12 floats: four columns of three numbers, the last one the translation. */
  NOOK_TRANSFORM_COLUMNS_4X3 = 3,
  /* 8 floats: a unit dual quaternion, real part x y z w, dual part x y z w. */
  NOOK_TRANSFORM_DUAL_QUATERNION = 4,
  /* 10 floats: translation x y z, unit quaternion x y z w, scale x y z. */
  NOOK_TRANSFORM_TRS = 5
};
typedef int32_t nook_transform_layout;

/* Bits of nook_pose_desc.flags. */
enum {
  /* Bones without a transform keep their matrices. With this flag, you can pose a character that has several
   * skins with one call for each skin. */
  NOOK_POSE_FLAG_PARTIAL = 1,
  /* As with strict_poses, the call fails if a bone is sheared or scaled unevenly by more than 1 %. */
  NOOK_POSE_FLAG_STRICT = 2,
  /* transform_count may be larger than needed, as in buffers of fixed size. Nook ignores the surplus. */
  NOOK_POSE_FLAG_SURPLUS = 4
};

typedef struct nook_pose_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_POSE_SKINNING. */
  nook_pose_kind kind;
  /* Default NOOK_TRANSFORM_COLUMNS_4X4. */
  nook_transform_layout layout;
  /* An array of `transform_count` transforms, `stride` bytes apart (0: tightly packed). Must not be NULL. */
  const float* transforms;
  size_t stride;
  /* Must be the number of bones, or of the skin's joints. With transform_of_bone, it can be 1 to 65536. */
  uint32_t transform_count;
  /* For NOOK_POSE_SKINNING: the index of the skin in the file, default 0; see nook_model_describe_skin. */
  uint32_t skin;
  /* NULL (default): bone b uses transform b; with NOOK_POSE_SKINNING, the bone of joint j uses transform j.
   * Otherwise, the transform index of each bone, or -1 for none; nook_model_map_bones fills this array, and
   * bone_count must be the model's bone count. */
  const int32_t* transform_of_bone;
  uint32_t bone_count;
  /* A sum of NOOK_POSE_FLAG_ bits, default 0. */
  uint32_t flags;
  /* NULL (default), or a 3x4 row-major matrix that is applied after every transform and places the character
   * in the world. It may scale and mirror. */
  const float* place_3x4;
} nook_pose_desc;
static inline nook_result nook_pose_desc_init(nook_pose_desc* desc) {
  return nook_desc_init(NOOK_DESC_POSE, desc, sizeof *desc, NOOK_VERSION);
}

/* Sets the pose of an instance. Call it once per frame for each instance that moves, before the update. A
 * matrix may scale the body uniformly, and may mirror it. If all axes of a matrix are zero, its bone shrinks
 * to a point. On failure, the instance keeps its old pose. The call does not allocate. One at a time. Errors:
 * INVALID_ARGUMENT (a count is wrong, or a matrix is not finite; if strict, also if a matrix shears, scales
 * unevenly or scales to zero; the message names the bone), INVALID_HANDLE, UNSUPPORTED (the model has no bind
 * data: bake it again from the glTF file, or pass NOOK_POSE_REST_TO_WORLD). */
NOOK_API nook_result nook_scene_set_pose(nook_scene scene, nook_instance_id instance,
                                         const nook_pose_desc* desc);

/* Converts a pose on any thread, such as your animation jobs. Pass the result to nook_scene_set_pose with
 * NOOK_POSE_REST_TO_WORLD and NOOK_TRANSFORM_ROWS_3X4. `bones_3x4` receives 12 floats for each bone of the
 * model. With NOOK_POSE_FLAG_PARTIAL, entries of bones without a transform are not changed. On failure,
 * `bones_3x4` may be partly written. Does not allocate. Any thread. Errors: as nook_scene_set_pose. */
NOOK_API nook_result nook_model_convert_pose(nook_model model, const nook_pose_desc* desc, float* bones_3x4,
                                             uint32_t bone_count);

/* ---- Bones by name ---- */

/* Bits of nook_bone_map_desc.flags. */
enum {
  /* Ignores case, and the characters space . _ - : | */
  NOOK_BONE_MAP_LOOSE = 1,
  /* Removes the prefix that all of your names share, and the prefix that all of the model's names share, such
   * as "mixamorig:" or "Armature|". A prefix ends with one of . _ - : | */
  NOOK_BONE_MAP_DROP_SHARED_PREFIX = 2
};

typedef struct nook_bone_map_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The names of your `name_count` transforms. A NULL entry matches nothing. */
  const char* const* names;
  uint32_t name_count;
  /* A sum of NOOK_BONE_MAP_ bits, default 0. */
  uint32_t flags;
  /* Text to remove from the beginning or end of your names (`host_`) and of the model's names (`model_`)
   * before comparing them, or NULL (default). */
  const char* host_prefix;
  const char* host_suffix;
  const char* model_prefix;
  const char* model_suffix;
} nook_bone_map_desc;
static inline nook_result nook_bone_map_desc_init(nook_bone_map_desc* desc) {
  return nook_desc_init(NOOK_DESC_BONE_MAP, desc, sizeof *desc, NOOK_VERSION);
}

/* Finds each bone's transform by name, for nook_pose_desc.transform_of_bone: an index into `names`, or -1 if
 * none matches. bone_count must be the model's bone count. If several names are equal, the first one is used.
 * Bones that come from the same joint have the same name. *unmatched receives the number of bones with -1;
 * `unmatched` may be NULL. The call allocates. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_map_bones(nook_model model, const nook_bone_map_desc* desc,
                                          int32_t* transform_of_bone, uint32_t bone_count,
                                          uint32_t* unmatched);

/* ---- Bind data ---- */

typedef struct nook_skin_info {
  uint32_t struct_size;
  /* The index of the skin in the file. */
  uint32_t file_index;
  /* The number of joints of the skin, which is the number of transforms that NOOK_POSE_SKINNING takes. */
  uint32_t joint_count;
  /* The 3x4 row-major matrix from the space of the skin's meshes to rest space; it is S in docs/poses.md. */
  float rest_from_mesh_3x4[12];
} nook_skin_info;

/* Describes a skin; `skin` must be less than nook_model_info.skin_count. Skins that no mesh uses are left
 * out; file_index identifies a skin. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (no bind data). */
NOOK_API nook_result nook_model_describe_skin(nook_model model, uint32_t skin, nook_skin_info* info);

typedef struct nook_check_vertex_info {
  uint32_t struct_size;
  /* The index of the vertex, in the order of nook_scene_read. */
  uint32_t vertex;
  /* The vertex's position in rest space in metres, and in the mesh's space (the file's POSITION). */
  float position[3], mesh_position[3];
  /* The bone with the largest weight. */
  uint32_t bone;
} nook_check_vertex_info;

/* Describes a check vertex for nook_model_check_pose; `index` is less than
 * nook_model_info.check_vertex_count. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (no bind data). */
NOOK_API nook_result nook_model_describe_check_vertex(nook_model model, uint32_t index,
                                                      nook_check_vertex_info* info);

/* ---- The check of a pose ---- */

/* The likely fault of a pose. */
enum {
  NOOK_POSE_FAULT_NONE = 0,
  /* Rows were given as columns, or columns as rows. */
  NOOK_POSE_FAULT_TRANSPOSED = 1,
  /* Skinning matrices were given as rest-to-world matrices: pass NOOK_POSE_SKINNING. */
  NOOK_POSE_FAULT_NO_BIND = 2,
  /* nook_pose_desc.kind does not name the kind of the transforms. */
  NOOK_POSE_FAULT_KIND = 3,
  /* The skinning matrices belong to another skin. */
  NOOK_POSE_FAULT_SKIN = 4,
  /* Transforms are assigned to the wrong bones. */
  NOOK_POSE_FAULT_ORDER = 5,
  /* The transforms and the vertices are in different units. */
  NOOK_POSE_FAULT_UNIT = 6,
  /* The whole pose is rotated, moved or mirrored relative to `place_3x4`. */
  NOOK_POSE_FAULT_PLACE = 7,
  /* The transforms are the inverses of what is needed. */
  NOOK_POSE_FAULT_INVERTED = 8,
  /* None of these faults explains the difference. Perhaps the clips, frames or meshes differ. */
  NOOK_POSE_FAULT_UNKNOWN = 9
};
typedef int32_t nook_pose_fault;

typedef struct nook_pose_check_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The positions from your own skinning: three floats each, `stride` bytes apart (0: 12). Not NULL. */
  const float* positions;
  size_t stride;
  /* The index of the check vertex for each position; NULL (default) means 0, 1, 2 and so on. */
  const uint32_t* check_vertices;
  /* NULL (default), or the 3x4 row-major matrix that transforms the positions to world space. */
  const float* place_3x4;
  /* The number of positions, from 8 to nook_model_info.check_vertex_count. */
  uint32_t vertex_count;
  /* The largest allowed distance, as a share of the model's bounding radius, in (0, 1], default 0.005. */
  float tolerance;
} nook_pose_check_desc;
static inline nook_result nook_pose_check_desc_init(nook_pose_check_desc* desc) {
  return nook_desc_init(NOOK_DESC_POSE_CHECK, desc, sizeof *desc, NOOK_VERSION);
}

typedef struct nook_pose_check_info {
  uint32_t struct_size;
  nook_pose_fault fault;
  /* The largest and the root mean square distance between your vertices and the model's, as shares of the
   * model's bounding radius times the scale of `place_3x4`. */
  float max_error, rms_error;
  /* The bone with the largest weight at the vertex with the largest distance. */
  uint32_t worst_bone;
  /* For NOOK_POSE_FAULT_NO_BIND and NOOK_POSE_FAULT_SKIN: the index of the skin that fits, otherwise 0. */
  uint32_t fitting_skin;
  /* For NOOK_POSE_FAULT_UNIT: multiply lengths of the pose by this to get the vertices' unit; otherwise 1. */
  float scale;
  /* The result as text. It also lists all other faults that would explain the difference. */
  char text[512];
} nook_pose_check_info;

/* Compares a pose with vertices that you skinned yourself. Sets info->fault to the likely fault and returns
 * OK. Use a frame of a clip: in the bind pose, all matrices are equal, which hides faults. The call
 * allocates. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no bind data),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_check_pose(nook_model model, const nook_pose_desc* desc,
                                           const nook_pose_check_desc* check, nook_pose_check_info* info);

/* ---- Vertices of your mesh ----
 *
 * AO values are in the order of the file's vertices. If your engine uses another order, match your vertices
 * once and remap the model. The new model gives AO in your order on every tier. For a mesh with other
 * vertices, such as a level of detail, see experimental/nook_lod.h. */

/* NOOK_ALL_PRIMITIVES selects every primitive of the file. NOOK_NO_VERTEX marks a vertex without a match. */
enum { NOOK_ALL_PRIMITIVES = -1 };
#define NOOK_NO_VERTEX 0xffffffffu

typedef struct nook_vertex_match_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The rest positions of your vertices, three floats each, position_stride bytes apart (0: 12). Not NULL. */
  const float* positions;
  size_t position_stride;
  /* NULL (default), or normals, three floats each, normal_stride bytes apart (0: 12). Normals distinguish the
   * two sides of a card, which share their positions but have different AO. */
  const float* normals;
  size_t normal_stride;
  uint32_t vertex_count;
  /* The primitive of the file that the vertices come from, default NOOK_ALL_PRIMITIVES. */
  int32_t primitive;
  /* 0 (default): positions are in the space and unit of the file's POSITION. 1: in rest space, metres. */
  uint32_t in_rest_space;
  /* The largest distance of a match, as a share of the diagonal of the model's box, in [0, 1]. 0 (default)
   * means 1e-4, which is enough for 16-bit positions. */
  float tolerance;
  /* NULL (default), or joints and weights, `influences` (1 to 8, default 4) for each vertex; strides are in
   * bytes. Weights distinguish vertices where meshes meet. Joint indices refer to the joints of the skin
   * `skin` (default 0), or to bones if the model has no skins. */
  const uint16_t* joints;
  size_t joint_stride;
  const float* weights;
  size_t weight_stride;
  uint32_t influences, skin;
} nook_vertex_match_desc;
static inline nook_result nook_vertex_match_desc_init(nook_vertex_match_desc* desc) {
  return nook_desc_init(NOOK_DESC_VERTEX_MATCH, desc, sizeof *desc, NOOK_VERSION);
}

typedef struct nook_vertex_match_info {
  uint32_t struct_size;
  /* The number of your vertices without a match, and the number that match vertices with different AO. */
  uint32_t unmatched, ambiguous;
  /* The result as text, with the first vertex of each kind and what to do; empty if every match is unique. */
  char text[320];
} nook_vertex_match_info;

/* Finds the model's vertex for each vertex of your mesh: by position, then by normal, weights and order.
 * `vertices` receives vertex_count indices in the order of nook_scene_read, or NOOK_NO_VERTEX if no vertex is
 * near enough. `info` may be NULL; ambiguous vertices are also logged. The call allocates.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no rest positions), OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_match_vertices(nook_model model, const nook_vertex_match_desc* desc,
                                               uint32_t* vertices, nook_vertex_match_info* info);

/* Creates a model whose vertex i is vertex vertices[i] of the given model; everything else is copied. Each
 * primitive of the new model is a range of vertices whose meshes have the same coordinate space. For most
 * files, there is only one primitive. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also for NOOK_NO_VERTEX; the message names it), OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_remap(nook_model model, const uint32_t* vertices, uint32_t count,
                                      nook_model* out);

/* ---- Capsules: what darkens the world ---- */

/* A model has at most NOOK_WORLD_MAX_CASTERS capsules. nook_world.h explains the parts of a light's cone. */
#define NOOK_WORLD_MAX_CASTERS 64
#define NOOK_WORLD_CONE_PARTS 16

/* All points whose distance to the segment from `a` to `b` is at most a radius, which changes linearly along
 * the segment from radius_a to radius_b. In metres. */
typedef struct nook_capsule {
  float a[3];
  float radius_a;
  float b[3];
  float radius_b;
} nook_capsule;

#ifdef __cplusplus
}
#endif
#endif
