#include <nook/experimental/nook_calibration.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/pose_record.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/core/checks.h"

using namespace nook;

nook_result nook_scene_record_pose(nook_scene scene, nook_instance_id instance, void* bytes, size_t* size) {
  return api::enter("nook_scene_record_pose", [&] {
    need(scene, "scene");
    need(size, "size");
    Instance& recorded = instance_of(scene->scene, instance);
    need_cpu_pose(recorded);
    decode_late_bones(recorded);
    const std::size_t room = *size;
    *size = pose_record_size(recorded.bones().size());
    if (!bytes) return;
    if (room < *size)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "*size is too small (got %zu bytes, need %zu); call again with a larger buffer", room,
                    *size);
    write_pose_record(hash_of_bone_names(recorded.model->model.bone_names),
                      {recorded.bones().data(), recorded.bones().size()},
                      {static_cast<std::byte*>(bytes), *size});
  });
}

nook_result nook_model_recipe(nook_model model, const char** json) {
  return api::enter("nook_model_recipe", [&] {
    need(json, "json");
    *json = nullptr;
    need(model, "model");
    *json = model->model.recipe.c_str();
  });
}
