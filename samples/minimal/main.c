/* The smallest program that uses Nook. Two characters stand side by side on the ground, and the CPU evaluates
 * their ambient occlusion.
 *
 *   minimal MODEL.nook
 *
 * An engine needs the three marked regions. The rest of this file reads a file, prints, and stands in for the
 * engine's own animation. minimal_gl.c does the same and leaves the result on the GPU. */
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Stands in for the engine's animation. Returns the matrices of its vertex shader, joint matrix * inverse
 * bind matrix, in columns of four. This character stands still in its rest pose, x_m to the side, so all of
 * its joints have the same matrix. The matrix is not the identity: like most files, this one has a rotation
 * and a scale above its skeleton. */
static float* skinning_matrices(const nook_skin_info* skin, float x_m) {
  float* const joints = calloc(skin->joint_count, 16 * sizeof(float));
  for (uint32_t j = 0; joints && j < skin->joint_count; ++j) {
    float* const columns = joints + (size_t)16 * j;
    for (uint32_t i = 0; i < 12; ++i) columns[4 * (i % 4) + i / 4] = skin->rest_from_mesh_3x4[i];
    columns[12] += x_m;
    columns[15] = 1;
  }
  return joints;
}

static void* read_file(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  void* bytes = NULL;
  long length;
  if (!file) return NULL;
  if (fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) > 0 && fseek(file, 0, SEEK_SET) == 0) {
    *size = (size_t)length;
    bytes = malloc(*size);
    if (bytes && fread(bytes, 1, *size, file) != *size) {
      free(bytes);
      bytes = NULL;
    }
  }
  fclose(file);
  return bytes;
}

static double mean(const float* values, uint32_t count) {
  double sum = 0;
  for (uint32_t i = 0; i < count; ++i) sum += values[i];
  return sum / count;
}

typedef struct Character {
  nook_context context;
  nook_model model;
  nook_scene scene;
  nook_pose_desc pose;
  nook_instance_id left, right;
} Character;

/* ---- 1. Once: load the model and put two instances into a scene ---- */
static nook_result start(Character* c, const void* bytes, size_t size) {
  const float ground[4] = {0, 1, 0, 0}; /* the plane y = 0 */
  nook_context_desc context_desc;
  nook_scene_desc scene_desc;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &c->context);
  if (!r) r = nook_model_load(c->context, bytes, size, &c->model);
  if (!r) r = nook_scene_desc_init(&scene_desc);
  if (!r) r = nook_scene_create(c->context, &scene_desc, &c->scene);
  if (!r) r = nook_scene_add_instance(c->scene, c->model, &c->left);
  if (!r) r = nook_scene_add_instance(c->scene, c->model, &c->right);
  if (!r) r = nook_scene_set_ground(c->scene, c->left, ground);
  if (!r) r = nook_scene_set_ground(c->scene, c->right, ground);
  /* These are two fixed links. For a crowd, nook_scene_link_nearest finds the neighbours. */
  if (!r) r = nook_scene_link(c->scene, c->left, c->right);
  if (!r) r = nook_scene_link(c->scene, c->right, c->left);
  if (!r) r = nook_pose_desc_init(&c->pose);
  /* Name the matrices that you have. These are for a vertex shader; docs/poses.md has the other kinds.
   */
  c->pose.kind = NOOK_POSE_SKINNING;
  c->pose.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  return r;
}

/* ---- 2. Each frame: hand over the poses, evaluate, read one value for each vertex ---- */
static nook_result frame(Character* c, const float* left_pose, const float* right_pose, uint32_t joint_count,
                         float* ao, uint32_t vertex_count) {
  nook_result r;
  c->pose.transform_count = joint_count;
  c->pose.transforms = left_pose;
  r = nook_scene_set_pose(c->scene, c->left, &c->pose);
  c->pose.transforms = right_pose;
  if (!r) r = nook_scene_set_pose(c->scene, c->right, &c->pose);
  if (!r) r = nook_scene_update(c->scene);
  if (!r) r = nook_scene_read(c->scene, c->left, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, vertex_count, 0);
  return r;
}

/* ---- 3. At the end, in any order ---- */
static void stop(Character* c) {
  nook_scene_destroy(&c->scene);
  nook_model_destroy(&c->model);
  nook_context_destroy(&c->context);
}

/* The other instance comes nearer from frame to frame, and the mean AO falls. */
static nook_result approach(Character* c) {
  static const float distances_m[] = {4.0F, 2.0F, 1.0F, 0.6F};
  nook_model_info info = {.struct_size = sizeof info};
  nook_skin_info skin = {.struct_size = sizeof skin};
  nook_result r = nook_model_describe(c->model, &info);
  if (!r) r = nook_model_describe_skin(c->model, 0, &skin);
  if (r) return r;
  printf("%u vertices, %u bones, %u spheres, %u key points\n", (unsigned)info.file_vertex_count,
         (unsigned)info.bone_count, (unsigned)info.sphere_count, (unsigned)info.key_point_count);
  float* const ao = malloc(info.file_vertex_count * sizeof *ao);
  float* const here = skinning_matrices(&skin, 0);
  for (size_t i = 0; !r && i < sizeof distances_m / sizeof *distances_m; ++i) {
    float* const there = skinning_matrices(&skin, distances_m[i]);
    if (!ao || !here || !there) {
      fputs("minimal: out of memory\n", stderr);
      exit(1);
    }
    r = frame(c, here, there, skin.joint_count, ao, info.file_vertex_count);
    if (!r)
      printf("neighbour at %.1f m: mean ambient occlusion %.4f (1 is open)\n", (double)distances_m[i],
             mean(ao, info.file_vertex_count));
    free(there);
  }
  free(here);
  free(ao);
  return r;
}

int main(int argc, char** argv) {
  Character character;
  size_t size = 0;
  void* bytes;
  nook_result result;
  memset(&character, 0, sizeof character);
  if (argc != 2) {
    fputs("usage: minimal MODEL.nook\n", stderr);
    return 2;
  }
  bytes = read_file(argv[1], &size);
  if (!bytes) {
    fprintf(stderr, "minimal: %s cannot be read; check the path\n", argv[1]);
    return 3;
  }
  result = start(&character, bytes, size);
  free(bytes); /* the model has its own copy */
  if (!result) result = approach(&character);
  if (result) fprintf(stderr, "%s (%s)\n", nook_last_message(), nook_result_name(result));
  stop(&character);
  return result ? 3 : 0;
}
