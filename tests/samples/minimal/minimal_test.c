/* The program of samples/minimal/main.c with right and wrong matrices: matrices of another kind than
 * pose.kind says must show in what it prints, and the check of poses must name them.
 *
 *   minimal_test MODEL.nook */
#define main minimal_main
#include "samples/minimal/main.c"
#undef main

#include <math.h>

static int failures = 0;

static void expect(int holds, const char* what, double value) {
  if (holds) return;
  fprintf(stderr, "failed: %s (got %g)\n", what, value);
  ++failures;
}

/* Rest-to-world matrices of the rest pose, in the form of skinning_matrices. */
static float* rest_to_world(const nook_skin_info* skin, float x_m) {
  float* const out = calloc(skin->joint_count, 16 * sizeof(float));
  for (uint32_t j = 0; out && j < skin->joint_count; ++j) {
    for (uint32_t i = 0; i < 4; ++i) out[16 * j + 5 * i] = 1;
    out[16 * j + 12] = x_m;
  }
  return out;
}

typedef float* (*animation)(const nook_skin_info*, float);

/* The largest difference between the means that the README of the sample lists and the means of an animation.
 */
static double difference(Character* c, const nook_skin_info* skin, animation animate) {
  static const struct {
    float distance_m;
    double ao;
  } listed[] = {{4.0F, 0.4600}, {0.6F, 0.4028}};
  double largest = 0;
  nook_model_info info = {.struct_size = sizeof info};
  nook_model_describe(c->model, &info);
  float* const ao = malloc(info.file_vertex_count * sizeof *ao);
  float* const here = animate(skin, 0);
  for (size_t i = 0; i < sizeof listed / sizeof *listed; ++i) {
    float* const there = animate(skin, listed[i].distance_m);
    const nook_result r = frame(c, here, there, skin->joint_count, ao, info.file_vertex_count);
    expect(r == NOOK_OK, "a frame", r);
    largest = fmax(largest, fabs(mean(ao, info.file_vertex_count) - listed[i].ao));
    free(there);
  }
  free(here);
  free(ao);
  return largest;
}

/* Returns the answer of the check of poses for matrices of c->pose.kind, beside the vertices of the rest
 * pose. */
static nook_pose_fault fault_of(Character* c, const nook_skin_info* skin, animation animate) {
  float* const matrices = animate(skin, 0);
  float positions[64 * 3];
  nook_model_info info = {.struct_size = sizeof info};
  nook_check_vertex_info vertex = {.struct_size = sizeof vertex};
  nook_pose_check_info found = {.struct_size = sizeof found};
  nook_pose_check_desc check;
  nook_model_describe(c->model, &info);
  nook_pose_check_desc_init(&check);
  for (uint32_t v = 0; v < info.check_vertex_count; ++v) {
    nook_model_describe_check_vertex(c->model, v, &vertex);
    memcpy(positions + (size_t)3 * v, vertex.position, sizeof vertex.position);
  }
  check.positions = positions;
  check.vertex_count = info.check_vertex_count;
  c->pose.transforms = matrices;
  c->pose.transform_count = skin->joint_count;
  expect(nook_model_check_pose(c->model, &c->pose, &check, &found) == NOOK_OK, "nook_model_check_pose", 0);
  free(matrices);
  return found.fault;
}

int main(int argc, char** argv) {
  /* Instruction sets differ by up to 1.4e-3 in the AO of a vertex, and a mean by less; a wrong kind must be
   * seen without a second look. */
  const double rounding = 2e-3, visible = 0.03;
  Character c;
  size_t size = 0;
  nook_skin_info skin = {.struct_size = sizeof skin};
  void* const bytes = argc == 2 ? read_file(argv[1], &size) : NULL;
  double off;
  memset(&c, 0, sizeof c);
  if (!bytes || start(&c, bytes, size) || nook_model_describe_skin(c.model, 0, &skin)) return 2;
  free(bytes);

  expect(c.pose.kind == NOOK_POSE_SKINNING, "the sample passes skinning matrices", c.pose.kind);
  off = difference(&c, &skin, skinning_matrices);
  expect(off < rounding, "AO of skinning matrices", off);
  expect(fault_of(&c, &skin, skinning_matrices) == NOOK_POSE_FAULT_NONE, "the check passes", 0);
  off = difference(&c, &skin, rest_to_world);
  expect(off > visible, "AO of rest-to-world matrices that are called skinning matrices", off);
  expect(fault_of(&c, &skin, rest_to_world) != NOOK_POSE_FAULT_NONE, "the check finds them", 0);

  c.pose.kind = NOOK_POSE_REST_TO_WORLD;
  off = difference(&c, &skin, rest_to_world);
  expect(off < rounding, "AO of rest-to-world matrices", off);
  off = difference(&c, &skin, skinning_matrices);
  expect(off > visible, "AO of skinning matrices that are called rest-to-world", off);
  expect(fault_of(&c, &skin, skinning_matrices) == NOOK_POSE_FAULT_NO_BIND, "the check names the bind", 0);

  c.pose.kind = NOOK_POSE_JOINT_TO_WORLD;
  off = difference(&c, &skin, skinning_matrices);
  expect(off > visible, "AO of skinning matrices that are called joint matrices", off);
  expect(fault_of(&c, &skin, skinning_matrices) == NOOK_POSE_FAULT_KIND, "the check names the kind", 0);

  stop(&c);
  return failures ? 1 : 0;
}
