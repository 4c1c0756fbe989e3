#include "sdk/src/api/pose_log.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>

#include "sdk/src/api/handles.h"
#include "sdk/src/character/body_check.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/scene_pool.h"

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

namespace {

const char* advice_of(GroundMistake mistake) {
  switch (mistake) {
    case GroundMistake::turned_normal:
      return "turn the normal, which must point out of the floor, to the side of the body";
    case GroundMistake::both_signs:
      return "change the signs of normal and offset, as the normal must point out of the floor";
    case GroundMistake::offset_sign:
      return "change the sign of the offset, which is dot(normal, p) of a point p on the floor";
    case GroundMistake::unit:
      return "give the offset, which is dot(normal, p) of a point p on the floor, in the unit of the poses";
    default:
      return "check its normal and height: the offset is dot(normal, p) of a point p on the floor, in the "
             "unit of the "
             "pose";
  }
}

void log_high(const Context& context, Instance& instance, const GroundFinding& finding) {
  instance.input.reported |= topic_ground;
  context.log(NOOK_LOG_WARNING,
              "instance %u: the body is %.3g above its ground, which is more than its own height, so the "
              "ground does not darken it (got the offset %g; the body stands on the plane with the offset "
              "%g); %s",
              instance.id, -double(finding.depth), double(instance.input.ground.offset),
              double(finding.offset), advice_of(finding.mistake));
}

// A body that came near its ground once has a right ground. Birds and climbers may never come near, so this
// is not a warning.
void log_floating(const Context& context, const Scene& scene, Instance& instance,
                  const GroundFinding& finding) {
  constexpr std::uint64_t updates = 600;
  if (instance.input.reported & topic_floats) return;
  if (finding.floats && scene.frame < instance.added_frame + updates) return;
  instance.input.reported |= topic_floats;
  if (!finding.floats) return;
  context.log(NOOK_LOG_INFO,
              "instance %u: since it was added, the body was never nearer to its ground than its own height, "
              "so the ground never darkened it (it is %.3g above the offset %g); if the body does not fly or "
              "climb, check the offset, which is dot(normal, p) of a point p on the floor, in the unit of "
              "the poses",
              instance.id, -double(finding.depth), double(instance.input.ground.offset));
}

void log_ground(const Context& context, const Scene& scene, Instance& instance) {
  if (!instance.input.has_ground || (instance.input.reported & topic_ground)) return;
  const GroundFinding finding = check_ground(instance);
  if (finding.is_wrong && finding.floats) return log_high(context, instance, finding);
  log_floating(context, scene, instance, finding);
  if (!finding.is_wrong) return;
  instance.input.reported |= topic_ground;
  const Plane& ground = instance.input.ground;
  context.log(
      NOOK_LOG_WARNING,
      "instance %u: about %.0f %% of the body is below its ground, up to %.3g deep (normal %g %g %g, offset "
      "%g), which darkens it; %s",
      instance.id, 100 * double(finding.share_below), double(finding.depth), double(ground.normal.x),
      double(ground.normal.y), double(ground.normal.z), double(ground.offset), advice_of(finding.mistake));
}

void log_size(const Context& context, Instance& instance) {
  if (instance.input.reported & topic_size) return;
  const float size = relative_size(instance);
  if (size <= max_relative_size) return;
  instance.input.reported |= topic_size;
  context.log(
      NOOK_LOG_WARNING,
      "instance %u: the bones lie far apart, as the posed body is %.3g times as large as its rest pose; "
      "check the unit of the translations, which are metres unless desc.place_3x4 scales, desc.kind and "
      "the order of the bones. nook_model_check_pose names the fault",
      instance.id, double(size));
}

void log_same_place(const Context& context, const Scene& scene, Instance& instance) {
  if (instance.input.reported & topic_same_place) return;
  const Instance* const other = caster_at_same_place(scene, instance);
  if (!other) return;
  instance.input.reported |= topic_same_place;
  context.log(
      NOOK_LOG_WARNING,
      "instance %u: instance %u is at the same place and darkens it; set desc.place_3x4 of each pose, "
      "and remove instances that you do not show",
      instance.id, other->id);
}

void log_occluder(const Context& context, const Scene& scene, Instance& instance) {
  if (instance.input.reported & topic_in_occluder) return;
  const Occluder* const around = occluder_around(scene, instance);
  if (!around) return;
  instance.input.reported |= topic_in_occluder;
  context.log(
      NOOK_LOG_WARNING,
      "instance %u: occluder %u contains the whole body, which makes the body black (got the radius "
      "%g of the occluder and %.3g of the body); give the occluder's centre and radius in the unit of "
      "the poses",
      instance.id, around->id, double(around->sphere.radius), double(instance.input.bound.radius));
}

// A host may call updates while it loads, before it poses a body. Until then, the body is at the origin, so
// warnings about its ground or about another body at the same place would be wrong.
bool is_loading(const Scene& scene, const Instance& instance) {
  constexpr std::uint64_t updates = 60;
  return !was_posed(instance) && scene.frame < instance.added_frame + updates;
}

void log_body(const Context& context, const Scene& scene, Instance& instance) {
  if (!instance.id || is_loading(scene, instance)) return;
  if (scene.terms & NOOK_TERM_GROUND) log_ground(context, scene, instance);
  if (scene.terms & NOOK_TERM_OCCLUDERS) log_occluder(context, scene, instance);
  if (scene.terms & NOOK_TERM_LINKS) log_same_place(context, scene, instance);
  log_size(context, instance);
}

// Calls links_nobody, which reads all instances, only if one body alone is too large for the distance.
void log_links(const Context& context, nook_scene_s& handle, const Instance& instance) {
  const Scene& scene = handle.scene;
  if (handle.links_reported || !instance.id || is_loading(scene, instance)) return;
  const float radius = instance.input.bound.radius;
  if (!(scene.nearest_max_distance < 0.5f * radius) || !links_nobody(scene)) return;
  handle.links_reported = true;
  context.log(NOOK_LOG_WARNING,
              "nook_scene_link_nearest: max_distance is so short that no body is ever linked (got %g, but "
              "instance %u has the radius %.3g); give the largest distance between the centres of two bodies "
              "in the unit of the poses, such as 3 in metres or 300 in centimetres",
              double(scene.nearest_max_distance), instance.id, double(radius));
}

// Sets a bit, and returns true if it was 0 before. It is atomic, because several threads may read the AO of
// one instance at the same time. The standard libraries of Emscripten and LLVM 16 have no std::atomic_ref.
bool set_once(std::uint32_t& bits, std::uint32_t bit) noexcept {
#if defined(__GNUC__)
  return (__atomic_fetch_or(&bits, bit, __ATOMIC_RELAXED) & bit) == 0;
#else
  return (std::atomic_ref(bits).fetch_or(bit, std::memory_order_relaxed) & bit) == 0;
#endif
}

}  // namespace

void log_bodies(nook_scene_s& handle) {
  constexpr std::size_t at_once = 16;
  const Context& context = *handle.context;
  Scene& scene = handle.scene;
  const std::size_t slots = scene.instances.size();
  if (slots == 0) return;
  const std::size_t first = scene.frame * at_once % slots;
  for (std::size_t i = 0; i < std::min(at_once, slots); ++i)
    log_body(context, scene, scene.instances[(first + i) % slots]);
  if (scene.terms & NOOK_TERM_LINKS) log_links(context, handle, scene.instances[first]);
}

void log_missing_update(const Context& context, Instance& instance) {
  if (instance.result.evaluated_frame > 0 || instance.input.clip.is_used()) return;
  if (!set_once(instance.input.reported, topic_no_update)) return;
  context.log(NOOK_LOG_WARNING,
              "instance %u: nook_scene_read gives AO 1, because nook_scene_update was not called since the "
              "instance was added or got another model; call it after you set poses. What "
              "nook_gl_scene_update computes is on the GPU; read it with nook_gl_scene_read",
              instance.id);
}

}  // namespace nook::api
