#include "samples/crowd/screen_space.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <vector>

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

nook_nnao_desc pass_settings(int width, int height, const ScreenSpaceQuality& quality) {
  nook_nnao_desc desc = nook::nnao_desc();
  desc.max_width = width;
  desc.max_height = height;
  desc.taps = quality.taps;
  desc.half_resolution = quality.half_resolution;
  return desc;
}

nook_world_desc world_settings(int width, int height, const ScreenSpaceQuality& quality) {
  nook_world_desc desc = nook::world_pass_desc();
  desc.max_width = width;
  desc.max_height = height;
  desc.half_resolution = quality.half_resolution;
  desc.coloured = 1;
  return desc;
}

}  // namespace

ScreenSpaceQuality quality_for(const std::string& gl_renderer) {
  for (const char* software : {"llvmpipe", "softpipe", "SwiftShader"})
    if (gl_renderer.find(software) != std::string::npos) return {16, true};
  return {};
}

ScreenSpaceAo::ScreenSpaceAo(const platform::Context& context, const nook::Gl& gl, int width_px,
                             int height_px)
    : gl_(context.gl()),
      width_px_(width_px),
      height_px_(height_px),
      quality_(quality_for(context.renderer())),
      pass_(gl, pass_settings(width_px, height_px, quality_)),
      world_(gl, world_settings(width_px, height_px, quality_)) {
  gl_.GenTextures(kTextures, textures_);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.ActiveTexture(GL_TEXTURE0);
  make_texture(gl_, textures_[kDepth], GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, width_px, height_px);
  make_texture(gl_, textures_[kNormals], GL_COLOR_ATTACHMENT0, GL_RGB10_A2, GL_RGBA,
               GL_UNSIGNED_INT_2_10_10_10_REV, width_px, height_px);
  make_texture(gl_, textures_[kLayer], GL_COLOR_ATTACHMENT1, GL_RG8, GL_RG, GL_UNSIGNED_BYTE, width_px,
               height_px);
  const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, buffers);
  const bool complete = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete)
    throw std::runtime_error(
        "crowd: this OpenGL cannot draw normals beside depth (RGB10_A2 and RG8 with 24-bit depth); use "
        "--screen-space off");
}

ScreenSpaceAo::~ScreenSpaceAo() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(kTextures, textures_);
}

ScreenAo ScreenSpaceAo::draw(Renderer& renderer, std::span<const DrawnInstance> instances,
                             const Camera& camera, nook_scene scene, const SplitLight* light) {
  draw_screen(renderer, instances, camera, NOOK_GBUFFER_AO_EXCLUDE);
  nook_world_frame_desc& frame = world_frame_;
  frame = nook::world_frame_desc();
  const glm::mat4 view = view_from_world(camera);
  std::copy_n(glm::value_ptr(view), 16, frame_.view);
  frame.scene = scene;
  frame.ao_texture = pass_.info().texture;
  if (light) {
    frame.lobes = light->soft.data();
    frame.lobe_count = std::uint32_t(light->soft.size());
    std::copy_n(light->to_sun, 3, frame.light_axis);
    frame.light_degrees = light->sun_degrees;
  }
  world_.render(frame_, frame);
  return {world_.info().texture, textures_[kDepth]};
}

std::vector<float> ScreenSpaceAo::read_red(GLuint texture) const {
  std::vector<float> values(std::size_t(width_px_) * std::size_t(height_px_));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  gl_.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values.data());
  return values;
}

std::vector<bool> ScreenSpaceAo::read_surfaces() const {
  std::vector<float> depth(std::size_t(width_px_) * std::size_t(height_px_));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, textures_[kDepth]);
  gl_.GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  std::vector<bool> surfaces;
  for (const float d : depth) surfaces.push_back(d < 1);
  return surfaces;
}

double ScreenSpaceAo::mean_count(nook_world_view view) {
  nook_world_frame_desc frame = world_frame_;
  nook_world_frame_debug_desc debug;
  nook::check(nook_world_frame_debug_desc_init(&debug));
  debug.show = view;
  frame.next = &debug;
  // The number is that of AO; the light of the last frame may be gone.
  frame.lobes = nullptr;
  frame.lobe_count = 0;
  frame.light_degrees = 0;
  world_.render(frame_, frame);
  const std::vector<float> counts = read_red(world_.info().texture);
  const std::vector<bool> there = read_surfaces();
  double sum = 0, surfaces = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (there[i]) {
      sum += 255 * double(counts[i]);
      surfaces += 1;
    }
  return sum / std::max(surfaces, 1.0);
}

double ScreenSpaceAo::rms_to_every_caster(const nook::Gl& gl) {
  nook_world_frame_desc frame = world_frame_;
  frame.lobes = nullptr;
  frame.lobe_count = 0;
  frame.light_degrees = 0;
  frame.ao_texture = 0;
  world_.render(frame_, frame);
  const std::vector<float> found = read_red(world_.info().texture);
  frame.cutoff_error = frame.level_error = 0;
  nook::WorldPass exact(gl, world_settings(width_px_, height_px_, {}));
  exact.render(frame_, frame);
  const std::vector<float> wanted = read_red(exact.info().texture);
  const std::vector<bool> there = read_surfaces();
  double sum = 0, surfaces = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (there[i]) {
      sum += double(found[i] - wanted[i]) * double(found[i] - wanted[i]);
      surfaces += 1;
    }
  return std::sqrt(sum / std::max(surfaces, 1.0));
}

ScreenAo ScreenSpaceAo::draw_screen(Renderer& renderer, std::span<const DrawnInstance> instances,
                                    const Camera& camera, nook_gbuffer_ao layer) {
  const float aspect = float(width_px_) / float(height_px_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_px_, height_px_);
  const float facing[4] = {0.5f, 0.5f, 1, 1}, open[4] = {1, 0, 0, 0}, far_plane = 1;
  gl_.ClearBufferfv(GL_COLOR, 0, facing);
  gl_.ClearBufferfv(GL_COLOR, 1, open);
  gl_.ClearBufferfv(GL_DEPTH, 0, &far_plane);
  renderer.draw_surfaces(instances, camera, aspect);
  nook_gl_frame_desc& frame = frame_;
  frame = nook::gl_frame_desc();
  frame.width = width_px_;
  frame.height = height_px_;
  frame.depth_texture = textures_[kDepth];
  frame.normal_texture = textures_[kNormals];
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  const glm::mat3 vs_from_ws(view_from_world(camera));
  const glm::mat4 projection = clip_from_view(camera, aspect);
  std::copy_n(glm::value_ptr(vs_from_ws), 9, frame.normal_matrix);
  std::copy_n(glm::value_ptr(projection), 16, frame.projection);
  desc_ = nook::nnao_frame_desc();
  desc_.radius = kRadius_m;
  frame.gbuffer_ao = layer;
  frame.gbuffer_ao_texture = textures_[kLayer];
  pass_.render(frame, desc_);
  return {pass_.info().texture, textures_[kDepth]};
}

}  // namespace crowd
