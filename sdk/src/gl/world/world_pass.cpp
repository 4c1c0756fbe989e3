#include "sdk/src/gl/world/world_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/state_guard.h"
#include "sdk/src/gl/world/caster_texels.h"
#include "sdk/src/nnao/host_depth.h"
#include "sdk/src/world/cone.h"
#include "shaders/nnao/layout.h"
#include "shaders/world/constants.h"

namespace nook::gl {
namespace {

// Multiplies the target by AO; alpha stays.
constexpr BlendState multiplying{GL_TRUE, GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE, GL_FUNC_ADD, GL_FUNC_ADD};

// Textures that only this pass has. Those that are not read by the same stage share a unit. The upsample
// reads the depth of every fourth pixel beside a layer, the stages of AO beside normals.
constexpr GLuint caster_unit = filter_unit, half_ao_unit = filter_unit;
constexpr GLuint upsample_depth_unit = NOOK_UNIT_NORMAL, darkening_depth_unit = NOOK_UNIT_LAYER;
constexpr GLuint other_ao_unit = NOOK_UNIT_MOTION, far_unit = NOOK_UNIT_MOTION;

// The frame's constants of the screen pass that this pass does not use have the values of such a pass.
nook_nnao_desc plain_pass(bool half) {
  nook_nnao_desc desc{};
  desc.taps = 32;
  desc.blur_sharpness = 16;
  desc.half_resolution = half;
  return desc;
}

TextureFormat result_format(bool coloured) {
  return coloured ? TextureFormat::bent_ao : TextureFormat::ao;
}

// Pixels along a side for each texel of the far bodies' AO. A texel stands for about so much of the picture
// that a body's merging distance has several, also where the floor is seen at a grazing angle.
constexpr int far_step(int max_height) {
  return max_height >= 1000 ? NOOK_FAR_STEP : max_height >= 500 ? 4 : 2;
}

// Pixels along a side of a tile of lists; a group of threads lies in one.
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

// A capsule counts as a rectangle in each part of a cone, whose corners reach beyond its round ends by less
// than a third of a part.
float angle_round(const LightCone& cone, float slope) {
  constexpr float widest = 1.56f;
  return std::min(cone.half_angle_radians + 2 * std::atan(slope), widest);
}

[[noreturn]] void refuse_casters(const Device& device, std::uint32_t casters, std::uint32_t bodies) {
  throw Failure(
      NOOK_ERROR_INVALID_ARGUMENT,
      "the frame has more casters in view than this OpenGL has room for (got %u in %u bodies, need at most "
      "%u of both); leave out bodies that are far from the view",
      casters, bodies, device.max_texels / NOOK_BODY_TEXELS);
}

}  // namespace

WorldPass::WorldPass(Device& device, const nook_world_pass_desc& desc)
    : device_(device),
      max_width_(desc.max_width),
      max_height_(desc.max_height),
      half_(desc.half_resolution != 0),
      coloured_(desc.coloured != 0),
      computes_(half_ && device.gl.can.compute_images),
      far_step_(far_step(desc.max_height)),
      casters_(device.memory, caster_unit),
      kept_(device.memory),
      ranges_(device.memory),
      lists_(device.memory),
      near_ranges_(device.memory),
      near_lists_(device.memory),
      shades_(device.memory),
      shade_ranges_(device.memory),
      shade_lists_(device.memory) {
  const Functions& gl = device.gl;
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (desc.max_width > largest || desc.max_height > largest)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "desc.max_width x desc.max_height is larger than this OpenGL's textures (got %d x %d, need at "
        "most %d x %d)",
        desc.max_width, desc.max_height, largest, largest);
  const auto output = [&](const char* defines) {
    return half_ ? make_upsample(defines) : make_draw("world/darken.frag", defines);
  };
  output_ = output("");
  layered_output_ = output("#define NOOK_LAYERED 1\n");
  if (half_) make_half(desc);
  own_ = RenderTexture(device, result_format(coloured_), desc.max_width, desc.max_height,
                       "nook: AO of the world");
  const std::uint64_t texels = std::uint64_t{desc.casters} * NOOK_CASTER_TEXELS;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.casters is larger than this OpenGL's tables (got %u, need at most %llu)",
                  desc.casters, static_cast<unsigned long long>(device.max_texels / NOOK_CASTER_TEXELS));
  casters_.reserve(device, GL_RGBA32F, texels, "nook: world casters");
  sampler_ = Object::make(device, Object::Kind::sampler);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.SamplerParameteri(sampler_.name(), filter, GL_NEAREST);
  vertex_array_ = Object::make(device, Object::Kind::vertex_array);
  target_framebuffer_ = Object::make(device, Object::Kind::framebuffer);
  set_plain_drawing(gl);
  const GLfloat open[4] = {1, 1, 1, 1};
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, own_.framebuffer());
  gl.ClearBufferfv(GL_COLOR, 0, open);
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
                       1 / float(surface_length(max_width_, true)),
                       1 / float(surface_length(max_height_, true)));
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
  Stage stage;
  stage.program = std::move(program);
  const auto at = [&](const char* name) { return uniform_location(device_, stage.program, name); };
  stage.frame = at("nook_frame");
  stage.groups = at("nook_world_groups");
  stage.columns = at("nook_world_tile_columns");
  stage.tile_size = at("nook_world_tile_size");
  stage.first_tile = at("nook_world_first_tile");
  stage.composition = at("nook_world_composition");
  stage.counts = at("nook_world_counts");
  stage.far = at("nook_world_far");
  stage.first_far_tile = at("nook_world_first_far_tile");
  stage.light_terms = at("nook_world_light_terms");
  stage.cone = at("nook_world_cone");
  stage.light_columns = at("nook_world_light_columns");
  stage.first_light_tile = at("nook_world_first_light_tile");
  stage.first_shade = at("nook_world_first_shade");
  device_.gl.UseProgram(stage.program.name());
  const struct {
    const char* name;
    GLint unit;
  } samplers[] = {{"nook_host_depth", NOOK_UNIT_DEPTH}, {"nook_host_normal", NOOK_UNIT_NORMAL},
                  {"nook_world_casters", caster_unit},  {"nook_layer", NOOK_UNIT_LAYER},
                  {"nook_other_ao", other_ao_unit},     {"nook_far_open", far_unit},
                  {"nook_depth", upsample_depth_unit},  {"nook_ao", half_ao_unit}};
  // Where a stage has no such sampler the location is -1, which OpenGL ignores.
  for (const auto& sampler : samplers) device_.gl.Uniform1i(at(sampler.name), sampler.unit);
  return stage;
}

TextureFormat WorldPass::half_format() const {
  // OpenGL ES 3.1 writes no GL_R8 from a compute shader.
  const bool red = computes_ && !device_.gl.can.r8_images && !coloured_;
  return red ? TextureFormat::ao_image : result_format(coloured_);
}

void WorldPass::make_half(const nook_world_pass_desc& desc) {
  char masked[80];
  std::snprintf(masked, sizeof masked, "#define NOOK_APART %g\n", NOOK_REPLACED);
  half_depth_ = make_draw("nnao/depth.frag", "");
  masked_half_depth_ = make_draw("nnao/depth.frag", masked);
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
  std::uint64_t sum = texels(max_width_, max_height_) * bytes_per_texel(result_format(coloured_));
  if (half_)
    sum += texels(surface_length(max_width_, true), surface_length(max_height_, true)) *
               (bytes_per_texel(half_format()) + bytes_per_texel(TextureFormat::depth)) +
           texels(far_length(max_width_, far_step_), far_length(max_height_, far_step_)) *
               bytes_per_texel(half_format());
  return sum + casters_.bytes();
}

void WorldPass::check(const WorldFrame& frame) {
  HostImages images = images_of(frame.screen, plain_pass(half_));
  images.ao = frame.ao_texture;
  if (checked_ == images) return;
  checked_.reset();
  check_images(device_, images, own_.texture(), target_framebuffer_.name());
  checked_ = images;
}

std::uint64_t WorldPass::choose(const WorldFrame& frame, const ReachingGroups& groups) {
  const Viewport viewport = viewport_of(frame.screen);
  const auto width = std::uint32_t(viewport.width), height = std::uint32_t(viewport.height);
  const nnao::ScreenRays rays = nnao::projection_rays(frame.screen.projection, width, height);
  world::TileGrid grid;
  grid.width_px = width;
  grid.height_px = height;
  grid.x_scale = rays.x_scale;
  grid.x_offset = rays.x_offset;
  grid.y_scale = rays.y_scale;
  grid.y_offset = rays.y_offset;
  grid.orthographic = rays.orthographic;
  grid.tile_px = tile_px(computes_, far_step_);
  kept_.clear();
  ranges_.clear();
  lists_.clear();
  near_ranges_.clear();
  near_lists_.clear();
  far_ = false;
  caster_count_ = 0;
  std::uint64_t texels = 0;
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    PosedCaster room;
    const ReachingGroup group = groups.group(groups.user, g, room);
    if (group.casters.empty()) continue;
    const world::TileRange tiles = world::covered_tiles(grid, viewed(frame.view, group.centre), group.reach);
    if (tiles.empty) continue;
    keep(frame, grid, g, group, tiles);
    texels += texels_of(group);
  }
  tile_columns_ = 0;
  first_shade_ = static_cast<std::uint32_t>(texels);
  texels += choose_shades(frame, grid, groups);
  first_tile_ = static_cast<std::uint32_t>(texels);
  if (kept_.empty() && shades_.empty()) return 0;
  const auto most_texels = [&] {
    return texels + world::most_list_texels(grid, ranges_) + world::most_list_texels(grid, near_ranges_) +
           world::most_list_texels(grid, shade_ranges_);
  };
  // Larger tiles have shorter lists, down to one list of all bodies.
  while (most_texels() > device_.max_texels && grid.columns() * grid.rows() > 1) {
    grid.tile_px *= 2;
    for (auto* const ranges : {&ranges_, &near_ranges_, &shade_ranges_})
      for (world::TileRange& range : *ranges) {
        range.first_column /= 2;
        range.last_column /= 2;
        range.first_row /= 2;
        range.last_row /= 2;
      }
  }
  if (most_texels() > device_.max_texels) refuse_casters(device_, caster_count_, group_count());
  tile_px_ = grid.tile_px;
  if (!kept_.empty()) {
    world::write_tile_lists(grid, ranges_, lists_);
    texels += lists_.size() / 4;
    tile_columns_ = grid.columns();
    first_near_tile_ = static_cast<std::uint32_t>(texels);
    if (half_) world::write_tile_lists(grid, near_ranges_, near_lists_);
    texels += near_lists_.size() / 4;
  }
  first_light_tile_ = static_cast<std::uint32_t>(texels);
  if (!shades_.empty()) {
    world::write_tile_lists(grid, shade_ranges_, shade_lists_);
    texels += shade_lists_.size() / 4;
    light_columns_ = grid.columns();
  }
  return texels;
}

void WorldPass::keep(const WorldFrame& frame, const world::TileGrid& grid, std::uint32_t index,
                     const ReachingGroup& group, const world::TileRange& tiles) {
  kept_.push_back(index);
  ranges_.push_back(tiles);
  caster_count_ += static_cast<std::uint32_t>(group.casters.size());
  if (!half_) return;
  const float merging = group.merging_distance(frame.level_error);
  const bool far = merging < group.reach;
  near_ranges_.push_back(far ? world::covered_tiles(grid, viewed(frame.view, group.centre), merging) : tiles);
  far_ = far_ || far;
}

std::uint64_t WorldPass::choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                                       const ReachingGroups& groups) {
  shades_.clear();
  shade_ranges_.clear();
  shade_lists_.clear();
  light_columns_ = 0;
  if (!frame.cone) return 0;
  const LightCone& cone = *frame.cone;
  const float wide = angle_round(cone, world::cone_parts_of(cone.axis, cone.half_angle_radians).slope);
  const world::Shadow shadow{-1.0f * turned(frame.view, cone.axis), std::tan(wide), cone.reach};
  std::uint64_t texels = 0;
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    PosedCaster room;
    const ReachingGroup group = groups.group(groups.user, g, room);
    if (group.casters.empty()) continue;
    const world::TileRange tiles =
        world::shaded_tiles(grid, viewed(frame.view, group.centre), group.radius, shadow);
    if (tiles.empty) continue;
    shades_.push_back(g);
    shade_ranges_.push_back(tiles);
    texels += shade_texels_of(group);
  }
  return texels;
}

void WorldPass::upload(const WorldFrame& frame, const ReachingGroups& groups) {
  const std::uint64_t texels = choose(frame, groups);
  if (texels == 0) return;
  casters_.write(device_, texels, [&](void* memory) {
    CasterTexels out(static_cast<float*>(memory), frame.view, group_count());
    for (std::uint32_t body = 0; body < group_count(); ++body) {
      PosedCaster room;
      out.put(body, groups.group(groups.user, kept_[body], room), frame.level_error);
    }
    out.begin_shades(first_shade_, static_cast<std::uint32_t>(shades_.size()));
    for (std::uint32_t body = 0; body < shades_.size(); ++body) {
      PosedCaster room;
      out.put_shade(body, groups.group(groups.user, shades_[body], room));
    }
    float* const table = static_cast<float*>(memory);
    std::copy(lists_.begin(), lists_.end(), table + 4 * std::size_t{first_tile_});
    std::copy(near_lists_.begin(), near_lists_.end(), table + 4 * std::size_t{first_near_tile_});
    std::copy(shade_lists_.begin(), shade_lists_.end(), table + 4 * std::size_t{first_light_tile_});
  });
}

void WorldPass::set_frame(const Stage& stage, const WorldFrame& frame,
                          const FrameConstants& constants) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(stage.program.name());
  gl.Uniform4fv(stage.frame, static_cast<GLsizei>(constants.values.size() / 4), constants.values.data());
  gl.Uniform1i(stage.groups, static_cast<GLint>(group_count()));
  gl.Uniform1i(stage.columns, static_cast<GLint>(tile_columns_));
  gl.Uniform1i(stage.tile_size, static_cast<GLint>(tile_px_));
  const bool near = &stage == &half_ao_;
  gl.Uniform1i(stage.first_tile, static_cast<GLint>(near ? first_near_tile_ : first_tile_));
  gl.Uniform1i(stage.far, far_);
  gl.Uniform1i(stage.first_far_tile, static_cast<GLint>(first_tile_));
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
  gl.Uniform1i(stage.light_columns, static_cast<GLint>(light_columns_));
  gl.Uniform1i(stage.first_light_tile, static_cast<GLint>(first_light_tile_));
  gl.Uniform1i(stage.first_shade, static_cast<GLint>(first_shade_));
  if (!frame.cone) return;
  // The parts lie as in nook_world_sample, whatever the view.
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

void WorldPass::draw(GLuint framebuffer, const Viewport& viewport) const {
  const Functions& gl = device_.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  set_viewport(gl, {float(viewport.x), float(viewport.y), float(viewport.width), float(viewport.height)});
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void WorldPass::draw_depth(const WorldFrame& frame, const FrameConstants& constants) const {
  const Viewport viewport = viewport_of(frame.screen);
  set_frame(frame.screen.layer >= NOOK_NNAO_LAYER_REPLACE ? masked_half_depth_ : half_depth_, frame,
            constants);
  draw(depth_.framebuffer(),
       {0, 0, surface_length(viewport.width, true), surface_length(viewport.height, true)});
}

void WorldPass::darken(const RenderTexture& target, int width, int height) const {
  if (!computes_) {
    draw(target.framebuffer(), {0, 0, width, height});
    return;
  }
  const Functions& gl = device_.gl;
  const auto groups = [](int length) {
    return GLuint(length + NOOK_WORLD_GROUP_SIZE - 1) / NOOK_WORLD_GROUP_SIZE;
  };
  gl.BindImageTexture(image_unit_index, target.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                      half_format() == TextureFormat::ao ? GL_R8 : GL_RGBA8);
  // Earlier reads and draws end before the texture is written.
  gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  gl.DispatchCompute(groups(width), groups(height), 1);
  // The next stage reads the texture.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void WorldPass::darken_half(const WorldFrame& frame, const FrameConstants& constants) const {
  const Viewport viewport = viewport_of(frame.screen);
  if (far_) {
    set_frame(far_ao_, frame, constants);
    darken(far_texture_, far_length(viewport.width, far_step_), far_length(viewport.height, far_step_));
  }
  device_.gl.ActiveTexture(GL_TEXTURE0 + far_unit);
  device_.gl.BindTexture(GL_TEXTURE_2D, far_texture_.texture());
  set_frame(half_ao_, frame, constants);
  darken(ao_, surface_length(viewport.width, true), surface_length(viewport.height, true));
}

const WorldPass::Stage& WorldPass::output_of(const WorldFrame& frame) const {
  if (half_ && frame.show != NOOK_WORLD_VIEW_AO) return counts_;
  return frame.screen.layer != NOOK_NNAO_LAYER_NONE ? layered_output_ : output_;
}

void WorldPass::draw_output(const Stage& stage, const WorldFrame& frame, const FrameConstants& constants) {
  const Functions& gl = device_.gl;
  const nook_nnao_frame_desc& screen = frame.screen;
  const bool to_texture = screen.target == NOOK_NNAO_TARGET_TEXTURE;
  set_frame(stage, frame, constants);
  GLuint framebuffer = own_.framebuffer();
  if (screen.target != NOOK_NNAO_TARGET_OWN) {
    framebuffer = to_texture ? target_framebuffer_.name() : screen.target_name;
    if (gl.can.desktop_raster) gl.Enable(GL_FRAMEBUFFER_SRGB);  // OpenGL ES has no switch: it is on
    if (screen.blend == NOOK_NNAO_MULTIPLY) set_blend(gl, multiplying);
  }
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (to_texture)
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, screen.target_name, 0);
  nook_nnao_desc sizes{};
  sizes.max_width = max_width_;
  sizes.max_height = max_height_;
  if (replaces_target(screen, sizes)) discard_colours(gl);
  draw(framebuffer, viewport_of(screen));
  // If it stayed attached, a texture that the host deletes would live on.
  if (to_texture) gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

void WorldPass::render(const WorldFrame& frame, const ReachingGroups& groups) {
  check(frame);
  upload(frame, groups);
  const Functions& gl = device_.gl;
  const nook_nnao_frame_desc& screen = frame.screen;
  const bool layered = screen.layer != NOOK_NNAO_LAYER_NONE;
  set_plain_drawing(gl);
  gl.BindVertexArray(vertex_array_.name());
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) gl.BindSampler(unit, sampler_.name());
  const auto bind = [&](GLuint unit, GLuint texture) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
  };
  bind(NOOK_UNIT_DEPTH, screen.depth_texture);
  bind(NOOK_UNIT_NORMAL, screen.normal_texture);
  bind(other_ao_unit, frame.ao_texture);
  bind(NOOK_UNIT_LAYER, 0);
  bind(caster_unit, 0);
  casters_.bind(device_);
  if (layered) bind(NOOK_UNIT_LAYER, screen.layer_texture);
  const FrameConstants constants = frame_constants(screen, plain_pass(half_), 0);
  if (half_) {
    draw_depth(frame, constants);
    bind(darkening_depth_unit, depth_.texture());
    darken_half(frame, constants);
    bind(NOOK_UNIT_LAYER, layered ? screen.layer_texture : 0);
    bind(other_ao_unit, frame.ao_texture);
    bind(upsample_depth_unit, depth_.texture());
    bind(half_ao_unit, ao_.texture());
  }
  draw_output(output_of(frame), frame, constants);
}

}  // namespace nook::gl
