#include "sdk/src/api/pose_log.h"

#include <cstdio>

namespace nook::api {
namespace {

void log_uneven(const Context& context, const char* subject, const CharacterModel& model,
                const PoseNotes& notes) {
  context.log(
      NOOK_LOG_WARNING,
      "%s: %u of %u bones are sheared or scale unevenly and are projected to the nearest rotation with "
      "one scale; the first is bone %u (\"%s\"), whose axes have lengths %g %g %g and a largest cosine "
      "of %g; %s",
      subject, notes.uneven, notes.bones, notes.first, model.bone_names[notes.first].c_str(),
      notes.axes.length(0), notes.axes.length(1), notes.axes.length(2), notes.axes.cosine(),
      notes.is_place_uneven ? "place_3x4 itself is uneven, scale it equally in x, y and z"
                            : "check the layout if this is not meant, transposed matrices look like this");
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

}  // namespace nook::api
