#include <array>
#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/api/pose_log.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/occluded_directions.h"
#include "sdk/src/character/scene_readings.h"
#include "sdk/src/core/checks.h"

using namespace nook;

namespace {

// Calls `body` with the scene of the handle.
template <class Body>
nook_result with_scene(const char* function, nook_scene scene, Body&& body) noexcept {
  return api::enter(function, [&] {
    need(scene, "scene");
    body(scene->scene);
  });
}

Sphere sphere_of(const nook_occluder& occluder) {
  const float* const c = occluder.centre_ws;
  return {{c[0], c[1], c[2]}, occluder.radius};
}

struct ChannelForm {
  const char* name;
  std::uint32_t numbers;  // number of values per vertex
  nook_format first_format, last_format;
};

constexpr ChannelForm channel_forms[] = {
    {"NOOK_CHANNEL_AO", 1, NOOK_FORMAT_FLOAT, NOOK_FORMAT_UNORM8},
    {"NOOK_CHANNEL_DIRECTIONAL_AO", 3, NOOK_FORMAT_FLOAT, NOOK_FORMAT_FLOAT},
    {"NOOK_CHANNEL_BENT_NORMAL", 4, NOOK_FORMAT_SNORM8, NOOK_FORMAT_SNORM8},
};

constexpr struct {
  const char* name;
  std::uint32_t bytes;  // bytes per value
} format_forms[] = {
    {"NOOK_FORMAT_FLOAT", 4}, {"NOOK_FORMAT_HALF", 2}, {"NOOK_FORMAT_UNORM8", 1}, {"NOOK_FORMAT_SNORM8", 1}};

std::size_t entry_bytes_of(nook_channel channel, nook_format format) {
  check_known("channel", channel, NOOK_CHANNEL_BENT_NORMAL);
  check_known("format", format, NOOK_FORMAT_SNORM8);
  const ChannelForm& form = channel_forms[channel];
  if (format < form.first_format || format > form.last_format)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  channel == NOOK_CHANNEL_AO
                      ? "%s cannot be read as %s; use %s, NOOK_FORMAT_HALF or NOOK_FORMAT_UNORM8"
                      : "%s cannot be read as %s; use %s",
                  form.name, format_forms[format].name, format_forms[form.first_format].name);
  return std::size_t{form.numbers} * format_forms[format].bytes;
}

// Returns the stride in bytes.
std::size_t check_output(const Instance& instance, uint32_t count, size_t stride, std::size_t entry_bytes) {
  const std::size_t file_vertices = instance.model->model.file_to_welded.size();
  if (count != file_vertices)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "count is not the model's file_vertex_count (got %u, need %zu); if your mesh has %u "
                  "vertices, the model was baked for another mesh: load the model of this mesh, or match the "
                  "vertices with nook_model_match_vertices",
                  count, file_vertices, count);
  return checked_stride("stride", stride, count, entry_bytes);
}

}  // namespace

SceneSettings nook::settings_of(const nook_scene_desc& desc, const Context& context) {
  constexpr float tiny = 1e-6f, huge = 1e9f;
  check_known("desc.form", desc.form, NOOK_FORM_PAPER);
  check_range("desc.cutoff_error", desc.cutoff_error, 0, 1);
  check_range("desc.far_error", desc.far_error, 0, 1);
  check_fits("desc.lod_error", desc.lod_error, desc.lod_error >= 0 && desc.lod_error <= huge, "0 or more");
  check_fits("desc.lod_distance", desc.lod_distance,
             desc.lod_distance == 0 || (desc.lod_distance >= tiny && desc.lod_distance <= huge),
             "a length above 0, or 0 for the default of 10 metres");
  check_fits("desc.ground_radius", desc.ground_radius,
             desc.ground_radius == 0 || (desc.ground_radius >= tiny && desc.ground_radius <= huge),
             "a length above 0, or 0 for the default, a multiple of each body's size");
  check_fits("desc.lod_max_interval", desc.lod_max_interval, desc.lod_max_interval >= 1, "1 or more");
  check_fits("desc.strict_poses", desc.strict_poses, desc.strict_poses <= 1, "0 or 1");
  return {
      desc.form,
      context.isa(),
      desc.cutoff_error,
      desc.far_error,
      desc.lod_error,
      desc.lod_distance > 0 ? desc.lod_distance : SceneSettings{}.lod_distance * context.units_per_metre(),
      desc.lod_max_interval,
      desc.ground_radius,
      desc.strict_poses != 0};
}

nook_result nook_scene_create(nook_context context, const nook_scene_desc* desc, nook_scene* out) {
  return api::enter("nook_scene_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const SceneSettings settings = settings_of(read_descriptor(desc), *context);
    *out =
        Owned<nook_scene_s>::make(context->memory(), Ref<nook_context_s>::share(context), context, settings)
            .detach();
  });
}

void nook_scene_destroy(nook_scene* scene) {
  if (!scene || !*scene) return;
  (*scene)->destroyed.store(true, std::memory_order_release);
  (*scene)->release();
  *scene = nullptr;
}

nook_result nook_scene_add_instance(nook_scene scene, nook_model model, nook_instance_id* out) {
  return with_scene("nook_scene_add_instance", scene, [&](Scene& s) {
    need(out, "out");
    *out = 0;
    need(model, "model");
    *out = add_instance(s, Ref<const LoadedModel>::share(model));
  });
}

nook_result nook_scene_remove_instance(nook_scene scene, nook_instance_id instance) {
  return with_scene("nook_scene_remove_instance", scene, [&](Scene& s) { remove_instance(s, instance); });
}

nook_result nook_scene_set_model(nook_scene scene, nook_instance_id instance, nook_model model) {
  return with_scene("nook_scene_set_model", scene, [&](Scene& s) {
    need(model, "model");
    set_model(s, instance, Ref<const LoadedModel>::share(model));
  });
}

nook_result nook_scene_link(nook_scene scene, nook_instance_id receiver, nook_instance_id caster) {
  return with_scene("nook_scene_link", scene, [&](Scene& s) { link(s, receiver, caster); });
}

nook_result nook_scene_unlink(nook_scene scene, nook_instance_id receiver, nook_instance_id caster) {
  return with_scene("nook_scene_unlink", scene, [&](Scene& s) { unlink(s, receiver, caster); });
}

nook_result nook_scene_link_nearest(nook_scene scene, uint32_t k, float max_distance) {
  return with_scene("nook_scene_link_nearest", scene, [&](Scene& s) {
    link_nearest(s, k, max_distance);
    scene->links_reported = false;
  });
}

nook_result nook_scene_set_ground(nook_scene scene, nook_instance_id instance, const float* plane_xyzd) {
  return with_scene("nook_scene_set_ground", scene, [&](Scene& s) {
    const float* p = plane_xyzd;
    const Plane plane = p ? Plane{{p[0], p[1], p[2]}, p[3]} : Plane{};
    set_ground(s, instance, p ? &plane : nullptr);
  });
}

nook_result nook_scene_add_occluder(nook_scene scene, const nook_occluder* occluder, nook_occluder_id* out) {
  return with_scene("nook_scene_add_occluder", scene, [&](Scene& s) {
    need(out, "out");
    *out = 0;
    need(occluder, "occluder");
    *out = add_occluder(s, sphere_of(*occluder), occluder->receiver);
  });
}

nook_result nook_scene_set_occluder(nook_scene scene, nook_occluder_id id, const nook_occluder* occluder) {
  return with_scene("nook_scene_set_occluder", scene, [&](Scene& s) {
    need(occluder, "occluder");
    set_occluder(s, id, sphere_of(*occluder), occluder->receiver);
  });
}

nook_result nook_scene_remove_occluder(nook_scene scene, nook_occluder_id occluder) {
  return with_scene("nook_scene_remove_occluder", scene, [&](Scene& s) { remove_occluder(s, occluder); });
}

nook_result nook_scene_set_camera(nook_scene scene, const float position_ws[3]) {
  return with_scene("nook_scene_set_camera", scene, [&](Scene& s) {
    for (int i = 0; position_ws && i < 3; ++i)
      if (!(std::abs(position_ws[i]) <= 1e9f))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "position_ws is out of range (element %d is %g, need finite metres)", i,
                      double(position_ws[i]));
    s.has_camera = position_ws != nullptr;
    if (position_ws) s.camera = {position_ws[0], position_ws[1], position_ws[2]};
  });
}

nook_result nook_scene_set_terms(nook_scene scene, uint32_t terms) {
  return with_scene("nook_scene_set_terms", scene, [&](Scene& s) {
    if (terms & ~uint32_t(NOOK_TERM_ALL))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "terms has unknown bits (got 0x%x, need a sum of NOOK_TERM_ values)", terms);
    s.terms = terms;
  });
}

nook_result nook_scene_update(nook_scene scene) {
  return with_scene("nook_scene_update", scene, [&](Scene& s) {
    need_cpu_poses(s);
    make_arrays(s);
    update(s);
    api::log_bodies(*scene);
  });
}

nook_result nook_scene_read(nook_scene scene, nook_instance_id instance, nook_channel channel,
                            nook_format format, void* out, uint32_t count, size_t stride) {
  return with_scene("nook_scene_read", scene, [&](Scene& s) {
    Instance& found = instance_of(s, instance);
    need(out, "out");
    stride = check_output(found, count, stride, entry_bytes_of(channel, format));
    need_cpu_pose(found);
    // Bent normals need no update.
    if (channel != NOOK_CHANNEL_BENT_NORMAL) api::log_missing_update(*scene->context, found);
    switch (channel) {
      case NOOK_CHANNEL_DIRECTIONAL_AO:
        return read_directional_ao(s, found, static_cast<float*>(out), stride);
      case NOOK_CHANNEL_BENT_NORMAL:
        check_bent_normals(found.model->model);
        return read_bent_normals(s, found, static_cast<std::int8_t*>(out), stride);
      default:
        return read_ao_as(s, found, format, out, stride);
    }
  });
}

nook_result nook_scene_set_light(nook_scene scene, nook_instance_id instance, const nook_lobe* lobes,
                                 uint32_t lobe_count) {
  return with_scene("nook_scene_set_light", scene, [&](Scene& s) {
    if (!lobes) lobe_count = 0;
    if (lobe_count > max_light_lobes)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "lobe_count is too large (got %u, need at most %u)",
                    lobe_count, max_light_lobes);
    std::array<SphericalGaussian, max_light_lobes> light;
    for (uint32_t i = 0; i < lobe_count; ++i)
      light[i] = {{lobes[i].axis[0], lobes[i].axis[1], lobes[i].axis[2]},
                  lobes[i].sharpness,
                  {lobes[i].amplitude[0], lobes[i].amplitude[1], lobes[i].amplitude[2]}};
    set_light(s, instance, {light.data(), lobe_count});
  });
}

nook_result nook_scene_describe(nook_scene scene, nook_scene_info* info) {
  return with_scene("nook_scene_describe", scene, [&](const Scene& s) {
    nook_scene_info answer = s.stats;
    answer.uneven_instances = uneven_instances(s);
    answer.memory_bytes = sizeof *scene + scene->metered.bytes();
    write_info(info, answer);
  });
}
