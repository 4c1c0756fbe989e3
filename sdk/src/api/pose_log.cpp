#include "sdk/src/api/pose_log.h"

#include <cstdio>

#include "sdk/src/character/gpu_pose.h"

namespace nook::api {
namespace {

void log_uneven(const Context& context, const char* subject, const CharacterModel& model,
                const PoseNotes& notes) {
  context.log(
      NOOK_LOG_WARNING,
      "%s: %u of %u bones are sheared or scale unevenly and are projected to the nearest rotation with one "
      "scale; the first is bone %u (\"%s\"). Its axes have the lengths %g %g %g, and the largest cosine "
      "between two axes is %g; %s",
      subject, notes.uneven, notes.bones, notes.first, model.bone_names[notes.first].c_str(),
      notes.axes.length(0), notes.axes.length(1), notes.axes.length(2), notes.axes.cosine(),
      notes.is_place_uneven
          ? "place_3x4 itself is sheared or scales unevenly; scale it equally in x, y and z"
          : "if you did not intend this, check desc.layout, because transposed matrices look like this");
}

void log_topics(const Context& context, const char* subject, const CharacterModel& model,
                const PoseNotes& notes, std::uint32_t topics) {
  if (topics & PoseNotes::topic_zero)
    context.log(NOOK_LOG_WARNING,
                "%s: all %u matrices of the pose are zero, so the body shrinks to nothing and has no "
                "shadows; fill the matrices before the call if you did not intend this",
                subject, notes.bones);
  if (topics & PoseNotes::topic_uneven) log_uneven(context, subject, model, notes);
  if (topics & PoseNotes::topic_surplus)
    context.log(NOOK_LOG_INFO,
                "%s: the pose has %u transforms, and only the first %u are used, because "
                "NOOK_POSE_FLAG_SURPLUS is set",
                subject, notes.transforms_given, notes.transforms_used);
}

}  // namespace

void log_pose(const Context& context, Instance& instance, const PoseNotes& notes) {
  const std::uint32_t fresh = notes.topics() & ~instance.input.reported;
  if (!fresh) return;
  instance.input.reported |= fresh;
  char subject[24];
  std::snprintf(subject, sizeof subject, "instance %u", instance.id);
  log_topics(context, subject, instance.model->model, notes, fresh);
}

void log_pose(const Context& context, const char* subject, const CharacterModel& model,
              const PoseNotes& notes, std::atomic<std::uint32_t>& reported) {
  const std::uint32_t topics = notes.topics();
  if (!topics) return;
  const std::uint32_t fresh = topics & ~reported.fetch_or(topics, std::memory_order_relaxed);
  if (fresh) log_topics(context, subject, model, notes, fresh);
}

void log_without_world_casters(const Context& context, Scene& scene) {
  if (scene.posed_on_gpu == 0) return;
  std::uint32_t fresh = 0;
  nook_instance_id first = 0;
  for (Instance& instance : scene.instances) {
    if (!instance.input.is_posed_on_gpu || (instance.input.reported & topic_no_world_casters)) continue;
    instance.input.reported |= topic_no_world_casters;
    if (fresh++ == 0) first = instance.id;
  }
  if (fresh)
    context.log(
        NOOK_LOG_WARNING,
        "nook_world_render: %u instances have poses on the GPU and do not darken the world; the first "
        "is instance %u; pass capsules for them in nook_world_frame_desc, or set their poses with "
        "nook_scene_set_pose",
        fresh, first);
}

}  // namespace nook::api
