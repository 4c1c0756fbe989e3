/* Every function of nook_debug.h, called from C; returns the number of failed expectations and prints each.
 */
#include <nook/experimental/nook_debug.h>
#include <stdio.h>

int nook_debug_call_everything(nook_scene scene, nook_instance_id receiver, nook_instance_id caster);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("debug_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)

int nook_debug_call_everything(nook_scene scene, nook_instance_id receiver, nook_instance_id caster) {
  enum { kRoom = 64 };
  nook_scene_instance_info info = {0};
  nook_scene_sphere spheres[kRoom];
  nook_scene_key_point points[kRoom];
  nook_instance_id links[kRoom];
  uint32_t count = kRoom;
  failures = 0;
  info.struct_size = sizeof info;
  EXPECT(nook_scene_link(scene, receiver, caster) == NOOK_OK);
  EXPECT(nook_scene_update(scene) == NOOK_OK);
  EXPECT(nook_scene_describe_instance(scene, receiver, &info) == NOOK_OK);
  EXPECT(info.level == 0 && info.updated == 1 && info.bound_radius > 0);
  EXPECT(nook_scene_read_spheres(scene, receiver, spheres, &count) == NOOK_OK);
  EXPECT(count == info.sphere_count && spheres[0].radius > 0);
  count = kRoom;
  EXPECT(nook_scene_read_key_points(scene, receiver, points, &count) == NOOK_OK);
  EXPECT(count == info.key_point_count && points[count - 1].index == count - 1);
  count = kRoom;
  EXPECT(nook_scene_read_links(scene, receiver, links, &count) == NOOK_OK);
  EXPECT(count == 1 && links[0] == caster);
  return failures;
}
