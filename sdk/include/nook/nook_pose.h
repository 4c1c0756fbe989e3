/* Poses as engines have them: joint world matrices, skinning matrices, other layouts, other bone orders; and
 * a check that compares a pose with vertices that the host skinned itself.
 *
 * nook_scene_set_pose takes one matrix for each bone from the model's rest space to the world. Rest space is
 * the bind-posed body in metres, after the node transforms of its file. With W(j) the world matrix of joint j
 * in the file's default scene and pose, B(j) its inverse bind matrix, r the joint of the smallest depth (the
 * first such joint in the skin's list; with several skins a joint that an earlier skin bound decides), and S
 * = W(r) B(r), a vertex v of the file lies at S v in rest space. With G(j) the joint's matrix in a frame and
 * P the place of the character, the matrix of the bone is P G(j) B(j) S^-1. S is the identity in many files,
 * and wrong AO is the result where it is not and is left out. The model carries B and S, so that the
 * functions here do the conversion. */
#ifndef NOOK_POSE_H
#define NOOK_POSE_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The space that the transforms of a pose map from; all of them map to the space that `place_3x4` maps to the
 * world. */
enum {
  /* From the model's rest space: the matrices of nook_scene_set_pose. One for each bone. */
  NOOK_POSE_REST_TO_WORLD = 0,
  /* From the joint's own space: global joint matrices G(j), which are node or bone world matrices. One for
   * each bone. */
  NOOK_POSE_JOINT_TO_WORLD = 1,
  /* From the space of the mesh: G(j) B(j), the matrices that a vertex shader skins with. One for each joint
   * of the skin `skin`, in the order of the file. */
  NOOK_POSE_SKINNING = 2
};
typedef int32_t nook_pose_kind;

/* The layout of one transform, all of floats. */
enum {
  /* 12 floats: three rows of rotation and scale | translation. */
  NOOK_TRANSFORM_ROWS_3X4 = 0,
  /* 16 floats: four rows, the last one 0 0 0 1, for column vectors: Ogre::Matrix4. */
  NOOK_TRANSFORM_ROWS_4X4 = 1,
  /* 16 floats: four columns, the last one the translation and 1: glTF, glm, OpenGL. Libraries of row vectors
   * that store rows (DirectXMath, osg::Matrixf) have the same bytes. */
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
  /* Bones without a transform keep their matrices. A character of several skins is posed by one call for each
   * skin with this flag. */
  NOOK_POSE_PARTIAL = 1,
  /* A bone that is sheared or scaled unevenly by more than 1 % fails, instead of being projected to the
   * nearest rotation with one scale, as the baker does. */
  NOOK_POSE_STRICT = 2
};

typedef struct nook_pose_desc {
  /* nook_pose_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Default NOOK_POSE_REST_TO_WORLD. */
  nook_pose_kind kind;
  /* Default NOOK_TRANSFORM_ROWS_3X4. */
  nook_transform_layout layout;
  /* The transforms, transform_count of them, `stride` bytes apart (0: tightly packed). */
  const float* transforms;
  size_t stride;
  uint32_t transform_count;
  /* The skin whose matrices NOOK_POSE_SKINNING takes: its index in the file; see nook_character_model_skin.
   */
  uint32_t skin;
  /* For each bone of the model the index of its transform, or -1 for none; nook_character_model_map_bones
   * makes it from names. bone_count is the model's, or 0 with NULL: bone b takes transform b, and with
   * NOOK_POSE_SKINNING the bone of joint j takes transform j. */
  const int32_t* transform_of_bone;
  uint32_t bone_count;
  /* A sum of NOOK_POSE_ bits, default 0. */
  uint32_t flags;
  /* NULL, or a 3x4 row-major matrix that is applied after every transform: the root of a character whose
   * transforms are relative to it. It may scale (a world in centimetres) and mirror. */
  const float* place_3x4;
} nook_pose_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_pose_desc_init(nook_pose_desc* desc, size_t size, uint32_t header_version);

/* Sets the pose of an instance from a host's own transforms. The call does not allocate. On failure the pose
 * stays as it was.
 * One at a time. Errors: INVALID_ARGUMENT (the message names the bone), INVALID_HANDLE, UNSUPPORTED (the
 * model has no bind data for the kind). */
NOOK_API nook_result nook_scene_set_pose_from(nook_scene scene, nook_instance_id instance,
                                              const nook_pose_desc* desc);

/* Converts a host's transforms to the matrices of nook_scene_set_pose: bones_3x4 takes 12 floats for each
 * bone. With NOOK_POSE_PARTIAL, bones without a transform keep what bones_3x4 holds. bone_count must be the
 * model's. The call does not allocate.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED. */
NOOK_API nook_result nook_character_model_convert_pose(nook_character_model model, const nook_pose_desc* desc,
                                                       float* bones_3x4, uint32_t bone_count);

/* ---- Bones by name ---- */

/* Bits of nook_bone_names.flags. */
enum {
  /* Letters of either case are equal, and the characters space . _ - : | are left out. */
  NOOK_BONE_NAMES_LOOSE = 1,
  /* The part that all names of a side have in common at their beginning, up to one of the characters . _ - :
   * |, is left out: "mixamorig:", "Armature|". */
  NOOK_BONE_NAMES_DROP_SHARED_PREFIX = 2
};

typedef struct nook_bone_names {
  /* sizeof(nook_bone_names); the caller sets it, and the other fields to 0. */
  uint32_t struct_size;
  /* A sum of NOOK_BONE_NAMES_ bits. */
  uint32_t flags;
  /* The names of the host's transforms. NULL entries match nothing. */
  const char* const* names;
  uint32_t name_count;
  uint32_t reserved;
  /* NULL, or text that is removed from the beginning or the end of a name that has it, before names are
   * compared: of the host's names and of the model's. */
  const char* host_prefix;
  const char* host_suffix;
  const char* model_prefix;
  const char* model_suffix;
} nook_bone_names;

/* Finds the transform of each bone by name. transform_of_bone takes an index into names, or -1 where none
 * matches, for each bone; bone_count must be the model's. Bones of one joint share its name. *unmatched,
 * which may be NULL, takes the number of -1; nook_character_model_bone_name gives their names. Of several
 * equal names the first one counts. The call allocates. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
NOOK_API nook_result nook_character_model_map_bones(nook_character_model model, const nook_bone_names* names,
                                                    int32_t* transform_of_bone, uint32_t bone_count,
                                                    uint32_t* unmatched);

/* ---- Bind data ---- */

typedef struct nook_skin_info {
  /* sizeof(nook_skin_info); the caller sets it. */
  uint32_t struct_size;
  /* The index of the skin in the file. */
  uint32_t file_index;
  /* The number of its joints. */
  uint32_t joint_count;
  /* S of the skin: the space of its meshes to rest space, 3x4, row-major. */
  float rest_from_mesh_3x4[12];
} nook_skin_info;

/* Describes skin number `skin` of the model, which is less than nook_character_model_info.skin_count. A model
 * leaves out skins that no mesh uses.
 * Any thread. Errors: INVALID_ARGUMENT (also for a number past the last skin), UNSUPPORTED (no bind data). */
NOOK_API nook_result nook_character_model_skin(nook_character_model model, uint32_t skin,
                                               nook_skin_info* info);

/* Copies the matrix of a bone from rest space to the space of its joint, 12 floats: the matrix of the bone is
 * the joint's world matrix times this one.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (no bind data). */
NOOK_API nook_result nook_character_model_bone_bind(nook_character_model model, uint32_t bone,
                                                    float node_from_rest_3x4[12]);

typedef struct nook_rest_vertex {
  /* sizeof(nook_rest_vertex); the caller sets it. */
  uint32_t struct_size;
  /* The vertex, in the order of nook_scene_read_ao. */
  uint32_t vertex;
  /* Its place in rest space, metres, and in the space of its mesh, which is the file's POSITION. */
  float position[3];
  float mesh_position[3];
  /* The bone with the largest weight. */
  uint32_t bone;
} nook_rest_vertex;

/* Describes rest vertex number `index`, which is less than nook_character_model_info.check_vertex_count: one
 * of the vertices, spread over the bones, that nook_character_model_check_pose compares.
 * Any thread. Errors: INVALID_ARGUMENT (also for an index past the last one), UNSUPPORTED (no bind data). */
NOOK_API nook_result nook_character_model_rest_vertex(nook_character_model model, uint32_t index,
                                                      nook_rest_vertex* vertex);

/* ---- The check of a pose ---- */

/* The likely fault of a pose. */
enum {
  NOOK_POSE_RIGHT = 0,
  /* Rows were given as columns, or columns as rows. */
  NOOK_POSE_TRANSPOSED = 1,
  /* Skinning matrices were given as rest-to-world matrices: S^-1 is missing. */
  NOOK_POSE_MISSING_S = 2,
  /* The transforms are of another kind than `kind`. */
  NOOK_POSE_WRONG_KIND = 3,
  /* The skinning matrices are of another skin. */
  NOOK_POSE_WRONG_SKIN = 4,
  /* Transforms go to the wrong bones. */
  NOOK_POSE_WRONG_ORDER = 5,
  /* The transforms and the vertices are in different units. */
  NOOK_POSE_WRONG_UNIT = 6,
  /* The pose is turned, moved or mirrored as a whole against the place. */
  NOOK_POSE_WRONG_PLACE = 7,
  /* The transforms are the inverses of what is needed. */
  NOOK_POSE_INVERTED = 8,
  /* None of these explains the difference: other clips or frames, another mesh. */
  NOOK_POSE_UNKNOWN_FAULT = 9
};
typedef int32_t nook_pose_fault;

typedef struct nook_pose_check {
  /* sizeof(nook_pose_check); the caller sets it. */
  uint32_t struct_size;
  /* In: the number of vertices, at least 8. */
  uint32_t vertex_count;
  /* In: which rest vertices they are, or NULL for 0, 1, 2 and so on. */
  const uint32_t* rest_vertices;
  /* In: where the host's own skinning puts them, three floats each, `stride` bytes apart (0: 12). */
  const float* positions;
  size_t stride;
  /* In: NULL if the positions are in the world, else the matrix that brings them there, 3x4, row-major: the
   * place that the host means. */
  const float* place_3x4;
  /* In: the largest distance that counts as equal, as a share of the model's bounding radius; 0: 0.005. */
  float tolerance;
  /* Out: what is likely wrong. */
  nook_pose_fault fault;
  /* Out: the largest and the root mean square distance between the host's vertices and the model's, as shares
   * of the model's bounding radius times the scale of the place. */
  float max_error;
  float rms_error;
  /* Out: the bone with the largest weight at the vertex that is farthest off. */
  uint32_t worst_bone;
  /* Out: for NOOK_POSE_WRONG_SKIN the index of the skin that fits, for NOOK_POSE_WRONG_UNIT the factor of the
   * pose's length unit to the vertices', else 0 and 1. */
  uint32_t fitting_skin;
  float scale;
  /* Out: the same in words, with names. */
  char text[512];
} nook_pose_check;

/* Compares the pose that desc describes with vertices that the host skinned itself, in any frame, and names
 * the likely fault. In the bind pose alone all bones have the same matrix, so that their order cannot be
 * seen; a frame of a clip tells everything. The call allocates.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no bind data), OUT_OF_MEMORY. A wrong pose
 * is no error of the call: it returns OK, and check->fault tells. */
NOOK_API nook_result nook_character_model_check_pose(nook_character_model model, const nook_pose_desc* desc,
                                                     nook_pose_check* check);

#ifdef __cplusplus
}
#endif
#endif
