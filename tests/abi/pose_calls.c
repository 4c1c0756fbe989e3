/* Every function of the headers of poses and vertices, called from C in the order a host would; returns the
 * number of failed expectations and prints each. bytes: a character model with bind data. */
#include <nook/experimental/nook_lod.h>
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_call_every_pose_function(const void* bytes, size_t size);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("pose_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

enum { MAX_VERTICES = 64 };

/* The world is the rest space: every bone has the identity, and vertices stay where they are. */
static void check_rest_pose(nook_model model, const nook_pose_desc* desc) {
  float positions[3 * MAX_VERTICES];
  nook_pose_check_desc check;
  nook_pose_check_info fault;
  nook_check_vertex_info vertex;
  nook_model_info info;
  uint32_t v;
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_model_describe(model, &info));
  EXPECT(info.check_vertex_count >= 8 && info.check_vertex_count <= MAX_VERTICES);
  vertex.struct_size = sizeof vertex;
  for (v = 0; v < info.check_vertex_count && v < MAX_VERTICES; ++v) {
    EXPECT_OK(nook_model_describe_check_vertex(model, v, &vertex));
    memcpy(positions + 3 * v, vertex.position, sizeof vertex.position);
  }
  EXPECT_OK(nook_pose_check_desc_init(&check));
  check.vertex_count = info.check_vertex_count;
  check.positions = positions;
  memset(&fault, 0, sizeof fault);
  fault.struct_size = sizeof fault;
  EXPECT_OK(nook_model_check_pose(model, desc, &check, &fault));
  EXPECT(fault.fault == NOOK_POSE_FAULT_NONE);
  EXPECT(fault.text[0] != 0);
}

static void match_rest_vertices(nook_model model) {
  nook_check_vertex_info vertex;
  nook_vertex_match_desc match;
  nook_model remapped = NULL;
  uint32_t found = 0, unmatched = 9;
  vertex.struct_size = sizeof vertex;
  EXPECT_OK(nook_model_describe_check_vertex(model, 0, &vertex));
  EXPECT_OK(nook_vertex_match_desc_init(&match));
  match.vertex_count = 1;
  match.positions = vertex.mesh_position;
  EXPECT_OK(nook_model_match_vertices(model, &match, &found, &unmatched));
  EXPECT(unmatched == 0);
  EXPECT_OK(nook_model_remap(model, &found, 1, &remapped));
  nook_model_destroy(&remapped);
  EXPECT_OK(nook_model_resample(model, &match, &remapped));
  nook_model_destroy(&remapped);
}

int nook_call_every_pose_function(const void* bytes, size_t size) {
  nook_context_desc context_desc;
  nook_scene_desc scene_desc;
  nook_pose_desc desc;
  nook_context context = NULL;
  nook_model model = NULL;
  nook_scene scene = NULL;
  nook_model_info info;
  nook_skin_info skin;
  nook_bone_map_desc names;
  nook_instance_id instance = 0;
  const char** name;
  float* pose;
  int32_t* map;
  uint32_t i, unmatched = 9;
  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_model_load(context, bytes, size, &model));
  EXPECT_OK(nook_scene_desc_init(&scene_desc));
  EXPECT_OK(nook_scene_create(context, &scene_desc, &scene));
  EXPECT_OK(nook_scene_add_instance(scene, model, &instance));
  info.struct_size = sizeof info;
  EXPECT_OK(nook_model_describe(model, &info));

  name = (const char**)malloc(info.bone_count * sizeof *name);
  map = (int32_t*)malloc(info.bone_count * sizeof *map);
  pose = (float*)calloc(info.bone_count, 12 * sizeof *pose);
  for (i = 0; i < info.bone_count; ++i) {
    name[i] = nook_model_bone_name(model, i);
    pose[12 * i] = pose[12 * i + 5] = pose[12 * i + 10] = 1;
  }
  EXPECT_OK(nook_bone_map_desc_init(&names));
  names.names = name;
  names.name_count = info.bone_count;
  EXPECT_OK(nook_model_map_bones(model, &names, map, info.bone_count, &unmatched));
  EXPECT(unmatched == 0 && map[1] == 1);

  EXPECT_OK(nook_pose_desc_init(&desc));
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transforms = pose;
  desc.transform_count = info.bone_count;
  desc.transform_of_bone = map;
  desc.bone_count = info.bone_count;
  EXPECT_OK(nook_scene_set_pose(scene, instance, &desc));
  EXPECT_OK(nook_model_convert_pose(model, &desc, pose, info.bone_count));
  EXPECT(pose[0] == 1 && pose[1] == 0);
  check_rest_pose(model, &desc);
  match_rest_vertices(model);

  skin.struct_size = sizeof skin;
  EXPECT_OK(nook_model_describe_skin(model, 0, &skin));
  EXPECT(skin.joint_count > 0);

  free(pose);
  free(map);
  free((void*)name);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
  return failures;
}
