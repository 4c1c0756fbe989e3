/* The lines that the documents show. docs/include_snippets.py copies what stands between a name in brackets
 * and [end] into the pages; the stranger runs it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/stranger/stranger.h"

/* The engine's own skinning, in the engine's model space. */
static void skinned_position(const stranger* s, uint32_t frame, uint32_t vertex, float* position) {
  engine_skinned_vertex(&s->engine, frame, stranger_file_vertex(s, vertex), position);
}

static void document_pose(nook_scene scene, nook_instance_id instance, const float* skinning_matrices,
                          uint32_t joint_count, const float* model_to_world) {
  /* [pose] */
  nook_pose_desc desc;
  nook_pose_desc_init(&desc);
  desc.kind = NOOK_POSE_SKINNING;           /* G(j) B(j), in the order of the skin's joints */
  desc.skin = 0;                            /* the skin's index in the file */
  desc.layout = NOOK_TRANSFORM_COLUMNS_4X4; /* as OpenGL and glTF store matrices */
  desc.transforms = skinning_matrices;
  desc.transform_count = joint_count;
  desc.place_3x4 = model_to_world; /* NULL where the matrices lead to the world */
  nook_scene_set_pose(scene, instance, &desc);
  /* [end] */
}

static nook_pose_fault document_check(const stranger* s, uint32_t frame, nook_model model,
                                      nook_pose_desc desc, float* positions, const float* model_to_world) {
#define my_skinned_position(vertex, position) skinned_position(s, frame, vertex, position)
  /* [check] */
  /* for each check vertex: where does your own skinning put it? */
  nook_model_info info = {.struct_size = sizeof info};
  nook_model_describe(model, &info);
  nook_check_vertex_info vertex = {.struct_size = sizeof vertex};
  for (uint32_t v = 0; v < info.check_vertex_count; ++v) {
    nook_model_describe_check_vertex(model, v, &vertex);
    my_skinned_position(vertex.vertex, positions + 3 * v);
  }

  nook_pose_check_desc check;
  nook_pose_check_desc_init(&check);
  check.vertex_count = info.check_vertex_count;
  check.positions = positions;
  check.place_3x4 = model_to_world; /* NULL if positions are in the world; this also checks pose.place_3x4 */
  nook_pose_check_info found = {.struct_size = sizeof found};
  nook_model_check_pose(model, &desc, &check, &found);
  if (found.fault != NOOK_POSE_FAULT_NONE) puts(found.text);
    /* [end] */
#undef my_skinned_position
  return found.fault;
}

static nook_model document_match(nook_model model, const float* rest_positions, const float* rest_normals,
                                 const uint16_t* joints, const float* weights, uint32_t count,
                                 uint32_t* vertices) {
  nook_model mine = NULL;
  /* [match] */
  nook_vertex_match_desc match;
  nook_vertex_match_desc_init(&match);
  match.vertex_count = count;
  match.positions = rest_positions; /* as the engine has them, 16 bits will do */
  match.normals = rest_normals;     /* tell the two sides of a card apart */
  match.joints = joints;            /* four for each vertex, with their weights, */
  match.weights = weights;          /* tell meshes apart where they meet */
  nook_vertex_match_info matched = {.struct_size = sizeof matched};
  nook_model_match_vertices(model, &match, vertices, &matched);
  if (matched.ambiguous > 0) puts(matched.text);
  nook_model_remap(model, vertices, count, &mine);
  /* [end] */
  return mine;
}

static nook_instance_id document_scene(nook_context context, const void* bytes, size_t size,
                                       nook_model* model_out, nook_scene* scene_out) {
  nook_model model = NULL;
  nook_scene scene = NULL;
  nook_instance_id hero = 0;
  /* [scene] */
  nook_scene_desc scene_desc;
  nook_model_load(context, bytes, size, &model); /* bytes of hero.nook; free them afterwards */
  nook_scene_desc_init(&scene_desc);
  nook_scene_create(context, &scene_desc, &scene);
  nook_scene_add_instance(scene, model, &hero); /* once for each character of the scene */
  /* [end] */
  *model_out = model;
  *scene_out = scene;
  return hero;
}

static void document_frame(nook_scene scene, nook_instance_id hero, const float* skinning_matrices,
                           uint32_t joint_count, const float* model_to_world, float* ao,
                           uint32_t vertex_count) {
  /* [frame] */
  nook_pose_desc pose;
  nook_pose_desc_init(&pose);
  pose.kind = NOOK_POSE_SKINNING; /* or NOOK_POSE_JOINT_TO_WORLD */
  pose.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  pose.transforms = skinning_matrices;
  pose.transform_count = joint_count;
  pose.place_3x4 = model_to_world; /* where the character stands: three rows of four numbers */
  nook_scene_set_pose(scene, hero, &pose);
  nook_scene_update(scene);
  /* one float for each vertex, in the file's order */
  nook_scene_read(scene, hero, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, vertex_count, 0);
  /* [end] */
}

/* The file's AO in a frame by the lines of the documents, in the order of the engine's vertices. */
static void ao_by_documents(stranger* s, nook_scene scene, nook_instance_id hero, uint32_t frame, float* ao) {
  static const float home[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const uint32_t count = s->engine.vertex_count;
  stranger_pose matrices = stranger_skinning_pose(s, frame, 0, NULL);
  float* const of_file = engine_memory(count * sizeof *of_file);
  document_frame(scene, hero, matrices.transforms, matrices.desc.transform_count, home, of_file, count);
  for (uint32_t v = 0; v < count; ++v) ao[v] = of_file[s->order[v]];
  document_pose(s->scene, s->hero, matrices.transforms, matrices.desc.transform_count, NULL);
  free(of_file);
  stranger_free_pose(&matrices);
}

static void check_by_documents(stranger* s, uint32_t frame) {
  static const float place[12] = {0, 0, 1, 4, 0, 1, 0, 0, -1, 0, 0, 2};
  float* const positions = engine_memory(3 * sizeof *positions * s->info.check_vertex_count);
  stranger_pose matrices = stranger_skinning_pose(s, frame, 0, place);
  nook_pose_fault fault = document_check(s, frame, s->model, matrices.desc, positions, place);
  stranger_expect(s, fault == NOOK_POSE_FAULT_NONE, "frame %u: the check of docs/poses.md says %d",
                  (unsigned)frame, (int)fault);
  matrices.desc.place_3x4 = NULL;
  fault = document_check(s, frame, s->model, matrices.desc, positions, place);
  stranger_expect(s, fault == NOOK_POSE_FAULT_PLACE,
                  "frame %u: the check of docs/poses.md says %d without a place", (unsigned)frame,
                  (int)fault);
  stranger_free_pose(&matrices);
  free(positions);
}

/* The lines of the documents leave out what they return, so that their AO must equal the checked calls.
 */
void stranger_run_documents(stranger* s, const char* model_path) {
  const uint32_t count = s->engine.vertex_count;
  float* const ao = engine_memory(count * sizeof *ao);
  float* const expected = engine_memory(count * sizeof *expected);
  uint32_t* const vertices = engine_memory(count * sizeof *vertices);
  size_t size = 0;
  void* const bytes = engine_file(model_path, &size);
  nook_model model = NULL;
  nook_scene scene = NULL;
  const nook_instance_id hero = document_scene(s->context, bytes, size, &model, &scene);
  nook_model mine = document_match(model, s->engine.parts[0].positions, NULL, NULL, NULL,
                                   s->engine.parts[0].vertex_count, vertices);
  stranger_expect(s, mine != NULL, "the match of docs/poses.md gives no model");
  for (uint32_t frame = 0; frame < s->engine.frame_count; ++frame) {
    ao_by_documents(s, scene, hero, frame, ao);
    stranger_read_ao(s, expected);
    stranger_expect(s, memcmp(ao, expected, count * sizeof *ao) == 0,
                    "frame %u: the lines of the documents give other AO", (unsigned)frame);
    check_by_documents(s, frame);
  }
  nook_model_destroy(&mine);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  free(bytes);
  free(vertices);
  free(expected);
  free(ao);
}
