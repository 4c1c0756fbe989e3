#include "sdk/src/gl/world/world_pass.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/state_guard.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {
namespace {

// Multiplies the target by AO; alpha stays.
constexpr BlendState multiplying{GL_TRUE, GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE, GL_FUNC_ADD, GL_FUNC_ADD};

constexpr std::uint64_t group_texels = 2, caster_texels = 2;

// A rotation and a translation, column-major.
Vec3 viewed(const float* m, Vec3 p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

// The frame's constants of the screen pass that this pass does not use have the values of such a pass.
nook_nnao_desc plain_pass() {
  nook_nnao_desc desc{};
  desc.taps = 32;
  desc.blur_sharpness = 16;
  return desc;
}

}  // namespace

WorldPass::WorldPass(Device& device, const nook_world_pass_desc& desc)
    : device_(device),
      max_width_(desc.max_width),
      max_height_(desc.max_height),
      casters_(device.memory, filter_unit) {
  const Functions& gl = device.gl;
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (desc.max_width > largest || desc.max_height > largest)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "desc.max_width x desc.max_height is larger than this OpenGL's textures (got %d x %d, need at "
        "most %d x %d)",
        desc.max_width, desc.max_height, largest, largest);
  stage_ = make_stage("");
  layered_stage_ = make_stage("#define NOOK_LAYERED 1\n");
  own_ = RenderTexture(device, TextureFormat::ao, desc.max_width, desc.max_height, "nook: AO of the world");
  const std::uint64_t texels = std::uint64_t{desc.casters} * caster_texels;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.casters is larger than this OpenGL's tables (got %u, need at most %llu)",
                  desc.casters, static_cast<unsigned long long>(device.max_texels / caster_texels));
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

WorldPass::Stage WorldPass::make_stage(const char* defines) {
  Stage stage;
  stage.program = draw_program(device_, "nnao/screen.vert", "world/darken.frag", defines);
  stage.frame = uniform_location(device_, stage.program, "nook_frame");
  stage.groups = uniform_location(device_, stage.program, "nook_world_groups");
  device_.gl.UseProgram(stage.program.name());
  const struct {
    const char* name;
    GLint unit;
  } samplers[] = {{"nook_host_depth", NOOK_UNIT_DEPTH},
                  {"nook_host_normal", NOOK_UNIT_NORMAL},
                  {"nook_world_casters", filter_unit},
                  {"nook_layer", NOOK_UNIT_LAYER}};
  // Where a stage has no such sampler the location is -1, which OpenGL ignores.
  for (const auto& sampler : samplers)
    device_.gl.Uniform1i(uniform_location(device_, stage.program, sampler.name), sampler.unit);
  return stage;
}

std::uint64_t WorldPass::bytes() const {
  return std::uint64_t(max_width_) * std::uint64_t(max_height_) * bytes_per_texel(TextureFormat::ao) +
         casters_.bytes();
}

void WorldPass::check(const nook_nnao_frame_desc& frame) {
  const HostImages images = images_of(frame, plain_pass());
  if (checked_ == images) return;
  checked_.reset();
  check_images(device_, images, own_.texture(), target_framebuffer_.name());
  checked_ = images;
}

void WorldPass::upload(const float* view, const ReachingGroups& groups) {
  groups_ = groups.count;
  caster_count_ = groups.casters;
  const std::uint64_t texels = groups.count * group_texels + groups.casters * caster_texels;
  if (texels == 0) return;
  if (texels > device_.max_texels)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the frame has more casters than this OpenGL has room for (got %u in %u bodies, need at most %u "
        "of both); leave out bodies that are far from the view",
        groups.casters, groups.count, device_.max_texels / 2);
  casters_.write(device_, texels, [&](void* memory) {
    auto* const out = static_cast<float*>(memory);
    const auto put = [&](std::uint64_t texel, Vec3 place, float w) {
      float* const at = out + 4 * texel;
      at[0] = place.x;
      at[1] = place.y;
      at[2] = place.z;
      at[3] = w;
    };
    std::uint64_t next = groups.count * group_texels;
    for (std::uint32_t g = 0; g < groups.count; ++g) {
      PosedCaster room;
      const ReachingGroup group = groups.group(groups.user, g, room);
      put(g * group_texels, viewed(view, group.centre), group.reach);
      put(g * group_texels + 1, {float(next), float(group.casters.size()), 0}, 0);
      for (const PosedCaster& caster : group.casters) {
        put(next++, viewed(view, caster.capsule.a), caster.ao_scale * caster.capsule.radius_a);
        put(next++, viewed(view, caster.capsule.b), caster.ao_scale * caster.capsule.radius_b);
      }
    }
  });
}

void WorldPass::render(const nook_nnao_frame_desc& frame, const float* view, const ReachingGroups& groups) {
  check(frame);
  const Functions& gl = device_.gl;
  const bool layered = frame.layer != NOOK_NNAO_LAYER_NONE;
  const bool to_texture = frame.target == NOOK_NNAO_TARGET_TEXTURE;
  const Stage& stage = layered ? layered_stage_ : stage_;
  upload(view, groups);
  set_plain_drawing(gl);
  gl.BindVertexArray(vertex_array_.name());
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) gl.BindSampler(unit, sampler_.name());
  const auto bind = [&](GLuint unit, GLuint texture) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
  };
  bind(NOOK_UNIT_DEPTH, frame.depth_texture);
  bind(NOOK_UNIT_NORMAL, frame.normal_texture);
  bind(filter_unit, 0);
  bind(NOOK_UNIT_LAYER, layered ? frame.layer_texture : 0);
  casters_.bind(device_);

  const FrameConstants constants = frame_constants(frame, plain_pass(), 0);
  gl.UseProgram(stage.program.name());
  gl.Uniform4fv(stage.frame, static_cast<GLsizei>(constants.values.size() / 4), constants.values.data());
  gl.Uniform1i(stage.groups, static_cast<GLint>(groups_));

  GLuint framebuffer = own_.framebuffer();
  if (frame.target != NOOK_NNAO_TARGET_OWN) {
    framebuffer = to_texture ? target_framebuffer_.name() : frame.target_name;
    if (gl.can.desktop_raster) gl.Enable(GL_FRAMEBUFFER_SRGB);  // OpenGL ES has no switch: it is on
    if (frame.blend == NOOK_NNAO_MULTIPLY) set_blend(gl, multiplying);
  }
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (to_texture)
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame.target_name, 0);
  const Viewport viewport = viewport_of(frame);
  nook_nnao_desc sizes{};
  sizes.max_width = max_width_;
  sizes.max_height = max_height_;
  if (replaces_target(frame, sizes)) discard_colours(gl);
  set_viewport(gl, {float(viewport.x), float(viewport.y), float(viewport.width), float(viewport.height)});
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  // If it stayed attached, a texture that the host deletes would live on.
  if (to_texture) gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

}  // namespace nook::gl
