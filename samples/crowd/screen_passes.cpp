#include "samples/crowd/screen_passes.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace crowd {
namespace {

void make_texture(const GladGLContext& gl, GLuint name, GLenum attachment, GLenum internal_format,
                  GLenum format, GLenum type, int width, int height) {
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(internal_format), width, height, 0, format, type, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, name, 0);
}

nook_nnao_desc screen_settings(int width, int height, const ScreenQuality& quality) {
  nook_nnao_desc desc = nook::nnao_desc();
  desc.max_width = width;
  desc.max_height = height;
  // An engine sets only desc.preset. This sample uses settings for software renderers that no preset has.
  desc.taps = quality.taps;
  desc.half_resolution = quality.half_resolution;
  return desc;
}

}  // namespace

ScreenQuality quality_for(const std::string& gl_renderer) {
  for (const char* software : {"llvmpipe", "softpipe", "SwiftShader"})
    if (gl_renderer.find(software) != std::string::npos) return {16, true};
  return {};
}

nook_world_desc world_settings(int width, int height, const ScreenQuality& quality) {
  nook_world_desc desc = nook::world_pass_desc();
  desc.max_width = width;
  desc.max_height = height;
  desc.half_resolution = quality.half_resolution;
  desc.coloured = 1;
  return desc;
}

ScreenPasses::ScreenPasses(const platform::Context& context, const nook::Gl& gl, int width, int height)
    : ScreenPasses(context, gl, width, height, quality_for(context.renderer())) {}

ScreenPasses::ScreenPasses(const platform::Context& context, const nook::Gl& gl, int width, int height,
                           const ScreenQuality& chosen)
    : width_px(width),
      height_px(height),
      quality(chosen),
      screen(gl, screen_settings(width, height, quality)),
      world(gl, world_settings(width, height, quality)),
      gl_(context.gl()) {
  gl_.GenTextures(texture_count, textures_);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.ActiveTexture(GL_TEXTURE0);
  make_texture(gl_, textures_[depth], GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, width, height);
  make_texture(gl_, textures_[normals], GL_COLOR_ATTACHMENT0, GL_RGB10_A2, GL_RGBA,
               GL_UNSIGNED_INT_2_10_10_10_REV, width, height);
  make_texture(gl_, textures_[layers], GL_COLOR_ATTACHMENT1, GL_RG8, GL_RG, GL_UNSIGNED_BYTE, width, height);
  const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, buffers);
  const bool complete = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete)
    throw std::runtime_error(
        "crowd: this OpenGL cannot draw normals beside depth (RGB10_A2 and RG8 with 24-bit depth); choose "
        "another --context");
}

ScreenPasses::~ScreenPasses() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(texture_count, textures_);
}

ScreenAo ScreenPasses::draw(Renderer& renderer, std::span<const DrawnInstance> instances,
                            const Camera& camera, nook_scene scene, const Light* light) {
  draw_screen(renderer, instances, camera, NOOK_GBUFFER_AO_EXCLUDE);
  const glm::mat4 view = view_from_world(camera);
  std::copy_n(glm::value_ptr(view), 16, frame.view);
  world_frame = nook::world_frame_desc();
  world_frame.scene = scene;
  world_frame.ao_texture = screen.info().texture;
  if (light) {
    world_frame.lobes = light->soft.data();
    world_frame.lobe_count = std::uint32_t(light->soft.size());
    std::copy_n(glm::value_ptr(light->to_sun), 3, world_frame.light_axis);
    world_frame.light_degrees = light->sun_degrees;
  }
  world.render(frame, world_frame);
  return {world.info().texture, textures_[depth]};
}

ScreenAo ScreenPasses::draw_screen(Renderer& renderer, std::span<const DrawnInstance> instances,
                                   const Camera& camera, nook_gbuffer_ao layer) {
  const float aspect = float(width_px) / float(height_px);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_px, height_px);
  const float facing[4] = {0.5f, 0.5f, 1, 1}, open[4] = {1, 0, 0, 0}, far_plane = 1;
  gl_.ClearBufferfv(GL_COLOR, 0, facing);
  gl_.ClearBufferfv(GL_COLOR, 1, open);
  gl_.ClearBufferfv(GL_DEPTH, 0, &far_plane);
  renderer.draw_surfaces(instances, camera, aspect);
  frame = nook::gl_frame_desc();
  frame.width = width_px;
  frame.height = height_px;
  frame.depth_texture = textures_[depth];
  frame.normal_texture = textures_[normals];
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  const glm::mat3 vs_from_ws(view_from_world(camera));
  const glm::mat4 projection = clip_from_view(camera, aspect);
  std::copy_n(glm::value_ptr(vs_from_ws), 9, frame.normal_matrix);
  std::copy_n(glm::value_ptr(projection), 16, frame.projection);
  frame.gbuffer_ao = layer;
  frame.gbuffer_ao_texture = textures_[layers];
  screen_frame = nook::nnao_frame_desc();
  screen_frame.radius = radius_m;
  screen.render(frame, screen_frame);
  return {screen.info().texture, textures_[depth]};
}

}  // namespace crowd
