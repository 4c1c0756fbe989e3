#include "sdk/src/api/gl/world_log.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/api/world_casting.h"

namespace nook::api {
namespace {

bool is_identity(const float (&m)[16]) {
  for (int i = 0; i < 16; ++i)
    if (m[i] != (i % 5 == 0 ? 1.0f : 0.0f)) return false;
  return true;
}

Vec3 translation_of(const float (&m)[16]) {
  return {m[12], m[13], m[14]};
}

// Returns the position of the camera in world space.
Vec3 eye_of(const float (&m)[16]) {
  const Vec3 t = translation_of(m);
  return {-dot({m[0], m[1], m[2]}, t), -dot({m[4], m[5], m[6]}, t), -dot({m[8], m[9], m[10]}, t)};
}

bool is_near(Vec3 a, Vec3 b) {
  return length(a - b) <= 1e-3f * length(b);
}

// Two cameras that look at one scene have different positions, so another position alone is not a mistake.
// Only mistakes that explain the given position are named. Null: none.
const char* view_mistake(const float (&view)[16], Vec3 camera) {
  const Vec3 eye = eye_of(view);
  if (is_near(eye, camera)) return nullptr;
  if (is_identity(view)) return "it is the identity";
  if (is_near(translation_of(view), camera)) return "it is the matrix from view space to world space";
  const float ratio = dot(eye, camera) / dot(camera, camera);
  const bool is_other_unit = std::abs(ratio - 100) < 1 || std::abs(100 * ratio - 1) < 0.01f;
  if (is_other_unit && is_near(eye, ratio * camera)) return "it has another unit";
  return nullptr;
}

void log_view(const Context& context, WorldReports& reports, const float (&view)[16], const Scene* scene) {
  if (reports.view || !scene || !scene->has_camera) return;
  const Vec3 camera = scene->camera;
  // A camera within a centimetre of the origin tells nothing.
  if (!(length(camera) > 0.01f * context.units_per_metre())) return;
  const char* const mistake = view_mistake(view, camera);
  if (!mistake) return;
  reports.view = true;
  const Vec3 eye = eye_of(view);
  context.log(NOOK_LOG_WARNING,
              "nook_world_render: frame.view does not fit the camera of nook_scene_set_camera, so bodies "
              "darken other places: %s (got a view from %g %g %g, need one from %g %g %g); set frame.view to "
              "the matrix from world space to view space of the camera that drew the depth, in the unit of "
              "the poses",
              mistake, double(eye.x), double(eye.y), double(eye.z), double(camera.x), double(camera.y),
              double(camera.z));
}

void log_cone(const Context& context, WorldReports& reports, float degrees) {
  // The sun and the moon are about 0.53 degrees wide. An angle of 14 degrees is 0.25 radians.
  constexpr float narrowest = 0.25f;
  if (reports.cone || degrees >= narrowest) return;
  reports.cone = true;
  context.log(NOOK_LOG_WARNING,
              "nook_world_render: desc.light_degrees is narrower than any sun, so its shadow has hard edges "
              "(got %g degrees, need the full angle of the cone, such as 0.53 for the sun); if you passed "
              "radians, multiply by 57.3, which gives %g",
              double(degrees), double(degrees) * 57.29578);
}

// Returns the instance from whose ground the light rises most. Null: no instance has a ground.
const Instance* most_lit(const Scene& scene, Vec3 axis) {
  const Instance* most = nullptr;
  for (const Instance& instance : scene.instances) {
    if (!instance.id || !instance.input.has_ground) continue;
    if (!most || dot(axis, instance.input.ground.normal) > dot(axis, most->input.ground.normal))
      most = &instance;
  }
  return most;
}

void log_axis(const Context& context, WorldReports& reports, Vec3 axis, const Scene* scene) {
  if (reports.axis || reports.axis_was_above || !scene) return;
  const Instance* const instance = most_lit(*scene, axis);
  if (!instance) return;
  const float sine = dot(axis, instance->input.ground.normal);
  // A lamp on the floor may be at the height of the horizon.
  constexpr float horizon = -0.05f;
  reports.axis_was_above = sine >= horizon;
  if (reports.axis_was_above) return;
  reports.axis = true;
  context.log(
      NOOK_LOG_WARNING,
      "nook_world_render: desc.light_axis points below the ground of all instances, such as %u, so the "
      "light comes from under the floor (got %g %g %g); it is the direction towards the light: negate it if "
      "yours "
      "is the direction in which the light shines. While a sun is below the horizon, set "
      "desc.light_degrees to 0",
      instance->id, double(axis.x), double(axis.y), double(axis.z));
}

void log_mask(const Context& context, WorldReports& reports, nook_gbuffer_ao mode, const Scene* scene) {
  if (reports.mask || !scene || mode >= NOOK_GBUFFER_AO_REPLACE) return;
  const bool has_bodies = std::any_of(
      scene->instances.begin(), scene->instances.end(),
      [](const Instance& instance) { return instance.id && !instance.model->model.world_casters.empty(); });
  if (!has_bodies) return;
  reports.mask = true;
  context.log(
      NOOK_LOG_INFO,
      "nook_world_render: without a mask, the capsules of a body also darken the body's own skin (got "
      "frame.gbuffer_ao %d); draw a mask of the bodies and set NOOK_GBUFFER_AO_REPLACE or _EXCLUDE, "
      "or do not use the result where you light bodies",
      mode);
}

}  // namespace

void log_world_frame(const Context& context, WorldReports& reports, const float (&view)[16],
                     nook_gbuffer_ao gbuffer_ao, const nook_world_frame_desc& frame, const Scene* scene) {
  log_view(context, reports, view, scene);
  log_mask(context, reports, gbuffer_ao, scene);
  if (frame.light_degrees == 0) return;
  log_cone(context, reports, frame.light_degrees);
  log_axis(context, reports, vector_of(frame.light_axis), scene);
}

}  // namespace nook::api
