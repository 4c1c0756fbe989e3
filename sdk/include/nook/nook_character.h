/* Dynamic ambient occlusion of skinned characters: baked models, scenes of instances, evaluation on the CPU.
 *
 * The model (Le et al., I3D 2019): proxy spheres ride on bones and cast shadow on key points; each vertex blends a few
 * key points. A scene holds instances of models with their poses; links let one instance darken another; the ground and
 * free occluders darken what they touch. Nothing of this needs retraining. */
#ifndef NOOK_CHARACTER_H
#define NOOK_CHARACTER_H

#include "nook.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_character_model_s* nook_character_model;
typedef struct nook_scene_s* nook_scene;
typedef uint32_t nook_instance_id; /* 0 is never a valid id; ids are not reused while their scene lives */
typedef uint32_t nook_occluder_id; /* the same */

/* ---- Models: immutable, shared by any number of scenes and threads ---- */

/* Loads a character model from the bytes of a .nook file, which may be freed afterwards. Everything is validated; safe on
 * hostile bytes. On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_character_model_load(nook_context context, const void* bytes, size_t size,
                                               nook_character_model* out);

/* Releases the caller's hold and sets *model to NULL; scenes that use it keep it alive. Any thread. */
NOOK_API void nook_character_model_destroy(nook_character_model* model);

typedef struct nook_character_model_info {
  uint32_t struct_size;          /* sizeof(nook_character_model_info), set by the caller */
  uint32_t bone_count;           /* matrices that nook_scene_set_pose needs */
  uint32_t sphere_count;
  uint32_t key_point_count;
  uint32_t vertex_count;         /* welded vertices */
  uint32_t file_vertex_count;    /* AO values in the imported file's vertex order, all primitives in a row */
  uint32_t primitive_count;
  uint32_t lod_count;            /* 1: full detail only */
  float bounding_radius;         /* metres, of the rest pose round its centroid */
  float gamma;                   /* exponent of the shadow norm */
} nook_character_model_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_character_model_describe(nook_character_model model, nook_character_model_info* info);

/* The name of a bone, so that a host can map its skeleton to the model's order. Valid while the model lives. Any thread.
 * NULL for an index out of range. */
NOOK_API const char* nook_character_model_bone_name(nook_character_model model, uint32_t bone);

/* First AO value and number of AO values of one primitive of the imported file. Primitives come in the file's node order,
 * then mesh order. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_character_model_primitive(nook_character_model model, uint32_t primitive,
                                                    uint32_t* first_vertex, uint32_t* vertex_count);

/* The AO of the baked rest pose in file order, what a static bake would give. Any thread.
 * Errors: INVALID_ARGUMENT (count is not file_vertex_count), UNSUPPORTED (the model was baked without it). */
NOOK_API nook_result nook_character_model_static_ao(nook_character_model model, float* out, uint32_t count);

/* ---- Scenes ---- */

enum {
  NOOK_COMBINE_COMPOSED = 0, /* added casters form a cosine-weighted term of their own: AO = self * (1 - added) */
  NOOK_COMBINE_PAPER = 1     /* added spheres join the one norm of the self-shadow, as the paper has it */
};
typedef int32_t nook_combine;

typedef struct nook_scene_desc {
  uint32_t struct_size;         /* set by nook_scene_desc_init */
  uint32_t header_version;      /* set by nook_scene_desc_init */
  const void* next;             /* NULL */
  nook_combine combine;         /* default NOOK_COMBINE_COMPOSED */
  nook_isa isa;                 /* default NOOK_ISA_AUTO; a better one than the processor has: UNSUPPORTED */
  float cutoff_error;           /* AO; linked casters and occluders that darken by less than this bound are skipped.
                                   [0, 1], default 1/1024; 0 culls nothing */
  float lod_error;              /* AO, rms; the coarsest level whose baked error (of self-shadow) is below this times
                                   (distance to the camera / lod_distance) is used. >= 0, default 0: full detail */
  float lod_distance;           /* metres, > 0, default 10 */
  uint32_t lod_max_interval;    /* frames; a distant instance is updated at least this often. >= 1, default 1: always */
  float ground_radius;          /* metres, radius of the sphere that stands for a ground plane. > 0, default 10,000 */
  uint32_t reserved;            /* 0 */
} nook_scene_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_scene_desc_init(nook_scene_desc* desc, size_t size, uint32_t header_version);

/* On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_create(nook_context context, const nook_scene_desc* desc, nook_scene* out);

/* Sets *scene to NULL. GL objects made for it become invalid but may still be destroyed. One at a time. */
NOOK_API void nook_scene_destroy(nook_scene* scene);

/* Adds an instance in the rest pose, without ground and links. Allocates. One at a time.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_instance(nook_scene scene, nook_character_model model, nook_instance_id* out);

/* Removes an instance and every link from and to it. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_instance(nook_scene scene, nook_instance_id instance);

/* Sets the pose: one 3x4 matrix per bone, row-major (12 floats: three rows of rotation | translation), rest space in metres
 * to world space, rigid or with uniform scale, which scales radii. bone_count must be the model's. No allocation.
 * One at a time. Errors: INVALID_ARGUMENT (wrong count, not finite, sheared or unevenly scaled by more than 1 %: names the
 * bone), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_pose(nook_scene scene, nook_instance_id instance, const float* bones_3x4,
                                         uint32_t bone_count);

/* Lets caster darken receiver until unlinked; linking twice is one link. Allocates. One at a time.
 * Errors: INVALID_ARGUMENT (both the same), INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_link(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* Undoes nook_scene_link. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE (also: there is no such link). */
NOOK_API nook_result nook_scene_unlink(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

/* From the next update on, each instance is also darkened by its k nearest instances within max_distance (metres between
 * bounding-sphere centres), found anew each update by a grid, so that the cost grows linearly with the crowd. k = 0 turns
 * it off; k <= 16. May allocate here, not in the update. One at a time.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_link_nearest(nook_scene scene, uint32_t k, float max_distance);

/* Ground under an instance: a plane, points p with normal . p = offset, normal (unit length to 1e-3) away from the ground,
 * world space, metres. It is evaluated as a sphere of ground_radius tangent to the plane under the instance, following it.
 * plane_xyzd NULL: no ground. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_ground(nook_scene scene, nook_instance_id instance, const float* plane_xyzd);

/* Adds a sphere (world space, metres) that darkens every instance. Allocates. One at a time.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_add_occluder(nook_scene scene, const float centre_ws[3], float radius,
                                             nook_occluder_id* out);
/* Moves or resizes it; no allocation. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_occluder(nook_scene scene, nook_occluder_id occluder, const float centre_ws[3],
                                             float radius);
/* One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_remove_occluder(nook_scene scene, nook_occluder_id occluder);

/* ---- Directional occlusion: what is taken from the light of a probe, channel by channel ----
 *
 * Light that comes from few directions is darkened by what stands there, and by nothing else. With lobes set, each sphere takes
 * from its receiver, instead of its share f of the hemisphere, f * rho: rho is the mean radiance of the lobes behind the sphere
 * over their mean in the receiver's hemisphere, for each channel; the spheres of a linked instance share one rho, that of the ground
 * is of the half-space below its plane. What comes out is a colour for each vertex that takes the place of AO in
 * albedo / pi * E * AO, E the irradiance of the same lobes. Under constant light it is AO. Evaluated by nook_scene_update and by
 * nook_gl_scene_update; nook_gl_scene_light says what a shader does with it. */

/* Sets the light of an instance for the updates that follow: lobes such as nook_probe_read_lobes gives at its place, at most
 * NOOK_PROBE_MAX_FUNCTIONS, copied. lobe_count 0 or lobes NULL: none. With 12 lobes an update of an instance
 * takes 0.1 to 0.2 ms longer on one core with AVX2, and as much for each neighbour. Allocates at an instance's first light. One at a time.
 * Errors: INVALID_ARGUMENT (names the lobe), INVALID_HANDLE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_scene_set_light(nook_scene scene, nook_instance_id instance, const nook_probe_lobe* lobes,
                                          uint32_t lobe_count);

/* As nook_scene_read_ao, with three floats (red, green, blue, in [0, 1]) for each vertex; AO in all three for an instance whose
 * last nook_scene_update saw no light. count is in vertices; stride is in bytes (0: three floats).
 * Any thread while no other call changes the scene. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_directional_ao(nook_scene scene, nook_instance_id instance, float* out_rgb, uint32_t count,
                                                    size_t stride);

/* Where the camera is, for level of detail. Without a call, and after one with NULL, every instance is near.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_camera(nook_scene scene, const float position_ws[3]);

enum { NOOK_TERM_SELF = 1, NOOK_TERM_LINKS = 2, NOOK_TERM_GROUND = 4, NOOK_TERM_OCCLUDERS = 8, NOOK_TERM_ALL = 15 };
/* Which casters count, for debug views and artists; default NOOK_TERM_ALL. Without NOOK_TERM_SELF the bias of the fit is
 * left out too, so that an instance with nothing near it is open. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_terms(nook_scene scene, uint32_t terms);

/* Evaluates the shadows of all instances at their key points on the CPU, through the context's parallel_for if there is one.
 * No allocation, no locks. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_update(nook_scene scene);

/* Writes the AO of the last nook_scene_update in the imported file's vertex order, all primitives in a row; 1 for an instance
 * that none has seen yet. stride is in bytes (0: sizeof(float)); count must be the model's file_vertex_count. No allocation.
 * Any thread while no other call changes the scene. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_ao(nook_scene scene, nook_instance_id instance, float* out, uint32_t count,
                                        size_t stride);

typedef struct nook_scene_stats {
  uint32_t struct_size;           /* sizeof(nook_scene_stats), set by the caller */
  uint32_t instances;
  uint32_t instances_updated;     /* in the last update; fewer than instances with lod_max_interval > 1 */
  uint32_t links;                 /* receiver-caster pairs evaluated in the last update */
  uint32_t links_culled;          /* pairs skipped by cutoff_error */
  uint64_t evaluations;           /* sphere-key-point pairs of the last update */
} nook_scene_stats;
/* One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_read_stats(nook_scene scene, nook_scene_stats* stats);

#ifdef __cplusplus
}
#endif
#endif
