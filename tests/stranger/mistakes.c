/* Wrong poses: the check must complain about each and name its cause. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/stranger/stranger.h"

/* One pose that is right at first, and then gets one mistake. */
typedef struct trial {
  const stranger* s;
  uint32_t frame, skin;
  stranger_pose pose, right;
  float* positions; /* of the check vertices, in the engine's model space */
  const float* place;
  float own_place[12];
  int is_joints; /* the pose has the world matrices of all nodes */
} trial;

static const float no_place[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
static const float far_place[12] = {0.8F, 0, 0.6F, 40, 0, 1, 0, 3, -0.6F, 0, 0.8F, -25};
static const float tilted_place[12] = {0.8F, 0.36F, 0.48F, 2, 0, 0.8F, -0.6F, 3, -0.6F, 0.48F, 0.64F, -5};

static float* transform_of(trial* t, uint32_t index) {
  return t->pose.transforms + 16 * (size_t)index;
}

/* Each mistake returns 0 where it cannot be made. */

static int transpose_transforms(trial* t) {
  for (uint32_t i = 0; i < t->pose.desc.transform_count; ++i) {
    float m[16];
    memcpy(m, transform_of(t, i), sizeof m);
    matrix_transpose(m, transform_of(t, i));
  }
  return 1;
}

static int transpose_rotations(trial* t) {
  for (uint32_t i = 0; i < t->pose.desc.transform_count; ++i) {
    float m[16];
    memcpy(m, transform_of(t, i), sizeof m);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) transform_of(t, i)[4 * row + column] = m[4 * column + row];
  }
  return 1;
}

static int read_columns_as_rows(trial* t) {
  t->pose.desc.layout = NOOK_TRANSFORM_ROWS_4X4;
  return 1;
}

static int read_three_rows_as_columns(trial* t) {
  stranger_change_layout(&t->pose, NOOK_TRANSFORM_ROWS_3X4);
  t->pose.desc.layout = NOOK_TRANSFORM_COLUMNS_4X3;
  return 1;
}

static int read_three_columns_as_rows(trial* t) {
  stranger_change_layout(&t->pose, NOOK_TRANSFORM_COLUMNS_4X3);
  t->pose.desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  return 1;
}

/* The joint of the skin for each bone, as the bones' names and the file give them. */
static int32_t* joint_of_bone(const trial* t) {
  const engine_skin* const skin = &t->s->engine.skins[t->skin];
  int32_t* const out = engine_memory(t->s->info.bone_count * sizeof *out);
  for (uint32_t b = 0; b < t->s->info.bone_count; ++b) {
    out[b] = -1;
    for (uint32_t j = 0; j < skin->joint_count; ++j)
      if (t->s->transform_of_bone[b] == (int32_t)skin->joints[j]) out[b] = (int32_t)j;
  }
  return out;
}

/* The transforms stay; the descriptor says another kind. The map is freed with the program. */
static int say_kind(trial* t, nook_pose_kind kind) {
  if (t->is_joints || t->s->unnamed_bones) return 0;
  t->pose.desc.kind = kind;
  t->pose.desc.transform_of_bone = joint_of_bone(t);
  t->pose.desc.bone_count = t->s->info.bone_count;
  return 1;
}
static int skinning_as_joints(trial* t) {
  return say_kind(t, NOOK_POSE_JOINT_TO_WORLD);
}
static int leave_out_s(trial* t) {
  return say_kind(t, NOOK_POSE_REST_TO_WORLD);
}

static int joints_as_skinning(trial* t) {
  if (t->is_joints) return 0;
  for (uint32_t j = 0; j < t->pose.desc.transform_count; ++j)
    memcpy(transform_of(t, j), engine_world(&t->s->engine, t->frame, t->s->engine.skins[t->skin].joints[j]),
           16 * sizeof(float));
  return 1;
}

static int joints_as_rest(trial* t) {
  if (!t->is_joints) return 0;
  t->pose.desc.kind = NOOK_POSE_REST_TO_WORLD;
  return 1;
}

/* Says that the matrices are another skin's. */
static int say_other_skin(trial* t) {
  nook_skin_info skin;
  memset(&skin, 0, sizeof skin);
  skin.struct_size = sizeof skin;
  for (uint32_t k = 0; k < t->s->info.skin_count && !t->is_joints; ++k) {
    stranger_need(nook_model_describe_skin(t->s->model, k, &skin), "the skin");
    if (skin.file_index == t->skin || skin.joint_count != t->pose.desc.transform_count) continue;
    t->pose.desc.skin = skin.file_index;
    return 1;
  }
  return 0;
}

static int invert_transforms(trial* t) {
  for (uint32_t i = 0; i < t->pose.desc.transform_count; ++i)
    matrix_inverse(transform_of(t, i), transform_of(t, i));
  return 1;
}

/* The bone of a transform takes another one: of the joint or the bone beside it. */
static int shift_transforms(trial* t, uint32_t by) {
  if (t->is_joints) {
    int32_t* const map = engine_memory(t->s->info.bone_count * sizeof *map);
    for (uint32_t b = 0; b < t->s->info.bone_count; ++b)
      map[b] = t->s->transform_of_bone[(b + by) % t->s->info.bone_count];
    t->pose.desc.transform_of_bone = map;
    return t->s->info.bone_count > 1 && !t->s->unnamed_bones;
  }
  const uint32_t count = t->pose.desc.transform_count;
  for (uint32_t j = 0; j < count; ++j)
    memcpy(transform_of(t, j), t->right.transforms + 16 * (size_t)((j + by) % count), 16 * sizeof(float));
  return count > 1;
}
static int shift_forth(trial* t) {
  return shift_transforms(t, 1);
}
static int shift_back(trial* t) {
  return shift_transforms(t, (t->is_joints ? t->s->info.bone_count : t->pose.desc.transform_count) - 1);
}

static int scale_translations(trial* t, float scale) {
  for (uint32_t i = 0; i < t->pose.desc.transform_count; ++i)
    for (int row = 12; row < 15; ++row) transform_of(t, i)[row] *= scale;
  return 1;
}
static int bones_in_centimetres(trial* t) {
  return scale_translations(t, 100);
}
static int bones_in_metres(trial* t) {
  return scale_translations(t, 0.01F);
}

static int scale_positions(trial* t, float scale) {
  for (uint32_t i = 0; i < 3 * t->s->info.check_vertex_count; ++i) t->positions[i] *= scale;
  return 1;
}
static int positions_in_centimetres(trial* t) {
  return scale_positions(t, 100);
}
static int positions_in_metres(trial* t) {
  return scale_positions(t, 0.01F);
}

static int mirror_positions(trial* t) {
  for (uint32_t v = 0; v < t->s->info.check_vertex_count; ++v) t->positions[3 * v + 2] *= -1;
  return 1;
}

/* As a left-handed engine has them: z changes its sign before and behind each transform. */
static int mirror_transforms(trial* t) {
  static const int changed[] = {2, 6, 8, 9, 14};
  for (uint32_t i = 0; i < t->pose.desc.transform_count; ++i)
    for (size_t k = 0; k < sizeof changed / sizeof changed[0]; ++k) transform_of(t, i)[changed[k]] *= -1;
  return 1;
}

static int leave_out_place(trial* t) {
  t->pose.desc.place_3x4 = NULL;
  return t->place != no_place;
}

static int leave_out_place_of_positions(trial* t) {
  if (t->place == no_place) return 0;
  t->place = NULL;
  return 1;
}

static int give_other_place(trial* t) {
  t->pose.desc.place_3x4 = t->place == tilted_place ? far_place : tilted_place;
  return 1;
}

/* Gives the first twelve floats of a matrix of columns instead of three rows. */
static int give_place_as_columns(trial* t) {
  float columns[16] = {0};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) columns[4 * column + row] = t->place[4 * row + column];
  columns[15] = 1;
  memcpy(t->own_place, columns, sizeof t->own_place);
  t->pose.desc.place_3x4 = t->own_place;
  return t->place != no_place;
}

static int transpose_rotation_of_place(trial* t) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      t->own_place[4 * row + column] = column < 3 ? t->place[4 * column + row] : t->place[4 * row + 3];
  t->pose.desc.place_3x4 = t->own_place;
  return t->place != no_place;
}

static int give_other_frame(trial* t) {
  const uint32_t other = (t->frame + 1) % t->s->engine.frame_count;
  stranger_free_pose(&t->pose);
  t->pose = t->is_joints ? stranger_joint_pose(t->s, other, NULL)
                         : stranger_skinning_pose(t->s, other, t->skin, NULL);
  t->pose.desc.flags = t->right.desc.flags;
  t->pose.desc.place_3x4 = t->right.desc.place_3x4;
  return t->s->engine.frame_count > 1;
}

/* Words of the text, separated by spaces: it must have all of them. */
static const struct mistake {
  const char* name;
  int (*make)(trial*);
  const char* words;
} mistakes[] = {
    {"transposed", transpose_transforms, "transposed"},
    {"rotations transposed", transpose_rotations, "rotations transposed"},
    {"columns as rows", read_columns_as_rows, "rows columns"},
    {"three rows as columns", read_three_rows_as_columns, "rows columns"},
    {"three columns as rows", read_three_columns_as_rows, "rows columns"},
    {"skinning as joints", skinning_as_joints, "skinning not joint"},
    {"joints as skinning", joints_as_skinning, "joint not skinning"},
    {"joints as rest-to-world", joints_as_rest, "joint not rest-to-world"},
    {"S left out", leave_out_s, "S^-1"},
    {"another skin", say_other_skin, "skin"},
    {"inverted", invert_transforms, "inverse"},
    {"bones one on", shift_forth, "wrong bones"},
    {"bones one back", shift_back, "wrong bones"},
    {"bones in centimetres", bones_in_centimetres, "translations unit 0.01"},
    {"bones in metres", bones_in_metres, "translations unit 100"},
    {"positions in centimetres", positions_in_centimetres, "unit vertices 100"},
    {"positions in metres", positions_in_metres, "unit vertices 0.01"},
    {"positions mirrored", mirror_positions, "mirror z"},
    {"transforms mirrored", mirror_transforms, "mirror z"},
    {"no place", leave_out_place, "place_3x4 missing"},
    {"no place of the positions", leave_out_place_of_positions, "place missing"},
    {"another place", give_other_place, "place vertices"},
    {"place as columns", give_place_as_columns, "place transposed"},
    {"rotation of the place transposed", transpose_rotation_of_place, "place transposed"},
    {"another frame", give_other_frame, "frame"},
};

static int has_words(const char* text, const char* words) {
  char word[64];
  while (*words) {
    const size_t length = strcspn(words, " ");
    memcpy(word, words, length);
    word[length] = 0;
    if (!strstr(text, word)) return 0;
    words += length + (words[length] == ' ');
  }
  return 1;
}

/* The check vertices by the model's matrices, each moved by its heaviest bone alone. Returns 0 where Nook
 * refuses the pose. */
static int moved_vertices(const trial* t, const nook_pose_desc* desc, float* out) {
  float* const bones = engine_memory(12 * sizeof *bones * t->s->info.bone_count);
  const int is_taken = nook_model_convert_pose(t->s->model, desc, bones, t->s->info.bone_count) == NOOK_OK;
  nook_check_vertex_info vertex;
  memset(&vertex, 0, sizeof vertex);
  vertex.struct_size = sizeof vertex;
  for (uint32_t v = 0; is_taken && v < t->s->info.check_vertex_count; ++v) {
    stranger_need(nook_model_describe_check_vertex(t->s->model, v, &vertex), "a check vertex");
    const float* const m = bones + 12 * (size_t)vertex.bone;
    for (int row = 0; row < 3; ++row)
      out[3 * v + (uint32_t)row] = m[4 * row] * vertex.position[0] + m[4 * row + 1] * vertex.position[1] +
                                   m[4 * row + 2] * vertex.position[2] + m[4 * row + 3];
  }
  free(bones);
  return is_taken;
}

/* True if the mistake moves a vertex by more than the check's tolerance. A change of the positions or of
 * their place always does. */
static int changes_anything(const trial* t, const float* right_place) {
  const size_t count = 3 * (size_t)t->s->info.check_vertex_count;
  float* const wrong = engine_memory(count * sizeof *wrong);
  float* const right = engine_memory(count * sizeof *right);
  const float tolerance = 0.02F * t->s->info.bounding_radius;
  int is_changed = t->place != right_place;
  const int is_taken = moved_vertices(t, &t->pose.desc, wrong);
  moved_vertices(t, &t->right.desc, right);
  for (size_t i = 0; i < count && is_taken; ++i) is_changed |= !(fabsf(wrong[i] - right[i]) <= tolerance);
  free(wrong);
  free(right);
  return is_taken && is_changed;
}

static void try_mistake(stranger* s, trial* t, const struct mistake* mistake) {
  const size_t size = 3 * sizeof(float) * s->info.check_vertex_count;
  const float* const place = t->place;
  float* const positions = t->positions;
  t->positions = engine_memory(size);
  memcpy(t->positions, positions, size);
  if (mistake->make(t) && (memcmp(t->positions, positions, size) != 0 || changes_anything(t, place))) {
    const nook_pose_check_info found = stranger_check(s, &t->pose.desc, t->positions, t->place);
    stranger_expect(s, found.fault != NOOK_POSE_FAULT_NONE && has_words(found.text, mistake->words),
                    "%s, frame %u, %s, %s: [%d] %s", mistake->name, (unsigned)t->frame,
                    t->is_joints ? "joint matrices" : "skinning matrices",
                    place == no_place ? "at home" : "far away", (int)found.fault, found.text);
  }
  free(t->positions);
  t->positions = positions;
  t->place = place;
}

/* All mistakes with the matrices of a skin, or with joint matrices where skin is the number of skins. */
static void try_all(stranger* s, uint32_t frame, uint32_t skin, float* positions) {
  const float* const used[] = {no_place, far_place};
  for (size_t m = 0; m < sizeof mistakes / sizeof mistakes[0]; ++m)
    for (size_t p = 0; p < sizeof used / sizeof used[0]; ++p) {
      trial t;
      memset(&t, 0, sizeof t);
      t.s = s;
      t.frame = frame;
      t.skin = skin;
      t.is_joints = skin == s->engine.skin_count;
      t.positions = positions;
      t.place = used[p];
      t.right = t.is_joints ? stranger_joint_pose(s, frame, t.place)
                            : stranger_skinning_pose(s, frame, skin, t.place);
      t.pose = t.is_joints ? stranger_joint_pose(s, frame, t.place)
                           : stranger_skinning_pose(s, frame, skin, t.place);
      t.right.desc.flags = t.pose.desc.flags = NOOK_POSE_FLAG_PARTIAL;
      try_mistake(s, &t, &mistakes[m]);
      stranger_free_pose(&t.pose);
      stranger_free_pose(&t.right);
    }
}

void stranger_run_mistakes(stranger* s) {
  nook_skin_info skin;
  memset(&skin, 0, sizeof skin);
  skin.struct_size = sizeof skin;
  for (uint32_t frame = 0; frame < s->engine.frame_count; ++frame) {
    float* const positions = stranger_check_positions(s, frame);
    if (!s->unnamed_bones) try_all(s, frame, s->engine.skin_count, positions);
    for (uint32_t k = 0; k < s->info.skin_count; ++k) {
      stranger_need(nook_model_describe_skin(s->model, k, &skin), "the skin");
      try_all(s, frame, skin.file_index, positions);
    }
    free(positions);
  }
}
