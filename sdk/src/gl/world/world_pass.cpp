#include "sdk/src/gl/world/world_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/touched_state.h"
#include "sdk/src/gl/world/caster_texels.h"
#include "sdk/src/world/cone.h"
#include "shaders/nnao/layout.h"
#include "shaders/world/constants.h"

namespace nook::gl {
namespace {

// Texture units for textures that only this pass has. Two textures may share a unit if no stage reads both of
// them. The depth of every fourth pixel has two units, because the upsample stage also reads a layer, and the
// AO stages also read normals.
constexpr GLuint caster_unit = filter_unit, half_ao_unit = filter_unit;
constexpr GLuint upsample_depth_unit = NOOK_UNIT_NORMAL, darkening_depth_unit = NOOK_UNIT_LAYER;
constexpr GLuint other_ao_unit = NOOK_UNIT_MOTION, far_unit = NOOK_UNIT_MOTION;

// Returns default values for the screen pass's constants that this pass does not use.
NnaoSettings plain_pass(const nook_world_desc& world) {
  NnaoSettings desc{};
  desc.max_width = world.max_width;
  desc.max_height = world.max_height;
  desc.taps = 32;
  desc.blur_sharpness = 16;
  desc.half_resolution = world.half_resolution != 0;
  return desc;
}

TextureFormat result_format(bool coloured) {
  return coloured ? TextureFormat::bent_ao : TextureFormat::ao;
}

// Returns the size, in pixels along a side, of a texel of the AO of far bodies. A texel must be so small that
// a body's merging distance covers several texels, even where the floor is seen at a grazing angle.
constexpr int far_step(int max_height) {
  return max_height >= 1000 ? NOOK_FAR_STEP : max_height >= 500 ? 4 : 2;
}

// Returns the minimum size, in pixels along a side, of a tile of the lists. It is chosen so that each group
// of threads lies in a single tile.
constexpr std::uint32_t tile_px(bool computes, int far_step) {
  return computes ? std::max(32u, std::uint32_t(NOOK_WORLD_GROUP_SIZE * far_step)) : 32u;
}

static_assert(NOOK_VIEW_CASTERS == NOOK_WORLD_VIEW_CASTERS &&
              NOOK_VIEW_EXACT_CASTERS == NOOK_WORLD_VIEW_EXACT_CASTERS &&
              NOOK_VIEW_TESTS == NOOK_WORLD_VIEW_TESTS &&
              NOOK_VIEW_FAR_CASTERS == NOOK_WORLD_VIEW_FAR_CASTERS &&
              NOOK_VIEW_FAR_TESTS == NOOK_WORLD_VIEW_FAR_TESTS);

constexpr int far_length(int length, int step) {
  return (length + step - 1) / step;
}

}  // namespace

WorldPass::WorldPass(Device& device, const nook_world_desc& desc)
    : ScreenPass(device, plain_pass(desc)),
      half_(desc.half_resolution != 0),
      coloured_(desc.coloured != 0),
      computes_(half_ && device.gl.can.compute_images),
      far_step_(far_step(desc.max_height)),
      casters_(device.memory, caster_unit, {tile_px(computes_, far_step_), half_}) {
  check_size();
  const auto output = [&](const char* defines) {
    return half_ ? make_upsample(defines) : make_draw("world/darken.frag", defines);
  };
  output_ = output("");
  layered_output_ = output("#define NOOK_LAYERED 1\n");
  if (half_) make_half(desc);
  if (device.debug) {
    make_watch(make_draw("nnao/surface.frag", ""), false);
    make_body_watch();
  }
  own_ = RenderTexture(device, result_format(coloured_), desc.max_width, desc.max_height,
                       "nook: AO of the world");
  casters_.reserve(device, desc.capsules);
  make_objects({1, 1, 1, 1});
  device.check("making the world pass");
}

std::array<char, 160> WorldPass::defines_of(const char* own) const {
  std::array<char, 160> all{};
  std::snprintf(all.data(), all.size(), "#define NOOK_FAR_STEP %d\n#define NOOK_HALF %d\n%s%s", far_step_,
                half_ ? 1 : 0, own, coloured_ ? "#define NOOK_COLOURED 1\n" : "");
  return all;
}

WorldPass::Stage WorldPass::make_draw(const char* fragment, const char* defines, bool gathers) const {
  return make_stage(
      draw_program(device_, "nnao/screen.vert", fragment, defines_of(defines).data(), {.gathers = gathers}));
}

WorldPass::Stage WorldPass::make_upsample(const char* defines) const {
  char all[80];
  std::snprintf(all, sizeof all, "%s%s", computes_ ? "#define NOOK_GATHERS 1\n" : "", defines);
  Stage stage = make_draw("world/resolve.frag", all, computes_);
  device_.gl.UseProgram(stage.program.name());
  device_.gl.Uniform2f(uniform_location(device_, stage.program, "nook_texel_size"),
                       1 / float(surface_length(desc_.max_width, true)),
                       1 / float(surface_length(desc_.max_height, true)));
  return stage;
}

WorldPass::Stage WorldPass::make_darkening(const char* defines) const {
  Stage stage = computes_
                    ? make_stage(compute_program(device_, "world/darken.comp", defines_of(defines).data()))
                    : make_draw("world/darken.frag", defines);
  device_.gl.UseProgram(stage.program.name());
  device_.gl.Uniform1i(uniform_location(device_, stage.program, "nook_depth"), darkening_depth_unit);
  return stage;
}

WorldPass::Stage WorldPass::make_stage(Object program) const {
  constexpr SamplerUnit samplers[] = {
      {"nook_host_depth", NOOK_UNIT_DEPTH}, {"nook_host_normal", NOOK_UNIT_NORMAL},
      {"nook_world_casters", caster_unit},  {"nook_layer", NOOK_UNIT_LAYER},
      {"nook_other_ao", other_ao_unit},     {"nook_far_open", far_unit},
      {"nook_depth", upsample_depth_unit},  {"nook_ao", half_ao_unit}};
  Stage stage;
  ScreenPass::make_stage(stage, std::move(program), samplers);
  const auto at = [&](const char* name) { return uniform_location(device_, stage.program, name); };
  stage.groups = at("nook_world_groups");
  stage.columns = at("nook_world_tile_columns");
  stage.tile_size = at("nook_world_tile_size");
  stage.first_tile = at("nook_world_first_tile");
  stage.composition = at("nook_world_combine");
  stage.counts = at("nook_world_counts");
  stage.far = at("nook_world_far");
  stage.first_far_tile = at("nook_world_first_far_tile");
  stage.light_terms = at("nook_world_light_terms");
  stage.cone = at("nook_world_cone");
  stage.light_columns = at("nook_world_light_columns");
  stage.first_light_tile = at("nook_world_first_light_tile");
  stage.first_shade = at("nook_world_first_shade");
  return stage;
}

TextureFormat WorldPass::half_format() const {
  // Compute shaders in OpenGL ES 3.1 cannot write GL_R8 images.
  const bool red = computes_ && !device_.gl.can.r8_images && !coloured_;
  return red ? TextureFormat::ao_image : result_format(coloured_);
}

void WorldPass::make_half(const nook_world_desc& desc) {
  half_depth_ = make_draw("nnao/depth.frag", "");
  masked_half_depth_ = make_draw("nnao/depth.frag", "#define NOOK_NO_SURFACE_ABOVE NOOK_REPLACED_ABOVE\n");
  half_ao_ = make_darkening("#define NOOK_BODIES NOOK_NEAR_BODIES\n");
  far_ao_ = make_darkening("#define NOOK_BODIES NOOK_FAR_BODIES\n");
  counts_ = make_upsample("#define NOOK_COUNTS\n");
  const int width = surface_length(desc.max_width, true), height = surface_length(desc.max_height, true);
  depth_ = RenderTexture(device_, TextureFormat::depth, width, height, "nook: depth of every fourth pixel");
  ao_ = RenderTexture(device_, half_format(), width, height, "nook: AO of every fourth pixel");
  far_texture_ = RenderTexture(device_, half_format(), far_length(desc.max_width, far_step_),
                               far_length(desc.max_height, far_step_), "nook: AO by far bodies");
}

std::uint64_t WorldPass::bytes() const {
  const auto texels = [](std::uint64_t width, std::uint64_t height) { return width * height; };
  std::uint64_t sum = texels(desc_.max_width, desc_.max_height) * bytes_per_texel(result_format(coloured_));
  if (half_)
    sum += texels(surface_length(desc_.max_width, true), surface_length(desc_.max_height, true)) *
               (bytes_per_texel(half_format()) + bytes_per_texel(TextureFormat::depth)) +
           texels(far_length(desc_.max_width, far_step_), far_length(desc_.max_height, far_step_)) *
               bytes_per_texel(half_format());
  return sum + casters_.table().bytes();
}

void WorldPass::set_frame(const Stage& stage, const WorldFrame& frame,
                          const FrameConstants& constants) const {
  const Functions& gl = device_.gl;
  ScreenPass::set_frame(stage, constants);
  gl.Uniform1i(stage.groups, static_cast<GLint>(casters_.group_count()));
  gl.Uniform1i(stage.columns, static_cast<GLint>(casters_.columns()));
  gl.Uniform1i(stage.tile_size, static_cast<GLint>(casters_.tile_px()));
  const bool near = &stage == &half_ao_;
  gl.Uniform1i(stage.first_tile,
               static_cast<GLint>(near ? casters_.first_near_tile() : casters_.first_tile()));
  gl.Uniform1i(stage.far, casters_.far());
  gl.Uniform1i(stage.first_far_tile, static_cast<GLint>(casters_.first_tile()));
  gl.Uniform1i(stage.composition, frame.ao_texture ? 1 + frame.composition : 0);
  gl.Uniform1i(stage.counts, frame.show);
  if (coloured_) set_light(stage, frame);
}

void WorldPass::set_light(const Stage& stage, const WorldFrame& frame) const {
  const Functions& gl = device_.gl;
  std::array<float, 4 * NOOK_LIGHT_VEC4S> terms{};
  for (std::size_t i = 0; i < NOOK_LIGHT_VEC4S; ++i) {
    const Vec3 rgb = i < NOOK_LIGHT_TERMS ? frame.light.term[i] : frame.light.darkest;
    terms[4 * i] = rgb.x;
    terms[4 * i + 1] = rgb.y;
    terms[4 * i + 2] = rgb.z;
  }
  gl.Uniform4fv(stage.light_terms, NOOK_LIGHT_VEC4S, terms.data());
  gl.Uniform1i(stage.light_columns, static_cast<GLint>(casters_.light_columns()));
  gl.Uniform1i(stage.first_light_tile, static_cast<GLint>(casters_.first_light_tile()));
  gl.Uniform1i(stage.first_shade, static_cast<GLint>(casters_.first_shade()));
  if (!frame.cone) return;
  // The cone is divided in world space, so its parts are the same as in nook_world_sample and do not depend
  // on the view.
  const world::ConeParts parts = world::cone_parts_of(frame.cone->axis, frame.cone->half_angle_radians);
  std::array<float, 4 * NOOK_CONE_VEC4S> cone{};
  const auto put = [&](std::size_t i, Vec3 v, float w) {
    cone[4 * i] = v.x;
    cone[4 * i + 1] = v.y;
    cone[4 * i + 2] = v.z;
    cone[4 * i + 3] = w;
  };
  for (std::size_t i = 0; i < NOOK_CONE_PARTS; ++i) put(i, turned(frame.view, parts.axis[i]), parts.slope);
  put(NOOK_CONE_PARTS, turned(frame.view, frame.cone->axis), frame.cone->reach);
  const float wide = angle_round(*frame.cone, parts.slope);
  put(NOOK_CONE_PARTS + 1, {std::cos(wide), std::sin(wide), 0}, 0);
  gl.Uniform4fv(stage.cone, NOOK_CONE_VEC4S, cone.data());
}

void WorldPass::make_body_watch() {
  body_watch_.emplace(device_);
  body_stage_.stage = make_draw("world/bodies.frag", "");
  const auto at = [&](const char* name) {
    return uniform_location(device_, body_stage_.stage.program, name);
  };
  body_stage_.question = at("nook_question");
  body_stage_.count = at("nook_body_count");
  body_stage_.spheres = at("nook_body_spheres");
  body_stage_.light = at("nook_watched_light");
}

void WorldPass::watch_bodies(const WorldFrame& frame, const ReachingGroups& groups,
                             const FrameConstants& constants) {
  if (!body_watch_ || !body_watch_->begin_frame(device_, frame, groups)) return;
  const Functions& gl = device_.gl;
  for (int question = 0; question < BodyWatch::questions; ++question) {
    if (!body_watch_->begin(device_, question)) continue;
    ScreenPass::set_frame(body_stage_.stage, constants);
    const WatchedBodies& bodies = body_watch_->bodies(question);
    gl.Uniform1i(body_stage_.question, question);
    gl.Uniform1i(body_stage_.count, static_cast<GLint>(bodies.count));
    gl.Uniform4fv(body_stage_.spheres, 2 * NOOK_WATCHED_BODIES, bodies.spheres.data());
    gl.Uniform4fv(body_stage_.light, 1, body_watch_->light().data());
    draw(own_.framebuffer(), viewport_of(frame.screen), false);
    body_watch_->end(device_);
  }
}

void WorldPass::draw_depth(const WorldFrame& frame, const FrameConstants& constants) const {
  const Viewport viewport = viewport_of(frame.screen);
  set_frame(frame.screen.gbuffer_ao >= NOOK_GBUFFER_AO_REPLACE ? masked_half_depth_ : half_depth_, frame,
            constants);
  draw(depth_.framebuffer(),
       {0, 0, surface_length(viewport.width, true), surface_length(viewport.height, true)}, false);
}

void WorldPass::darken(const RenderTexture& target, int width, int height) const {
  if (computes_)
    dispatch(target, half_format() == TextureFormat::ao ? GL_R8 : GL_RGBA8, width, height,
             NOOK_WORLD_GROUP_SIZE);
  else
    draw(target.framebuffer(), {0, 0, width, height}, false);
}

void WorldPass::darken_half(const WorldFrame& frame, const FrameConstants& constants) const {
  const Viewport viewport = viewport_of(frame.screen);
  if (casters_.far()) {
    set_frame(far_ao_, frame, constants);
    darken(far_texture_, far_length(viewport.width, far_step_), far_length(viewport.height, far_step_));
  }
  bind_texture(far_unit, far_texture_.texture());
  set_frame(half_ao_, frame, constants);
  darken(ao_, surface_length(viewport.width, true), surface_length(viewport.height, true));
}

const WorldPass::Stage& WorldPass::output_of(const WorldFrame& frame) const {
  if (half_ && frame.show != NOOK_WORLD_VIEW_AO) return counts_;
  return frame.screen.gbuffer_ao != NOOK_GBUFFER_AO_NONE ? layered_output_ : output_;
}

void WorldPass::render(const WorldFrame& frame, const ReachingGroups& groups) {
  NnaoFrame& screen = frame.screen;
  HostImages images = images_of(screen, desc_);
  images.ao = frame.ao_texture;
  images.may_have_samples = false;
  screen.normalised_normals = check(images, screen.textures_changed).normalised_normals;
  casters_.write(device_, frame, groups);
  const GLuint layer = screen.gbuffer_ao != NOOK_GBUFFER_AO_NONE ? screen.gbuffer_ao_texture : 0;
  begin_frame();
  bind_texture(NOOK_UNIT_DEPTH, screen.depth_texture);
  watch_surfaces(screen, [&](const NnaoFrame&) { bind_texture(NOOK_UNIT_LAYER, layer); });
  bind_texture(NOOK_UNIT_NORMAL, screen.normal_texture);
  bind_texture(other_ao_unit, frame.ao_texture);
  bind_texture(caster_unit, 0);
  casters_.bind(device_);
  bind_texture(NOOK_UNIT_LAYER, layer);
  const FrameConstants constants = frame_constants(screen, desc_, 0);
  watch_bodies(frame, groups, constants);
  if (half_) {
    draw_depth(frame, constants);
    bind_texture(darkening_depth_unit, depth_.texture());
    darken_half(frame, constants);
    bind_texture(NOOK_UNIT_LAYER, layer);
    bind_texture(other_ao_unit, frame.ao_texture);
    bind_texture(upsample_depth_unit, depth_.texture());
    bind_texture(half_ao_unit, ao_.texture());
  }
  set_frame(output_of(frame), frame, constants);
  draw_output(screen, 0);
}

}  // namespace nook::gl
