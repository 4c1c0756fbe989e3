#include "samples/crowd/panels.h"

#include <glad/gl.h>

namespace crowd {
namespace {

namespace measure = nook::measure::crowd;

const glm::vec3 kAlbedo(0.72f);

Camera camera_of(const measure::Group& group) {
  return {group.view.eye_ws, group.view.target_ws, group.view.fov_rad};
}

// A vertex buffer with the values of all members of a group, one after the other.
class VertexBuffer {
 public:
  VertexBuffer(const GladGLContext& gl, const measure::VertexValues& values, std::uint32_t channels)
      : gl_(gl) {
    if (values.empty()) return;
    gl.GenBuffers(1, &buffer_);
    std::vector<float> all;
    for (const std::vector<float>& member : values) {
      sources_.push_back({buffer_, all.size() * sizeof(float), channels * std::uint32_t(sizeof(float))});
      all.insert(all.end(), member.begin(), member.end());
    }
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
    gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(all.size() * sizeof(float)), all.data(), GL_STREAM_DRAW);
  }
  ~VertexBuffer() { gl_.DeleteBuffers(1, &buffer_); }
  VertexBuffer(const VertexBuffer&) = delete;
  VertexBuffer& operator=(const VertexBuffer&) = delete;

  // No buffer if there are no values.
  AoSource source(std::size_t member) const { return sources_.empty() ? AoSource{} : sources_[member]; }

 private:
  const GladGLContext& gl_;
  GLuint buffer_ = 0;
  std::vector<AoSource> sources_;
};

// A texture that lies on the floor.
class FloorTexture {
 public:
  FloorTexture(const GladGLContext& gl, const measure::FloorValues& floor, std::uint32_t channels) : gl_(gl) {
    const measure::FloorPatch& patch = floor.patch;
    // The centres of texels lie on the patch's points, so the texture is wider by half a texel on each side.
    const float texel_m = patch.size_m / float(patch.side - 1);
    floor_.first_m = glm::vec2(patch.low_x_m, patch.low_z_m) - 0.5f * texel_m;
    floor_.extent_m = glm::vec2(patch.size_m + texel_m);
    gl.GenTextures(1, &floor_.texture);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, floor_.texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    gl.TexImage2D(GL_TEXTURE_2D, 0, channels == 3 ? GL_RGB32F : GL_R16F, GLsizei(patch.side),
                  GLsizei(patch.side), 0, channels == 3 ? GL_RGB : GL_RED, GL_FLOAT, floor.values.data());
  }
  ~FloorTexture() { gl_.DeleteTextures(1, &floor_.texture); }
  FloorTexture(const FloorTexture&) = delete;
  FloorTexture& operator=(const FloorTexture&) = delete;

  const FloorAo& floor() const { return floor_; }

 private:
  const GladGLContext& gl_;
  FloorAo floor_;
};

Look panel_look() {
  Look look;
  look.key_strength = 0.16f;  // the light is mostly ambient, so that AO is what the picture shows
  look.ground_albedo = glm::vec3(0.5f);
  look.background = glm::vec3(0.62f);
  look.fog_start_m = 14;
  return look;
}

}  // namespace

std::vector<DrawnInstance> Panels::instances_of(const measure::Group& group) const {
  std::vector<DrawnInstance> drawn;
  for (const std::uint32_t member : group.members) drawn.push_back({&poses_[member], {}, kAlbedo, {}, 0});
  return drawn;
}

platform::Image Panels::draw(const measure::Group& group, const measure::AoPanel& panel) {
  const GladGLContext& gl = stage_.context.gl();
  const VertexBuffer ao(gl, panel.ao, 1);
  std::vector<DrawnInstance> drawn = instances_of(group);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].ao = ao.source(i);
  std::optional<FloorTexture> floor;
  if (panel.floor_ao) floor.emplace(gl, *panel.floor_ao, 1);
  const Camera camera = camera_of(group);
  Look look = panel_look();
  if (floor) look.floor_ao = floor->floor();
  if (panel.screen_space != measure::ScreenSpace::kNowhere)
    look.screen_ao = stage_.screen_space->draw(stage_.renderer, drawn, camera,
                                               panel.screen_space == measure::ScreenSpace::kEverywhere
                                                   ? NOOK_NNAO_LAYER_NONE
                                                   : NOOK_NNAO_LAYER_REPLACE);
  stage_.target.bind();
  stage_.renderer.draw(drawn, camera, look, camera.target_ws, 6.0f);
  return stage_.target.read();
}

platform::Image Panels::draw(const measure::Group& group, const measure::IrradiancePanel& panel) {
  const GladGLContext& gl = stage_.context.gl();
  const VertexBuffer irradiance(gl, panel.irradiance, 3);
  std::vector<DrawnInstance> drawn = instances_of(group);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].light = irradiance.source(i);
  const FloorTexture floor(gl, panel.floor, 3);
  GivenLight light;
  light.exposure = panel.exposure;
  light.floor = floor.floor();
  stage_.target.bind();
  stage_.renderer.draw_given_light(drawn, camera_of(group), light);
  return stage_.target.read();
}

}  // namespace crowd
