#include <nook/nook_world.h>

#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/gl/nnao_descriptors.h"
#include "sdk/src/api/gl/world_log.h"
#include "sdk/src/api/pose_log.h"
#include "sdk/src/api/world_casting.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/world/world_pass.h"

using namespace nook;

namespace {

// Returns the users of the OpenGL state that the pass touches (touched_state.h). The pass uploads casters and
// draws, and its stages may be compute shaders.
unsigned world_users(const gl::Functions& gl, bool computes) {
  return gl::screen_creation_users(gl) | (computes ? unsigned{gl::screen_compute} : 0u);
}

}  // namespace

// The OpenGL objects of a world pass can outlive the handle nook_gl, because the pass holds a reference to
// the owner of nook_gl.
struct nook_world_s : RefCounted {
  nook_world_s(nook_gl_s* made_by, const nook_world_desc& known) : gl(made_by), desc(known) {
    gl->device.report_host_errors();
    gl->guarded(world_users(gl->device.gl, false), [&] { pass.emplace(gl->device, known); });
  }

  nook_gl_s* gl;
  nook_world_desc desc;
  std::optional<gl::WorldPass> pass;
  api::WorldReports reports;
};

namespace {

nook_world_desc checked(const nook_world_desc* given) {
  const nook_world_desc desc = read_descriptor(given);
  api::check_max_size(desc.max_width, desc.max_height);
  constexpr std::uint32_t most = 1u << 20;
  check_range("desc.capsules", desc.capsules, 1, most);
  check_switch("desc.half_resolution", desc.half_resolution);
  check_switch("desc.coloured", desc.coloured);
  return desc;
}

// Returns the frame in the form that the screen-space pass uses. Fields that the world pass does not use get
// defaults.
gl::NnaoFrame screen_of(const nook_gl_frame_desc* given, const nook_world_frame_desc& desc,
                        const nook_world_desc& pass) {
  gl::NnaoFrame screen{read_descriptor(given), default_desc<nook_nnao_frame_desc>()};
  screen.radius = 1;
  screen.intensity = desc.intensity;
  screen.power = desc.power;
  nook_nnao_desc sizes{};
  sizes.max_width = pass.max_width;
  sizes.max_height = pass.max_height;
  gl::check_frame(screen, sizes);
  gl::check_view(screen.view);
  return screen;
}

void check_numbers(const nook_world_frame_desc& desc) {
  check_range("desc.cutoff_error", desc.cutoff_error, 0, 1);
  check_range("desc.level_error", desc.level_error, 0, 1);
  check_known("desc.combine", desc.combine, NOOK_WORLD_COMBINE_MIN);
}

nook_world_view shown(const void* next) {
  const auto* const given = find_extension<nook_world_frame_debug_desc>(next);
  const nook_world_view show = given ? read_descriptor(given).show : NOOK_WORLD_VIEW_AO;
  check_known("debug.show", show, NOOK_WORLD_VIEW_FAR_TESTS);
  return show;
}

// Sets the light of a coloured pass: the lobes in view space, and the cone in world space. The view must
// already be checked.
void put_light(gl::WorldFrame& drawn, const nook_world_frame_desc& desc, bool coloured,
               float units_per_metre) {
  constexpr float default_reach_m = 30;
  if (!coloured && (desc.lobe_count > 0 || desc.light_degrees != 0))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.%s needs a coloured pass, but this pass is not coloured; create the pass with "
                  "nook_world_desc.coloured",
                  desc.lobe_count > 0 ? "lobes" : "light_degrees");
  drawn.light = api::terms_of_lobes("desc", desc.lobes, desc.lobe_count, drawn.screen.view);
  if (desc.light_degrees == 0) return;
  const Vec3 axis = api::checked_light("desc", desc.light_axis, desc.light_degrees);
  check_fits("desc.light_reach", desc.light_reach, desc.light_reach >= 0 && desc.light_reach <= max_metres,
             "a length above 0, or 0 for the default of 30 metres");
  const float reach = desc.light_reach > 0 ? desc.light_reach : default_reach_m * units_per_metre;
  drawn.cone = gl::LightCone{axis, api::half_angle_radians(desc.light_degrees), reach};
}

// The groups of casters in the scene, and the cut-off error. A group is ignored at distances where it reduces
// AO by less than this error.
struct Reaching {
  const api::Casting* casting;
  float cutoff_error;
};

gl::ReachingGroup reaching_group(const void* user, std::uint32_t index, PosedCaster& room) {
  const Reaching& reaching = *static_cast<const Reaching*>(user);
  const world::CasterGroup group = api::Casting::group(reaching.casting, index, room);
  if (group.casters.empty()) return {};
  const bool endless = reaching.cutoff_error == 0 || std::isinf(group.strength);
  return {group.casters,
          group.centre,
          group.radius,
          endless ? gl::endless_reach : group.radius + std::sqrt(group.strength / reaching.cutoff_error),
          group.strength,
          endless ? gl::endless_reach : group.strength / reaching.cutoff_error,
          reaching.casting->parts(index)};
}

}  // namespace

nook_result nook_world_create(nook_gl gl, const nook_world_desc* desc, nook_world* out) {
  return api::enter("nook_world_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    gl->device.need_alive();
    *out =
        Owned<nook_world_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, checked(desc)).detach();
  });
}

void nook_world_destroy(nook_world* pass) {
  if (!pass || !*pass) return;
  (*pass)->release();
  *pass = nullptr;
}

nook_result nook_world_render(nook_world pass, const nook_gl_frame_desc* frame,
                              const nook_world_frame_desc* desc) {
  return api::enter("nook_world_render", [&] {
    need(pass, "pass");
    const auto known = read_descriptor<nook_world_frame_desc, nook_world_frame_debug_desc>(desc);
    gl::NnaoFrame screen = screen_of(frame, known, pass->desc);
    api::check_props("desc", known.capsules, known.capsule_count);
    check_numbers(known);
    if (known.scene) api::log_without_world_casters(pass->gl->device.context, known.scene->scene);
    const api::Casting casting(known.scene ? &known.scene->scene : nullptr, 0, known.capsules,
                               known.capsule_count);
    const Reaching reaching{&casting, known.cutoff_error};
    const gl::ReachingGroups groups{casting.group_count(), &reaching, reaching_group};
    gl::WorldFrame drawn{
        screen, screen.view, known.ao_texture, known.combine, known.level_error, shown(known.next), {}, {}};
    put_light(drawn, known, pass->desc.coloured != 0, pass->gl->device.context.units_per_metre());
    api::log_world_frame(pass->gl->device.context, pass->reports, screen.view, screen.gbuffer_ao, known,
                         known.scene ? &known.scene->scene : nullptr);
    pass->gl->guarded(world_users(pass->gl->device.gl, pass->pass->computes()),
                      [&] { pass->pass->render(drawn, groups); });
  });
}

nook_result nook_world_describe(nook_world pass, nook_world_info* info) {
  return api::enter("nook_world_describe", [&] {
    need(pass, "pass");
    pass->gl->device.need_current();
    nook_world_info known{};
    known.texture = pass->pass->ao_texture();
    known.caster_texture = pass->pass->casters().table().texture();
    known.caster_target = gl::TexelTable::target(pass->gl->device);
    known.group_count = static_cast<std::int32_t>(pass->pass->casters().group_count());
    known.caster_count = static_cast<std::int32_t>(pass->pass->casters().caster_count());
    known.texture_bytes = pass->pass->bytes();
    known.glsl = gl::embedded_text("world/host.glsl");
    write_info(info, known);
  });
}
