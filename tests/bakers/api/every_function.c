#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bakers/api/tube.h"

static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

void make_tube(tube* out) {
  uint32_t* index = out->indices;
  int r, s;
  for (r = 0; r < tube_rings; ++r)
    for (s = 0; s < tube_segments; ++s) {
      const int v = r * tube_segments + s;
      const float x = (float)r / (tube_rings - 1), angle = 6.2831853f * (float)s / tube_segments;
      float tip = (x - 0.4f) / 0.2f;
      tip = tip < 0 ? 0 : tip > 1 ? 1 : tip;
      out->positions[3 * v] = x;
      out->positions[3 * v + 1] = 0.1f * cosf(angle);
      out->positions[3 * v + 2] = 0.1f * sinf(angle);
      out->joints[2 * v] = 0;
      out->joints[2 * v + 1] = 1;
      out->weights[2 * v] = 1 - tip;
      out->weights[2 * v + 1] = tip;
    }
  for (r = 0; r + 1 < tube_rings; ++r)
    for (s = 0; s < tube_segments; ++s) {
      const uint32_t a = (uint32_t)(r * tube_segments + s),
                     b = (uint32_t)(r * tube_segments + (s + 1) % tube_segments);
      const uint32_t triangle[6] = {a, b, a + tube_segments, b, b + tube_segments, a + tube_segments};
      memcpy(index, triangle, sizeof triangle);
      index += 6;
    }
  out->parents[0] = -1;
  out->parents[1] = 0;
  memcpy(out->frames, identity, sizeof identity);
  memcpy(out->frames + 12, identity, sizeof identity);
  out->frames[12 + 3] = 0.5f;
  out->names[0] = "root";
  out->names[1] = "tip";
}

nook_bake_source_desc describe_tube(const tube* t) {
  nook_bake_source_desc desc;
  nook_bake_source_desc_init(&desc);
  desc.positions = t->positions;
  desc.indices = t->indices;
  desc.joints = t->joints;
  desc.weights = t->weights;
  desc.vertex_count = tube_vertices;
  desc.index_count = 3 * tube_triangles;
  desc.influences = 2;
  desc.bone_count = 2;
  desc.bone_names = t->names;
  desc.bone_parents = t->parents;
  desc.bone_frames_3x4 = t->frames;
  return desc;
}

static int32_t keep_going(void* user, const nook_bake_progress* progress) {
  ++*(int*)user;
  return progress->struct_size == sizeof *progress;
}

static int call_character_functions(nook_bake_character character) {
  static float poses[2 * 24 * 200], positions[3 * tube_vertices], normals[3 * tube_vertices];
  nook_bake_character_info info;
  uint32_t count = 0;
  float seconds = 0;
  int wrong = 0;
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  wrong += nook_bake_character_describe(character, &info) != NOOK_OK;
  wrong += strcmp(nook_bake_character_name(character, NOOK_BAKE_NAME_BONE, 1), "tip") != 0;
  wrong += nook_bake_character_name(character, NOOK_BAKE_NAME_CLIP, 0) != NULL;
  wrong += nook_bake_character_name(character, NOOK_BAKE_NAME_PRIMITIVE, 0) == NULL;
  wrong += nook_bake_character_name(character, NOOK_BAKE_NAME_WARNING, info.warning_count) != NULL;
  wrong += nook_bake_character_read(character, NOOK_BAKE_ARRAY_FRAMES, poses, 2, 0) != NOOK_OK;
  wrong += nook_bake_character_clip_duration(character, 0, &seconds) != NOOK_ERROR_INVALID_ARGUMENT;
  wrong += nook_bake_character_sample_clip(character, 0, 0, poses, 2) != NOOK_ERROR_INVALID_ARGUMENT;
  wrong += nook_bake_character_auto_poses(character, 1, 2, poses, 2) != NOOK_OK;
  wrong += nook_bake_character_single_joint_poses(character, 3, 45, &count, NULL, 2) != NOOK_OK;
  wrong += nook_bake_character_single_joint_poses(character, 3, 45, &count, poses, 2) != NOOK_OK;
  wrong += nook_bake_character_skin(character, poses, 2, positions, normals, tube_vertices) != NOOK_OK;
  return wrong;
}

static int call_job_functions(nook_bake_character character) {
  nook_bake_character_desc desc;
  nook_bake_job job = NULL;
  nook_bake_progress progress;
  const void* bytes = NULL;
  const char* report = NULL;
  size_t size = 0;
  int calls = 0, wrong = 0;
  wrong += nook_bake_character_desc_init(&desc) != NOOK_OK;
  desc.character = character;
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.pose_mode = NOOK_BAKE_POSES_AUTO;
  desc.auto_pose_count = 8;
  desc.spheres = 6;
  desc.key_points = 20;
  desc.rays = 4;
  desc.steps = 20;
  desc.progress = keep_going;
  desc.progress_user = &calls;
  wrong += nook_bake_start_character(&desc, &job) != NOOK_OK;
  memset(&progress, 0, sizeof progress);
  progress.struct_size = sizeof progress;
  wrong += nook_bake_job_poll(job, &progress) != NOOK_OK;
  wrong += nook_bake_job_wait(job) != NOOK_OK;
  wrong += nook_bake_job_file(job, &bytes, &size) != NOOK_OK || size < 100;
  wrong += nook_bake_job_report(job, &report) != NOOK_OK || report == NULL;
  wrong += nook_bake_job_cancel(job) != NOOK_OK;
  nook_bake_job_destroy(&job);
  wrong += job != NULL || calls == 0;
  return wrong;
}

static int call_trace_functions(const tube* t) {
  nook_bake_trace_desc desc;
  nook_bake_occluder_mesh mesh;
  const float normal[3] = {0, 1, 0}, point[3] = {0.5f, 0, 0};
  float ao = -1;
  int wrong = nook_bake_trace_desc_init(&desc) != NOOK_OK;
  mesh.positions = t->positions;
  mesh.indices = t->indices;
  mesh.vertex_count = tube_vertices;
  mesh.index_count = 3 * tube_triangles;
  desc.meshes = &mesh;
  desc.mesh_count = 1;
  desc.positions = point;
  desc.normals = normal;
  desc.point_count = 1;
  wrong += nook_bake_trace_ao(&desc, &ao, 1) != NOOK_OK;
  /* On the axis of the tube only the open ends are seen. */
  wrong += !(ao >= 0 && ao < 0.2f);
  return wrong;
}

static int call_irradiance_functions(const tube* t) {
  nook_bake_irradiance_desc desc;
  nook_bake_lit_mesh mesh = {0};
  const float normal[3] = {0, 1, 0}, point[3] = {0.5f, 0, 0}, white[3] = {1, 1, 1};
  float irradiance[3] = {-1, -1, -1};
  int wrong = nook_bake_irradiance_desc_init(&desc) != NOOK_OK;
  mesh.positions = t->positions;
  mesh.indices = t->indices;
  mesh.vertex_count = tube_vertices;
  mesh.index_count = 3 * tube_triangles;
  desc.meshes = &mesh;
  desc.mesh_count = 1;
  desc.positions = point;
  desc.normals = normal;
  desc.point_count = 1;
  desc.environment.rgb = white;
  desc.environment.width = desc.environment.height = 1;
  wrong += nook_bake_trace_irradiance(&desc, irradiance, 1) != NOOK_OK;
  /* As the AO of the same point, times pi. */
  wrong += !(irradiance[0] >= 0 && irradiance[2] < 0.2f * 3.15f);
  return wrong;
}

static int call_material_functions(void) {
  nook_bake_material_desc desc;
  nook_bake_job job = NULL;
  const void* bytes = NULL;
  size_t size = 0;
  int calls = 0, wrong = nook_bake_material_desc_init(&desc) != NOOK_OK;
  desc.meso = "weave";
  desc.light_count = desc.view_count = 8;
  desc.width = desc.height = 8;
  desc.bounces = 0;
  desc.view_map_side = 8;
  desc.progress = keep_going;
  desc.progress_user = &calls;
  wrong += nook_bake_start_material(&desc, &job) != NOOK_OK;
  wrong += nook_bake_job_wait(job) != NOOK_OK;
  wrong += nook_bake_job_file(job, &bytes, &size) != NOOK_OK || size < 100;
  nook_bake_job_destroy(&job);
  return wrong + (job != NULL || calls == 0);
}

static int call_transfer_functions(void) {
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  const float uvs[6] = {0, 0, 1, 0, 0, 1};
  const uint32_t indices[3] = {0, 1, 2};
  nook_bake_transfer_desc desc;
  nook_bake_job job = NULL;
  const void* bytes = NULL;
  size_t size = 0;
  int calls = 0, wrong = nook_bake_transfer_desc_init(&desc) != NOOK_OK;
  desc.positions = positions;
  desc.normals = normals;
  desc.uvs = uvs;
  desc.indices = indices;
  desc.vertex_count = desc.index_count = 3;
  desc.lobes = 12;
  desc.ray_side = 8;
  desc.progress = keep_going;
  desc.progress_user = &calls;
  wrong += nook_bake_start_transfer(&desc, &job) != NOOK_OK;
  wrong += nook_bake_job_wait(job) != NOOK_OK;
  wrong += nook_bake_job_file(job, &bytes, &size) != NOOK_OK || size < 100;
  nook_bake_job_destroy(&job);
  return wrong + (job != NULL || calls == 0);
}

/* Bytes that are no material are refused before a job starts. */
static int call_synthesis_functions(void) {
  static const char bytes[40] = {0};
  nook_bake_synthesis_desc desc;
  nook_bake_job job = NULL;
  int wrong = nook_bake_synthesis_desc_init(&desc) != NOOK_OK;
  desc.material = bytes;
  desc.material_size = sizeof bytes;
  wrong += nook_bake_start_synthesis(&desc, &job) != NOOK_ERROR_BAD_FILE;
  return wrong + (job != NULL);
}

/* The same holds for clips and bent normals. */
static int call_clips_functions(nook_bake_character character) {
  static const char bytes[40] = {0};
  nook_bake_clips_desc desc;
  nook_bake_job job = NULL;
  int wrong = nook_bake_clips_desc_init(&desc) != NOOK_OK;
  desc.character = character;
  desc.model = bytes;
  desc.model_size = sizeof bytes;
  wrong += nook_bake_start_clips(&desc, &job) != NOOK_ERROR_BAD_FILE;
  return wrong + (job != NULL);
}

static int call_bent_functions(nook_bake_character character) {
  static const char bytes[40] = {0};
  nook_bake_bent_desc desc;
  nook_bake_job job = NULL;
  int wrong = nook_bake_bent_desc_init(&desc) != NOOK_OK;
  desc.character = character;
  desc.model = bytes;
  desc.model_size = sizeof bytes;
  wrong += nook_bake_start_bent(&desc, &job) != NOOK_ERROR_BAD_FILE;
  return wrong + (job != NULL);
}

int call_every_function(void) {
  tube t;
  nook_bake_source_desc desc;
  nook_bake_character character = NULL;
  int wrong = 0;
  make_tube(&t);
  wrong += nook_bake_source_desc_init(&desc) != NOOK_OK;
  desc.path = "no such file.glb";
  wrong += nook_bake_character_create(&desc, &character) != NOOK_ERROR_BAD_FILE;
  wrong += strstr(nook_bake_last_message(), "no such file.glb") == NULL;
  desc.path = NULL;
  desc.bytes = "";
  wrong += nook_bake_character_create(&desc, &character) != NOOK_ERROR_BAD_FILE;
  desc = describe_tube(&t);
  wrong += nook_bake_character_create(&desc, &character) != NOOK_OK;
  wrong += call_character_functions(character);
  wrong += call_job_functions(character);
  wrong += call_clips_functions(character);
  wrong += call_bent_functions(character);
  wrong += call_trace_functions(&t);
  wrong += call_irradiance_functions(&t);
  wrong += call_material_functions();
  wrong += call_transfer_functions();
  wrong += call_synthesis_functions();
  nook_bake_character_destroy(&character);
  return wrong + (character != NULL);
}
