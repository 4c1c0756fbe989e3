// The C functions of nook_debug.h.
#include <nook/experimental/nook_debug.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/character/scene_readings.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

namespace {

template <class Body>
nook_result with_instance(const char* function, nook_scene scene, nook_instance_id instance,
                          Body&& body) noexcept {
  return api::enter(function, [&] {
    need(scene, "scene");
    body(scene->scene, instance_of(scene->scene, instance));
  });
}

// Writes the number of entries to *count. Returns true if the caller has also passed memory for the entries.
// Throws Failure if the memory is too small.
bool wants_entries(const void* out, std::uint32_t* count, std::uint32_t entries) {
  need(count, "count");
  const std::uint32_t room = *count;
  *count = entries;
  if (out && room < entries)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "*count is too small (got %u, need %u)", room, entries);
  return out != nullptr;
}

}  // namespace

nook_result nook_scene_describe_instance(nook_scene scene, nook_instance_id instance,
                                         nook_scene_instance_info* info) {
  return with_instance("nook_scene_describe_instance", scene, instance,
                       [&](const Scene& s, const Instance& i) { write_info(info, describe_instance(s, i)); });
}

nook_result nook_scene_read_spheres(nook_scene scene, nook_instance_id instance, nook_scene_sphere* out,
                                    uint32_t* count) {
  return with_instance("nook_scene_read_spheres", scene, instance, [&](const Scene&, Instance& i) {
    need_cpu_pose(i);
    decode_late_bones(i);
    if (wants_entries(out, count, sphere_count(i))) read_spheres(i, out);
  });
}

nook_result nook_scene_read_key_points(nook_scene scene, nook_instance_id instance, nook_scene_key_point* out,
                                       uint32_t* count) {
  return with_instance("nook_scene_read_key_points", scene, instance, [&](const Scene&, Instance& i) {
    need_cpu_pose(i);
    decode_late_bones(i);
    if (wants_entries(out, count, key_point_count(i))) read_key_points(i, out);
  });
}

nook_result nook_scene_read_links(nook_scene scene, nook_instance_id instance, nook_instance_id* out,
                                  uint32_t* count) {
  return with_instance("nook_scene_read_links", scene, instance, [&](const Scene& s, const Instance& i) {
    if (wants_entries(out, count, link_count(s, i))) read_links(s, i, out);
  });
}
