/* Dynamic ambient occlusion of skinned characters: baked models, scenes of instances, evaluation on the CPU.
 *
 * The model is that of B. H. Le et al., I3D 2019. Proxy spheres are rigid to bones and cast shadow on key
 * points, and each vertex blends the shadows of a few key points. A scene holds instances of models with
 * their poses. Links let one instance darken another; the ground and free occluders darken instances as well.
 * None of these needs a new bake. */
#ifndef NOOK_CHARACTER_H
#define NOOK_CHARACTER_H

#include "nook.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_character_model_s* nook_character_model;
typedef struct nook_scene_s* nook_scene;
/* Identify an instance and an occluder of a scene. 0 is never a valid id, and no id is used again while its
 * scene lives. */
typedef uint32_t nook_instance_id;
typedef uint32_t nook_occluder_id;

/* ---- Models: immutable, shared by any number of scenes and threads ---- */

/* Loads a character model from the bytes of a .nook file; the caller may free the bytes afterwards. The
 * library validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_character_model_load(nook_context context, const void* bytes, size_t size,
                                               nook_character_model* out);

/* Releases the caller's reference and sets *model to NULL; scenes that use the model keep it alive.
 * Any thread. */
NOOK_API void nook_character_model_destroy(nook_character_model* model);

typedef struct nook_character_model_info {
  /* sizeof(nook_character_model_info); the caller sets it. */
  uint32_t struct_size;
  /* The number of matrices that nook_scene_set_pose needs. */
  uint32_t bone_count;
  uint32_t sphere_count;
  uint32_t key_point_count;
  /* The number of vertices after welding. */
  uint32_t vertex_count;
  /* The number of AO values: one for each vertex of the imported file, the primitives one after another. */
  uint32_t file_vertex_count;
  uint32_t primitive_count;
  /* The number of levels of detail, full detail included; at least 1. */
  uint32_t lod_count;
  /* Metres; the radius of the rest pose about the centre of its bounding box. */
  float bounding_radius;
  /* The exponent of the shadow norm (Le et al. 2019, slide 20). */
  float gamma;
  /* The number of skins of nook_character_model_skin; 0 without bind data. */
  uint32_t skin_count;
  /* The number of vertices of nook_character_model_rest_vertex, at most 64; 0 without bind data. */
  uint32_t check_vertex_count;
} nook_character_model_info;

/* Describes a model.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_character_model_describe(nook_character_model model,
                                                   nook_character_model_info* info);

/* The host memory of a model, in bytes, without what the allocator adds to each piece. */
typedef struct nook_character_memory {
  /* sizeof(nook_character_memory); the caller sets it. */
  uint32_t struct_size;
  uint32_t reserved;
  /* The bytes of the model itself, which all its instances share. */
  uint64_t model_bytes;
  /* The bytes of an instance of it in a scene, without links to others. */
  uint64_t instance_bytes;
  /* The same after nook_scene_set_light. */
  uint64_t lit_instance_bytes;
} nook_character_memory;

/* Computes the host memory of a model, and of an instance before there is one. nook_gl_model_memory does so
 * for OpenGL. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_character_model_memory(nook_character_model model, nook_character_memory* memory);

/* Returns the name of a bone, so that a host can map its skeleton to the model's order, or NULL for an index
 * out of range. The text is valid while the model lives.
 * Any thread. */
NOOK_API const char* nook_character_model_bone_name(nook_character_model model, uint32_t bone);

/* Gives the first AO value and the number of AO values of one primitive of the imported file. Primitives are
 * in the order of the file's nodes, and within a node in the order of its mesh.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_character_model_primitive(nook_character_model model, uint32_t primitive,
                                                    uint32_t* first_vertex, uint32_t* vertex_count);

/* Copies the ray-traced AO of the rest pose in the file's vertex order; this is what a static bake gives.
 * count must be file_vertex_count.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model was baked without static AO). */
NOOK_API nook_result nook_character_model_static_ao(nook_character_model model, float* out, uint32_t count);

/* ---- Bent normals: the mean direction of the light that reaches a vertex ----
 *
 * Glossy reflections are occluded by what stands in their direction. The bent normal points to where a vertex
 * is open; a specular occlusion takes it with AO. A model has bent normals after `nook bake bent`. For each
 * vertex it holds two blocked vectors, the cosine-weighted means of the directions that the body blocks, at
 * AO 0 and at AO 1. With AO from any call of this library, the normal n and both vectors turned as the normal
 * is, a vertex shader has bent normal = normalize(2/3 n - mix(dark, open, AO)), which is
 * nook_scene_bent_normal of nook_gl_scene_light's text. It costs no update and is the same on all tiers. AO
 * by neighbours and the ground counts as if the body itself darkened the vertex. */

/* Copies the blocked vectors in the file's vertex order, 8 bytes for each vertex: x, y, z at AO 0, a 0, x, y,
 * z at AO 1, a 0, as signed bytes of which 127 is 1: two attributes of GL_BYTE, normalised. They are in the
 * space of the file's NORMAL attribute where the model has bind data, otherwise in rest space. count must be
 * file_vertex_count; stride is in bytes (0: 8).
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model was baked without bent normals). */
NOOK_API nook_result nook_character_model_blocked_vectors(nook_character_model model, int8_t* out,
                                                          uint32_t count, size_t stride);

/* ---- Scenes ---- */

/* The combination of self-shadow with casters that were not part of the bake. */
enum {
  /* Added casters form a cosine-weighted term of their own: AO = self * (1 - added). */
  NOOK_COMBINE_COMPOSED = 0,
  /* Added spheres join the norm of the self-shadow, as in Le et al. 2019. */
  NOOK_COMBINE_PAPER = 1
};
typedef int32_t nook_combine;

typedef struct nook_scene_desc {
  /* nook_scene_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Default NOOK_COMBINE_COMPOSED. */
  nook_combine combine;
  /* Default NOOK_ISA_AUTO. An instruction set that the processor lacks fails with UNSUPPORTED. */
  nook_isa isa;
  /* AO, in [0, 1], default 1/1024. An update skips each linked caster, occluder and ground whose largest
   * possible darkening of an instance is below this bound. 0 skips nothing. */
  float cutoff_error;
  /* AO, root mean square, >= 0, default 0: full detail. An update uses the coarsest level whose baked error
   * of self-shadow is below lod_error * (distance to the camera / lod_distance). */
  float lod_error;
  /* Metres, > 0, default 10. */
  float lod_distance;
  /* Frames, >= 1, default 1: every frame. An update may skip a distant instance, but evaluates it at least
   * once in this many frames. */
  uint32_t lod_max_interval;
  /* Metres, > 0, default 10,000: the radius of the sphere that stands for a ground plane. */
  float ground_radius;
  /* 0 or 1, default 0: a bone that is sheared or scaled unevenly is projected to the nearest rotation with
   * one scale, as the baker does, and the context logs it once for an instance. 1: such a pose fails. */
  uint32_t strict_poses;
  /* AO, root mean square over a body, in [0, 1], default 1/1024. nook_scene_update merges the spheres of a
   * linked caster into 16, 6 or 2 groups, as few as an estimate of the change of AO allows at their distance
   * from the receiver, and far spheres of the body itself where it has the default kernel, at most 256
   * spheres, full detail and no light. The change of a vertex is larger: up to 18 times as much was seen.
   * 0 merges nothing, and neither do NOOK_COMBINE_PAPER and the OpenGL 4.3 tier. */
  float far_error;
  /* Must be 0. */
  uint32_t reserved;
} nook_scene_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_scene_desc_init(nook_scene_desc* desc, size_t size, uint32_t header_version);

/* Creates an empty scene. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_create(nook_context context, const nook_scene_desc* desc, nook_scene* out);

/* Destroys the scene and sets *scene to NULL. GL objects of the scene become invalid but may still be
 * destroyed.
 * One at a time. */
NOOK_API void nook_scene_destroy(nook_scene* scene);

/* Adds an instance in the rest pose, without ground and links. The call allocates.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_instance(nook_scene scene, nook_character_model model,
                                             nook_instance_id* out);

/* Removes an instance and every link from and to it.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_instance(nook_scene scene, nook_instance_id instance);

/* Gives an instance another model with the same number of bones: a new bake of the same character while it
 * runs, or the model of a coarser mesh. Pose, links, ground and light stay; AO is 1 until the next update,
 * and a host calls nook_gl_scene_ao_buffer again for its view on the GPU. The call allocates; on failure
 * nothing has changed. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_set_model(nook_scene scene, nook_instance_id instance,
                                          nook_character_model model);

/* Sets the pose of an instance. bones_3x4 holds one 3x4 matrix for each bone, row-major: 12 floats, three
 * rows of rotation | translation. A matrix maps rest space to world space, both in metres; it is rigid, or
 * has one scale for all axes, which scales radii, and may mirror. nook_pose.h defines rest space, and takes
 * the matrices that an engine has. bone_count must be the model's. The call does not allocate. One at a time.
 * Errors: INVALID_ARGUMENT (the count is wrong, or a matrix is not finite; with strict_poses also a matrix
 * that is sheared or scales unevenly by more than 1 %; the message names the bone), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_pose(nook_scene scene, nook_instance_id instance, const float* bones_3x4,
                                         uint32_t bone_count);

/* Links two instances, so that caster darkens receiver until nook_scene_unlink; a second call for the same
 * pair changes nothing. The call allocates.
 * One at a time. Errors: INVALID_ARGUMENT (receiver and caster are the same), INVALID_HANDLE, OUT_OF_MEMORY.
 */
NOOK_API nook_result nook_scene_link(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* Removes a link of nook_scene_link.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE (an id is unknown, or the instances are not
 * linked). */
NOOK_API nook_result nook_scene_unlink(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* Links each instance to its k nearest instances in addition to the links above, from the next update on. k
 * is 0 to 16; 0 turns the automatic links off. max_distance is in metres between the centres of bounding
 * spheres. Each update finds the nearest instances anew with a grid, whose cost grows linearly with the
 * number of instances where they are spread out. This call may allocate, so that the update does not.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_link_nearest(nook_scene scene, uint32_t k, float max_distance);

/* Sets the ground under an instance: the plane of the points p with dot(normal, p) = offset, in world space
 * and metres. plane_xyzd holds the normal, which points away from the ground and has unit length to 1e-3, and
 * the offset. The ground is evaluated as a sphere of ground_radius that touches the plane under the instance
 * and follows it. plane_xyzd NULL removes the ground.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_ground(nook_scene scene, nook_instance_id instance,
                                           const float* plane_xyzd);

/* Adds a sphere that darkens every instance; centre_ws and radius are in world space and metres. The call
 * allocates.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_occluder(nook_scene scene, const float centre_ws[3], float radius,
                                             nook_occluder_id* out);

/* Moves or resizes an occluder. The call does not allocate.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_occluder(nook_scene scene, nook_occluder_id occluder,
                                             const float centre_ws[3], float radius);

/* Limits an occluder to one instance, such as a shield to its bearer; other instances are not darkened by it.
 * receiver 0 lifts the limit. An occluder whose instance is removed darkens none. The call does not allocate.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_limit_occluder(nook_scene scene, nook_occluder_id occluder,
                                               nook_instance_id receiver);

/* Removes an occluder.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_occluder(nook_scene scene, nook_occluder_id occluder);

/* ---- Directional occlusion: the occlusion of a probe's light, by colour channel ----
 *
 * Light that comes from few directions is darkened only by what stands in these directions. With lobes set, a
 * sphere that covers the share f of its receiver's hemisphere takes f * rho of the light instead of f. For
 * each channel, rho is the mean radiance of the lobes behind the sphere over their mean radiance in the
 * receiver's hemisphere. The spheres of a linked instance share one rho, and the rho of the ground is that of
 * the half-space below its plane. The result is a colour for each vertex that takes the place of AO in
 * albedo / pi * E * AO, where E is the irradiance of the same lobes. Under constant light it is equal to AO.
 * nook_scene_update and nook_gl_scene_update both evaluate it; nook_gl_scene_light describes the use in a
 * shader. */

/* Sets the light of an instance for the updates that follow. lobes are the light at its place, such as the
 * result of nook_probe_read_lobes; there are at most NOOK_PROBE_MAX_FUNCTIONS, and the call copies them.
 * lobe_count 0 or lobes NULL removes the light. With 12 lobes an update of an instance takes 0.1 to 0.2 ms
 * longer on one core with AVX2, and as much again for each linked instance. The call allocates at the first
 * light of an instance.
 * One at a time. Errors: INVALID_ARGUMENT (the message names the lobe), INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_set_light(nook_scene scene, nook_instance_id instance,
                                          const nook_probe_lobe* lobes, uint32_t lobe_count);

/* Writes the directional occlusion of the last nook_scene_update as nook_scene_read_ao does, with three
 * floats (red, green, blue, in [0, 1]) for each vertex. If that update found no light on the instance, all
 * three are its AO. count is in vertices; stride is in bytes (0: three floats).
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_directional_ao(nook_scene scene, nook_instance_id instance,
                                                    float* out_rgb, uint32_t count, size_t stride);

/* Sets the position of the camera, in world space and metres, for the choice of levels of detail. Without a
 * position, and after a call with NULL, every instance has full detail in every update.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_camera(nook_scene scene, const float position_ws[3]);

/* The casters that an update can leave out. */
enum {
  NOOK_TERM_SELF = 1,
  NOOK_TERM_LINKS = 2,
  NOOK_TERM_GROUND = 4,
  NOOK_TERM_OCCLUDERS = 8,
  NOOK_TERM_ALL = 15
};

/* Chooses the casters that updates evaluate, a sum of NOOK_TERM_ values, for debug views and artists; default
 * NOOK_TERM_ALL. Without NOOK_TERM_SELF the bias of the fit is left out as well, so that an instance without
 * added casters is open.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_terms(nook_scene scene, uint32_t terms);

/* Evaluates the shadows of all instances at their key points on the CPU, through the context's parallel_for
 * if there is one. The call neither allocates nor locks.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_update(nook_scene scene);

/* Writes the AO of the last nook_scene_update in the imported file's vertex order, the primitives one after
 * another. The AO of an instance that no update has evaluated yet is 1. count must be the model's
 * file_vertex_count; stride is in bytes (0: sizeof(float)). The call does not allocate.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_ao(nook_scene scene, nook_instance_id instance, float* out,
                                        uint32_t count, size_t stride);

/* Writes the bent normals of an instance for hosts without a skinning shader, in the imported file's vertex
 * order, 4 bytes for each vertex: x, y, z in world space and AO, as signed bytes of which 127 is 1. AO is
 * that of the last nook_scene_update, and normals follow the pose that is set; each vertex turns with the key
 * point that it takes most from. count must be the model's file_vertex_count; stride is in bytes (0: 4). The
 * call does not allocate. Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT,
 * INVALID_HANDLE, UNSUPPORTED (the model was baked without bent normals or rest normals). */
NOOK_API nook_result nook_scene_read_bent_normals(nook_scene scene, nook_instance_id instance, int8_t* out,
                                                  uint32_t count, size_t stride);

/* The numbers of an AO value. */
enum {
  /* 32-bit floats. */
  NOOK_AO_FLOAT = 0,
  /* 16-bit floats, rounded to the nearest. */
  NOOK_AO_HALF = 1,
  /* Bytes, 255 for 1, rounded to the nearest: within 1/510. */
  NOOK_AO_UNORM8 = 2
};
typedef int32_t nook_ao_format;

/* Writes the AO of the last nook_scene_update as nook_scene_read_ao does, as numbers of `format`. stride is
 * in bytes (0: tightly packed), a value owns only its own bytes. Any thread, while no call changes the scene.
 * Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_ao_as(nook_scene scene, nook_instance_id instance, nook_ao_format format,
                                           void* out, uint32_t count, size_t stride);

/* Returns the bytes of host memory that the scene holds now, without its models.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_memory(nook_scene scene, uint64_t* bytes);

typedef struct nook_scene_stats {
  /* sizeof(nook_scene_stats); the caller sets it. */
  uint32_t struct_size;
  uint32_t instances;
  /* Instances that the last update evaluated; these can be fewer than `instances` if lod_max_interval is
   * above 1. */
  uint32_t instances_updated;
  /* Pairs of receiver and caster that the last update evaluated. */
  uint32_t links;
  /* Linked casters, occluders and grounds that the last update skipped because of cutoff_error. */
  uint32_t links_culled;
  /* Pairs of sphere and key point that the last update evaluated. */
  uint64_t evaluations;
} nook_scene_stats;

/* Gives the counts of the last update.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_read_stats(nook_scene scene, nook_scene_stats* stats);

#ifdef __cplusplus
}
#endif
#endif
