/* Every function of nook_world.h, called from C; returns the number of failed expectations and prints each.
 */
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_world.h>
#include <stdio.h>

int nook_world_call_everything(nook_model model, nook_scene scene);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("world_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)

int nook_world_call_everything(nook_model model, nook_scene scene) {
  nook_model_capsule casters[NOOK_WORLD_MAX_CASTERS];
  uint32_t count = NOOK_WORLD_MAX_CASTERS;
  nook_world_sample_desc desc;
  const float position[3] = {0, -1, 0}, normal[3] = {0, 1, 0};
  float ao = -1, light = -1, rgb[3] = {-1, -1, -1};
  const nook_lobe lobe = {{0, 1, 0}, 2, {1, 1, 1}, 0};
  failures = 0;
  EXPECT(nook_model_read_capsules(model, casters, &count) == NOOK_OK);
  EXPECT(count > 0 && casters[0].ao_scale > 0);
  EXPECT(nook_world_sample_desc_init(&desc) == NOOK_OK);
  desc.positions = position;
  desc.normals = normal;
  desc.point_count = 1;
  desc.light_axis[1] = 1;
  desc.light_degrees = 20;
  desc.lobes = &lobe;
  desc.lobe_count = 1;
  desc.directional_ao = rgb;
  EXPECT(nook_world_sample(scene, &desc, &ao, &light) == NOOK_OK);
  EXPECT(ao > 0 && ao < 1 && light >= 0 && light <= 1);
  EXPECT(rgb[0] > 0 && rgb[0] < 1);
  return failures;
}
