#include "tests/stranger/stranger.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void stranger_expect(stranger* s, int ok, const char* format, ...) {
  enum { most_lines = 20 };
  va_list arguments;
  if (ok || ++s->failures > most_lines) return;
  fputs("FAILED: ", stdout);
  va_start(arguments, format);
  vfprintf(stdout, format, arguments);
  va_end(arguments);
  fputc('\n', stdout);
}

void stranger_need(nook_result result, const char* what) {
  if (result == NOOK_OK) return;
  fprintf(stderr, "stranger: %s: %s (%s)\n", what, nook_last_message(), nook_result_name(result));
  exit(1);
}

/* docs/guide/character.md: load a model, make a scene. */
static void load_model(stranger* s, const char* path) {
  nook_context_desc context_desc;
  size_t size = 0;
  void* const bytes = engine_file(path, &size);
  if (!bytes) {
    fprintf(stderr, "stranger: %s cannot be read\n", path);
    exit(1);
  }
  stranger_need(nook_context_desc_init(&context_desc), "the context");
  stranger_need(nook_context_create(&context_desc, &s->context), "the context");
  stranger_need(nook_model_load(s->context, bytes, size, &s->model), "the model");
  free(bytes);
}

/* docs/poses.md, Vertices: the engine keeps the vertices of each primitive in an order of its own, here
 * backwards. */
static void match_vertices(stranger* s) {
  const engine* const e = &s->engine;
  nook_model mine = NULL;
  s->order = engine_memory(e->vertex_count * sizeof *s->order);
  for (uint32_t p = 0; p < e->part_count; ++p) {
    const engine_part* const part = &e->parts[p];
    nook_vertex_match_desc match;
    nook_vertex_match_info info = {.struct_size = sizeof info};
    float* const backwards = engine_memory(3 * sizeof *backwards * part->vertex_count);
    for (size_t v = 0; v < part->vertex_count; ++v)
      memcpy(backwards + 3 * v, part->positions + 3 * (part->vertex_count - 1 - v), 3 * sizeof *backwards);
    stranger_need(nook_vertex_match_desc_init(&match), "the match");
    match.vertex_count = part->vertex_count;
    match.positions = backwards;
    match.primitive = (int32_t)p;
    stranger_need(nook_model_match_vertices(s->model, &match, s->order + part->first_vertex, &info),
                  "the match");
    stranger_expect(s, info.unmatched == 0, "%u of %u vertices of primitive %u have no vertex of the model",
                    (unsigned)info.unmatched, (unsigned)part->vertex_count, (unsigned)p);
    free(backwards);
  }
  if (s->failures) return;
  stranger_need(nook_model_remap(s->model, s->order, e->vertex_count, &mine),
                "the model in the engine's order");
  nook_model_destroy(&s->model);
  s->model = mine;
}

uint32_t stranger_file_vertex(const stranger* s, uint32_t own) {
  const engine* const e = &s->engine;
  for (uint32_t p = 0; p < e->part_count; ++p)
    if (own - e->parts[p].first_vertex < e->parts[p].vertex_count)
      return e->parts[p].first_vertex + e->parts[p].vertex_count - 1 - (own - e->parts[p].first_vertex);
  return own;
}

/* docs/poses.md, Other orders: the node of each bone, by name. */
static void map_bones(stranger* s) {
  nook_bone_map_desc map;
  stranger_need(nook_bone_map_desc_init(&map), "the map of bones");
  map.names = (const char* const*)s->engine.names;
  map.name_count = s->engine.node_count;
  s->transform_of_bone = engine_memory(s->info.bone_count * sizeof *s->transform_of_bone);
  stranger_need(
      nook_model_map_bones(s->model, &map, s->transform_of_bone, s->info.bone_count, &s->unnamed_bones),
      "the map of bones");
}

int stranger_start(stranger* s, const char* model_path, const char* engine_path) {
  nook_scene_desc scene_desc;
  memset(s, 0, sizeof *s);
  s->unit = 1;
  if (!engine_read(&s->engine, engine_path)) return 0;
  load_model(s, model_path);
  match_vertices(s);
  if (s->failures) return 0;
  s->info.struct_size = sizeof s->info;
  stranger_need(nook_model_describe(s->model, &s->info), "the model");
  map_bones(s);
  stranger_need(nook_scene_desc_init(&scene_desc), "the scene");
  stranger_need(nook_scene_create(s->context, &scene_desc, &s->scene), "the scene");
  stranger_need(nook_scene_add_instance(s->scene, s->model, &s->hero), "the hero");
  return 1;
}

void stranger_stop(stranger* s) {
  nook_scene_destroy(&s->scene);
  nook_model_destroy(&s->model);
  nook_context_destroy(&s->context);
  engine_free(&s->engine);
  free(s->order);
  free(s->transform_of_bone);
}

/* docs/poses.md: the matrices that the engine has, and their kind. */
stranger_pose stranger_skinning_pose(const stranger* s, uint32_t frame, uint32_t skin, const float* place) {
  const uint32_t joint_count = s->engine.skins[skin].joint_count;
  stranger_pose out;
  out.transforms = engine_memory(16 * sizeof *out.transforms * joint_count);
  engine_skinning_matrices(&s->engine, frame, skin, out.transforms);
  stranger_need(nook_pose_desc_init(&out.desc), "the pose");
  out.desc.kind = NOOK_POSE_SKINNING;
  out.desc.skin = skin;
  out.desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  out.desc.transforms = out.transforms;
  out.desc.transform_count = joint_count;
  out.desc.place_3x4 = place;
  return out;
}

stranger_pose stranger_joint_pose(const stranger* s, uint32_t frame, const float* place) {
  const size_t size = 16 * sizeof(float) * s->engine.node_count;
  stranger_pose out;
  out.transforms = engine_memory(size);
  memcpy(out.transforms, engine_world(&s->engine, frame, 0), size);
  stranger_need(nook_pose_desc_init(&out.desc), "the pose");
  out.desc.kind = NOOK_POSE_JOINT_TO_WORLD;
  out.desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  out.desc.transforms = out.transforms;
  out.desc.transform_count = s->engine.node_count;
  out.desc.transform_of_bone = s->transform_of_bone;
  out.desc.bone_count = s->info.bone_count;
  out.desc.place_3x4 = place;
  return out;
}

static size_t floats_of(nook_transform_layout layout) {
  return layout == NOOK_TRANSFORM_ROWS_3X4 || layout == NOOK_TRANSFORM_COLUMNS_4X3 ? 12 : 16;
}

void stranger_change_layout(stranger_pose* pose, nook_transform_layout layout) {
  const size_t count = pose->desc.transform_count, floats = floats_of(layout);
  float* const out = engine_memory(floats * sizeof *out * count);
  for (size_t t = 0; t < count; ++t) {
    const float* const from = pose->transforms + 16 * t;
    float* const to = out + floats * t;
    if (layout == NOOK_TRANSFORM_ROWS_3X4) matrix_rows(from, to);
    if (layout == NOOK_TRANSFORM_ROWS_4X4) matrix_transpose(from, to);
    if (layout == NOOK_TRANSFORM_COLUMNS_4X4) memcpy(to, from, 16 * sizeof *to);
    for (size_t column = 0; column < 4 && layout == NOOK_TRANSFORM_COLUMNS_4X3; ++column)
      memcpy(to + 3 * column, from + 4 * column, 3 * sizeof *to);
  }
  free(pose->transforms);
  pose->transforms = out;
  pose->desc.transforms = out;
  pose->desc.layout = layout;
}

void stranger_free_pose(stranger_pose* pose) {
  free(pose->transforms);
  memset(pose, 0, sizeof *pose);
}

/* True if the joints of skin 0 are all bones. */
static int is_one_skin(const stranger* s) {
  nook_skin_info skin;
  memset(&skin, 0, sizeof skin);
  skin.struct_size = sizeof skin;
  if (s->info.skin_count != 1) return 0;
  stranger_need(nook_model_describe_skin(s->model, 0, &skin), "the skin");
  return skin.joint_count == s->info.bone_count && skin.file_index == 0;
}

void stranger_set_joint_pose(stranger* s, nook_instance_id instance, uint32_t frame,
                             nook_transform_layout layout, const float* place) {
  stranger_pose pose = stranger_joint_pose(s, frame, place);
  stranger_change_layout(&pose, layout);
  stranger_need(nook_scene_set_pose(s->scene, instance, &pose.desc), "the pose of joints");
  stranger_free_pose(&pose);
}

/* docs/poses.md, Several skins, rigid parts. */
void stranger_set_skinning_pose(stranger* s, nook_instance_id instance, uint32_t frame,
                                nook_transform_layout layout, const float* place) {
  nook_skin_info skin;
  memset(&skin, 0, sizeof skin);
  skin.struct_size = sizeof skin;
  if (!is_one_skin(s)) stranger_set_joint_pose(s, instance, frame, layout, place);
  for (uint32_t k = 0; k < s->info.skin_count; ++k) {
    stranger_need(nook_model_describe_skin(s->model, k, &skin), "the skin");
    stranger_pose pose = stranger_skinning_pose(s, frame, skin.file_index, place);
    if (!is_one_skin(s)) pose.desc.flags = NOOK_POSE_FLAG_PARTIAL;
    stranger_change_layout(&pose, layout);
    stranger_need(nook_scene_set_pose(s->scene, instance, &pose.desc), "the pose of a skin");
    stranger_free_pose(&pose);
  }
}

void stranger_read_ao(stranger* s, float* ao) {
  stranger_need(nook_scene_update(s->scene), "the update");
  stranger_need(
      nook_scene_read(s->scene, s->hero, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, s->engine.vertex_count, 0),
      "the AO");
}

/* docs/poses.md, The check. */
float* stranger_check_positions(const stranger* s, uint32_t frame) {
  float* const positions = engine_memory(3 * sizeof *positions * s->info.check_vertex_count);
  nook_check_vertex_info vertex;
  memset(&vertex, 0, sizeof vertex);
  vertex.struct_size = sizeof vertex;
  for (uint32_t v = 0; v < s->info.check_vertex_count; ++v) {
    stranger_need(nook_model_describe_check_vertex(s->model, v, &vertex), "a check vertex");
    engine_skinned_vertex(&s->engine, frame, stranger_file_vertex(s, vertex.vertex),
                          positions + 3 * (size_t)v);
  }
  return positions;
}

nook_pose_check_info stranger_check(const stranger* s, const nook_pose_desc* pose, const float* positions,
                                    const float* place) {
  nook_pose_check_desc check;
  nook_pose_check_info found;
  stranger_need(nook_pose_check_desc_init(&check), "the check");
  check.vertex_count = s->info.check_vertex_count;
  check.positions = positions;
  check.place_3x4 = place;
  memset(&found, 0, sizeof found);
  found.struct_size = sizeof found;
  stranger_need(nook_model_check_pose(s->model, pose, &check, &found), "the check");
  return found;
}
