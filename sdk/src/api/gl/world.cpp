#include <nook/nook_gl_world.h>

#include <cmath>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/gl/nnao_descriptors.h"
#include "sdk/src/api/world_casting.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/core/place.h"
#include "sdk/src/gl/nnao/frame_check.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/world/world_pass.h"

using namespace nook;

namespace {

// The users of the OpenGL state that the pass touches: it uploads casters and draws, and its stages may be
// compute shaders.
unsigned world_users(const gl::Functions& gl, bool computes) {
  return gl::screen_creation_users(gl) | (computes ? unsigned{gl::screen_compute} : 0u);
}

}  // namespace

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_world_pass_s : RefCounted {
  nook_world_pass_s(nook_gl_s* made_by, const nook_world_pass_desc& known) : gl(made_by), desc(known) {
    gl->device.report_host_errors();
    gl->guarded(world_users(gl->device.gl, false), [&] { pass.emplace(gl->device, known); });
  }

  nook_gl_s* gl;
  nook_world_pass_desc desc;
  std::optional<gl::WorldPass> pass;
};

namespace {

constexpr std::size_t first_desc = offsetof(nook_world_pass_desc, half_resolution) + sizeof(std::int32_t);
constexpr std::size_t first_frame = offsetof(nook_world_frame_desc, cutoff_error) + sizeof(float);
constexpr std::size_t first_info = offsetof(nook_world_pass_info, glsl) + sizeof(const char*);
// Of nook_nnao_frame_desc, whose defaults are those of nook_nnao_frame_desc_init.
constexpr std::size_t first_screen = offsetof(nook_nnao_frame_desc, view) + sizeof(nook_nnao_view);

nook_world_pass_desc default_desc() {
  nook_world_pass_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.casters = 4096;
  return desc;
}

nook_world_frame_desc default_frame() {
  nook_world_frame_desc frame{};
  frame.struct_size = sizeof frame;
  frame.header_version = NOOK_VERSION;
  frame.cutoff_error = SceneSettings{}.cutoff_error;
  frame.level_error = 1.0f / 256;
  frame.light_reach = 30;
  return frame;
}

nook_world_pass_desc checked(const nook_world_pass_desc* given) {
  const nook_world_pass_desc desc =
      read_descriptor(given, "nook_world_pass_desc_init", first_desc, default_desc());
  api::check_max_size(desc.max_width, desc.max_height);
  constexpr std::uint32_t most = 1u << 20;
  if (desc.casters < 1 || desc.casters > most)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.casters is out of range (got %u, need 1 to %u)",
                  desc.casters, most);
  const auto check_switch = [](const char* field, std::int32_t value) {
    if (value != 0 && value != 1)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s is neither on nor off (got %d, need 0 or 1)", field,
                    value);
  };
  check_switch("half_resolution", desc.half_resolution);
  check_switch("coloured", desc.coloured);
  return desc;
}

// The frame as the screen pass has it, without what this pass does not read.
nook_nnao_frame_desc screen_of(const nook_world_frame_desc& frame, const nook_world_pass_desc& pass) {
  need(frame.screen, "frame.screen");
  nook_nnao_frame_desc screen{};
  screen.struct_size = sizeof screen;
  screen = read_descriptor(frame.screen, "nook_nnao_frame_desc_init", first_screen, screen);
  screen.radius = 1;
  screen.radius_kind = NOOK_NNAO_RADIUS_METRES;
  screen.max_radius_px = 0;
  screen.view = NOOK_NNAO_VIEW_AO;
  nook_nnao_desc sizes{};
  sizes.max_width = pass.max_width;
  sizes.max_height = pass.max_height;
  gl::check_frame(screen, sizes);
  return screen;
}

void check_view(const float (&m)[16]) {
  bool finite = true;
  for (const float element : m) finite = finite && std::isfinite(element);
  const Vec3 x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
  const auto near = [](float value, float need) { return std::abs(value - need) <= 0.01f; };
  // 1 %, as for the matrices of poses.
  if (!finite || !near(dot(x, x), 1) || !near(dot(y, y), 1) || !near(dot(z, z), 1) || !near(dot(x, y), 0) ||
      !near(dot(y, z), 0) || !near(dot(z, x), 0) || !near(m[3], 0) || !near(m[7], 0) || !near(m[11], 0) ||
      !near(m[15], 1))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.view is no rotation with a translation (its first axis is %g %g %g; need a rigid matrix "
        "from world to view space, column-major)",
        double(m[0]), double(m[1]), double(m[2]));
}

void check_numbers(const nook_world_frame_desc& frame) {
  const auto check = [](const char* field, float value) {
    if (!(value >= 0 && value <= 1))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.%s is out of range (got %g, need 0 to 1)", field,
                    double(value));
  };
  check("cutoff_error", frame.cutoff_error);
  check("level_error", frame.level_error);
  const auto check_kind = [](const char* field, std::int32_t value, std::int32_t last) {
    if (value < 0 || value > last)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.%s is unknown (got %d, need 0 to %d)", field, value,
                    last);
  };
  check_kind("composition", frame.composition, NOOK_WORLD_MINIMUM);
  check_kind("show", frame.show, NOOK_WORLD_VIEW_FAR_TESTS);
}

// The light of a coloured pass: lobes in view space, the cone in world space. The view has passed its check.
void put_light(gl::WorldFrame& drawn, const nook_world_frame_desc& frame, bool coloured) {
  if (!coloured && (frame.lobe_count > 0 || frame.light_degrees != 0))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.%s needs a pass with desc.coloured 1, and this one has 0; create a coloured pass",
                  frame.lobe_count > 0 ? "lobes" : "light_degrees");
  drawn.light = api::terms_of_lobes("frame", frame.lobes, frame.lobe_count, frame.view);
  if (frame.light_degrees == 0) return;
  const Vec3 axis = api::checked_light("frame", frame.light_axis, frame.light_degrees);
  if (!(frame.light_reach > 0 && frame.light_reach <= max_metres))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.light_reach is out of range (got %g, need metres above 0)",
                  double(frame.light_reach));
  drawn.cone = gl::LightCone{axis, api::half_angle_radians(frame.light_degrees), frame.light_reach};
}

// The groups of the scene with their reach.
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

nook_result nook_world_pass_desc_init(nook_world_pass_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_world_pass_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_desc, default_desc()); });
}

nook_result nook_world_pass_create(nook_gl gl, const nook_world_pass_desc* desc, nook_world_pass* out) {
  return api::enter("nook_world_pass_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    gl->device.need_alive();
    *out = Owned<nook_world_pass_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, checked(desc))
               .detach();
  });
}

void nook_world_pass_destroy(nook_world_pass* pass) {
  if (!pass || !*pass) return;
  (*pass)->release();
  *pass = nullptr;
}

nook_result nook_world_frame_desc_init(nook_world_frame_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_world_frame_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_frame, default_frame()); });
}

nook_result nook_world_render(nook_world_pass pass, const nook_world_frame_desc* frame) {
  return api::enter("nook_world_render", [&] {
    need(pass, "pass");
    const nook_world_frame_desc known =
        read_descriptor(frame, "nook_world_frame_desc_init", first_frame, default_frame());
    const nook_nnao_frame_desc screen = screen_of(known, pass->desc);
    check_view(known.view);
    api::check_props("frame", known.props, known.prop_count);
    check_numbers(known);
    const api::Casting casting(known.scene ? &known.scene->scene : nullptr, 0, known.props, known.prop_count);
    const Reaching reaching{&casting, known.cutoff_error};
    const gl::ReachingGroups groups{casting.group_count(), &reaching, reaching_group};
    gl::WorldFrame drawn{
        screen, known.view, known.ao_texture, known.composition, known.level_error, known.show, {}, {}};
    put_light(drawn, known, pass->desc.coloured != 0);
    pass->gl->guarded(world_users(pass->gl->device.gl, pass->pass->computes()),
                      [&] { pass->pass->render(drawn, groups); });
  });
}

nook_result nook_world_recheck(nook_world_pass pass) {
  return api::enter("nook_world_recheck", [&] {
    need(pass, "pass");
    pass->pass->recheck();
  });
}

nook_result nook_world_pass_describe(nook_world_pass pass, nook_world_pass_info* info) {
  return api::enter("nook_world_pass_describe", [&] {
    need(pass, "pass");
    nook_world_pass_info known{};
    known.texture = pass->pass->ao_texture();
    known.caster_texture = pass->pass->casters().table().texture();
    known.caster_target = gl::TexelTable::target(pass->gl->device);
    known.group_count = static_cast<std::int32_t>(pass->pass->casters().group_count());
    known.caster_count = static_cast<std::int32_t>(pass->pass->casters().caster_count());
    known.texture_bytes = pass->pass->bytes();
    known.glsl = gl::embedded_text("world/host.glsl");
    write_info(info, first_info, known);
  });
}
