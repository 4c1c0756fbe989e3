/* Right poses: their AO in each kind, layout and unit, and against ray tracing, and the check of all of them.
 */
#include <math.h>
#include <nook/experimental/nook_trace.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/stranger/stranger.h"

/* 3x4, row-major: at home, far away with a quarter turn, in other units, mirrored, z up. */
typedef struct named_place {
  const char* name;
  float matrix[12];
} named_place;

static const named_place places[] = {
    {"home", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
    {"the other end of the level", {0, 0, 1, 60, 0, 1, 0, 3, -1, 0, 0, -80}},
    {"centimetres", {100, 0, 0, 20, 0, 100, 0, 0, 0, 0, 100, -30}},
    {"millimetres", {1000, 0, 0, 0, 0, 1000, 0, 0, 0, 0, 1000, 0}},
    {"kilometres", {0.001F, 0, 0, 0, 0, 0.001F, 0, 0, 0, 0, 0.001F, 0}},
    {"mirrored", {-1, 0, 0, 0.2F, 0, 1, 0, 0, 0, 0, 1, 0}},
    {"z up", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}},
};
enum { place_count = sizeof places / sizeof places[0] };

static double rms_difference(const float* a, const float* b, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; ++i) sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
  return sqrt(sum / (double)count);
}

static float box_diagonal(const float* positions, size_t count) {
  float low[3], high[3], sum = 0;
  memcpy(low, positions, sizeof low);
  memcpy(high, positions, sizeof high);
  for (size_t v = 0; v < 3 * count; ++v) {
    low[v % 3] = fminf(low[v % 3], positions[v]);
    high[v % 3] = fmaxf(high[v % 3], positions[v]);
  }
  for (int i = 0; i < 3; ++i) sum += (high[i] - low[i]) * (high[i] - low[i]);
  return sqrtf(sum);
}

static void to_own_order(const stranger* s, const float* of_file, float* own) {
  for (size_t v = 0; v < s->engine.vertex_count; ++v) own[v] = of_file[s->order[v]];
}

/* Ray-traced AO of the engine's vertices among meshes; the first mesh is their own. */
static void trace(const stranger* s, const nook_bake_occluder_mesh* meshes, uint32_t mesh_count, float* ao) {
  const engine* const e = &s->engine;
  float* const normals = engine_memory(3 * sizeof *normals * e->vertex_count);
  float* const of_file = engine_memory(sizeof *of_file * e->vertex_count);
  nook_bake_trace_desc trace;
  engine_normals(e, meshes[0].positions, normals);
  if (nook_bake_trace_desc_init(&trace)) exit(1);
  trace.meshes = meshes;
  trace.mesh_count = mesh_count;
  trace.positions = meshes[0].positions;
  trace.normals = normals;
  trace.point_count = e->vertex_count;
  trace.rays = 256;
  trace.threads = 1;
  trace.origin_offset = 1e-4F * box_diagonal(meshes[0].positions, e->vertex_count);
  if (nook_bake_trace_ao(&trace, of_file, e->vertex_count)) {
    fprintf(stderr, "stranger: the trace: %s\n", nook_bake_last_message());
    exit(1);
  }
  to_own_order(s, of_file, ao);
  free(normals);
  free(of_file);
}

/* The body and, for `among`, one beside it, and the ground under both. */
enum { alone = 0, among = 1 };
static const float beside[12] = {1, 0, 0, 0.7F, 0, 1, 0, 0, 0, 0, 1, 0.1F};
static const float ground[4] = {0, 1, 0, -0.02F};

static void trace_frame(const stranger* s, uint32_t frame, int company, float* ao) {
  static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
  const engine* const e = &s->engine;
  const size_t count = 3 * (size_t)e->vertex_count;
  float* const positions = engine_memory(count * sizeof *positions);
  float* const moved = engine_memory(count * sizeof *moved);
  uint32_t* const indices = engine_memory(sizeof *indices * e->index_count);
  float floor_corners[12];
  nook_bake_occluder_mesh meshes[3];
  engine_skinned_vertices(e, frame, positions);
  engine_indices(e, indices);
  const float size = box_diagonal(positions, e->vertex_count), far = 500 * size;
  for (size_t i = 0; i < count; ++i) moved[i] = positions[i] + beside[4 * (i % 3) + 3] * s->unit;
  for (int c = 0; c < 4; ++c) {
    floor_corners[3 * c] = c == 1 || c == 2 ? far : -far;
    floor_corners[3 * c + 1] = ground[3] * s->unit;
    floor_corners[3 * c + 2] = c > 1 ? far : -far;
  }
  for (int m = 0; m < 2; ++m) {
    meshes[m].positions = m ? moved : positions;
    meshes[m].vertex_count = e->vertex_count;
    meshes[m].indices = indices;
    meshes[m].index_count = e->index_count;
  }
  meshes[2].positions = floor_corners;
  meshes[2].vertex_count = 4;
  meshes[2].indices = quad;
  meshes[2].index_count = 6;
  trace(s, meshes, company == among ? 3 : 1, ao);
  free(positions);
  free(moved);
  free(indices);
}

/* The mean squared error where the truth is not black. */
static double visible_error(const float* ao, const float* truth, size_t count) {
  double sum = 0;
  size_t visible = 0;
  for (size_t v = 0; v < count; ++v) {
    if (truth[v] < 0.01F) continue;
    ++visible;
    sum += ((double)ao[v] - (double)truth[v]) * ((double)ao[v] - (double)truth[v]);
  }
  return visible ? sum / (double)visible : 0;
}

/* Layouts give the same matrices. A step of a stored shadow is 1/8192 of the largest, which is below 4, and a
 * vertex may cross one where the last bit of a matrix differs; the root mean square stays far below. */
static void compare_layouts(stranger* s, uint32_t frame, const float* expected, float* ao) {
  static const nook_transform_layout layouts[] = {NOOK_TRANSFORM_ROWS_3X4, NOOK_TRANSFORM_ROWS_4X4,
                                                  NOOK_TRANSFORM_COLUMNS_4X4, NOOK_TRANSFORM_COLUMNS_4X3};
  const double bound = 5e-5;
  for (size_t l = 0; l < sizeof layouts / sizeof layouts[0]; ++l) {
    double rms;
    stranger_set_skinning_pose(s, s->hero, frame, layouts[l], NULL);
    stranger_read_ao(s, ao);
    rms = rms_difference(ao, expected, s->engine.vertex_count);
    stranger_expect(s, rms <= bound, "frame %u, skinning matrices in layout %d: AO differs by %g rms",
                    (unsigned)frame, (int)layouts[l], rms);
    if (s->unnamed_bones) continue;
    stranger_set_joint_pose(s, s->hero, frame, layouts[l], NULL);
    stranger_read_ao(s, ao);
    rms = rms_difference(ao, expected, s->engine.vertex_count);
    stranger_expect(s, rms <= bound, "frame %u, joint matrices in layout %d: AO differs by %g rms",
                    (unsigned)frame, (int)layouts[l], rms);
  }
}

/* AO does not depend on the place and its unit, by more than a tenth of a step of a byte. */
static void compare_places(stranger* s, uint32_t frame, const float* expected, float* ao) {
  const double bound = 5e-4;
  for (size_t p = 0; p < place_count; ++p) {
    stranger_set_skinning_pose(s, s->hero, frame, NOOK_TRANSFORM_COLUMNS_4X4, places[p].matrix);
    stranger_read_ao(s, ao);
    const double rms = rms_difference(ao, expected, s->engine.vertex_count);
    stranger_expect(s, rms <= bound, "frame %u, %s: AO differs by %g rms", (unsigned)frame, places[p].name,
                    rms);
  }
}

void stranger_run_layouts(stranger* s, const char* ao_path) {
  const size_t count = s->engine.vertex_count;
  float* const expected = engine_memory(count * sizeof *expected);
  float* const ao = engine_memory(count * sizeof *ao);
  FILE* const file = fopen(ao_path, "wb");
  int is_written = file != NULL;
  for (uint32_t frame = 0; frame < s->engine.frame_count; ++frame) {
    stranger_set_skinning_pose(s, s->hero, frame, NOOK_TRANSFORM_COLUMNS_4X4, NULL);
    stranger_read_ao(s, expected);
    compare_layouts(s, frame, expected, ao);
    compare_places(s, frame, expected, ao);
    for (size_t v = 0; v < count; ++v) ao[s->order[v]] = expected[v];
    is_written = is_written && fwrite(ao, sizeof *ao, count, file) == count;
  }
  if (file) is_written = fclose(file) == 0 && is_written;
  stranger_expect(s, is_written, "%s cannot be written", ao_path);
  free(expected);
  free(ao);
}

/* docs/guide/character.md, Ground, neighbours, spheres. Lengths are in the world's unit. */
static void add_company(stranger* s) {
  const float plane[4] = {ground[0], ground[1], ground[2], ground[3] * s->unit};
  stranger_need(nook_scene_add_instance(s->scene, s->model, &s->neighbour), "the neighbour");
  stranger_need(nook_scene_link(s->scene, s->hero, s->neighbour), "the link");
  stranger_need(nook_scene_set_ground(s->scene, s->hero, plane), "the ground");
}

static void remove_company(stranger* s) {
  stranger_need(nook_scene_set_ground(s->scene, s->hero, NULL), "the ground");
  stranger_need(nook_scene_remove_instance(s->scene, s->neighbour), "the neighbour");
  s->neighbour = 0;
}

/* The mean over the frames of the clip of the error of the model, alone or among others. */
static double error_of_model(stranger* s, int company) {
  const size_t count = s->engine.vertex_count;
  float* const truth = engine_memory(count * sizeof *truth);
  float* const ao = engine_memory(count * sizeof *ao);
  double sum = 0;
  float place[12];
  memcpy(place, beside, sizeof place);
  for (int row = 3; row < 12; row += 4) place[row] *= s->unit;
  if (company == among) add_company(s);
  for (uint32_t frame = 1; frame < s->engine.frame_count; ++frame) {
    stranger_set_skinning_pose(s, s->hero, frame, NOOK_TRANSFORM_COLUMNS_4X4, NULL);
    if (company == among)
      stranger_set_skinning_pose(s, s->neighbour, frame, NOOK_TRANSFORM_COLUMNS_4X4, place);
    stranger_read_ao(s, ao);
    trace_frame(s, frame, company, truth);
    sum += visible_error(ao, truth, count);
  }
  if (company == among) remove_company(s);
  free(truth);
  free(ao);
  return sum / (s->engine.frame_count - 1);
}

/* The same of AO that was baked at rest. */
static double error_of_static_bake(stranger* s) {
  const size_t count = s->engine.vertex_count;
  float* const at_rest = engine_memory(count * sizeof *at_rest);
  float* const truth = engine_memory(count * sizeof *truth);
  double sum = 0;
  trace_frame(s, 0, alone, at_rest);
  for (uint32_t frame = 1; frame < s->engine.frame_count; ++frame) {
    trace_frame(s, frame, alone, truth);
    sum += visible_error(at_rest, truth, count);
  }
  free(at_rest);
  free(truth);
  return sum / (s->engine.frame_count - 1);
}

void stranger_run_truth(stranger* s, float bound) {
  const double of_rest = error_of_static_bake(s), share = 0.75;
  const double of_body = error_of_model(s, alone), of_two = error_of_model(s, among);
  printf("mse_visible %.3e, beside another on the ground %.3e, of a static bake %.3e\n", of_body, of_two,
         of_rest);
  stranger_expect(s, of_body <= (double)bound && of_two <= (double)bound,
                  "the error against ray tracing is %g, and %g beside another on the ground, above %g",
                  of_body, of_two, (double)bound);
  stranger_expect(s, of_body <= share * of_rest, "the error %g is above %g of a static bake's, %g", of_body,
                  share, of_rest);
}

static void check_one(stranger* s, const nook_pose_desc* given, uint32_t frame, const char* kind,
                      const float* positions) {
  nook_pose_desc desc = *given;
  for (size_t p = 0; p < place_count; ++p) {
    desc.place_3x4 = places[p].matrix;
    const nook_pose_check_info found = stranger_check(s, &desc, positions, places[p].matrix);
    stranger_expect(s, found.fault == NOOK_POSE_FAULT_NONE, "false alarm: frame %u, %s, %s: %s",
                    (unsigned)frame, kind, places[p].name, found.text);
  }
}

void stranger_run_checks(stranger* s) {
  nook_skin_info skin;
  memset(&skin, 0, sizeof skin);
  skin.struct_size = sizeof skin;
  for (uint32_t frame = 0; frame < s->engine.frame_count; ++frame) {
    float* const positions = stranger_check_positions(s, frame);
    stranger_pose pose = stranger_joint_pose(s, frame, NULL);
    pose.desc.flags = s->unnamed_bones ? NOOK_POSE_FLAG_PARTIAL : 0;
    check_one(s, &pose.desc, frame, "joint matrices", positions);
    stranger_free_pose(&pose);
    for (uint32_t k = 0; k < s->info.skin_count; ++k) {
      stranger_need(nook_model_describe_skin(s->model, k, &skin), "the skin");
      pose = stranger_skinning_pose(s, frame, skin.file_index, NULL);
      pose.desc.flags = NOOK_POSE_FLAG_PARTIAL;
      check_one(s, &pose.desc, frame, "skinning matrices", positions);
      stranger_free_pose(&pose);
    }
    free(positions);
  }
}
