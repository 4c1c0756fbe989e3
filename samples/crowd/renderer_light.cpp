// Drawing with light that is not the renderer's own: given irradiance, and a probe with Nook's occlusion of
// it.
#include <glm/gtc/type_ptr.hpp>

#include "samples/crowd/renderer.h"
#include "samples/crowd/shaders.h"

namespace crowd {

void Renderer::draw_given_light(std::span<const DrawnInstance> instances, const Camera& camera,
                                const GivenLight& light) {
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ClearColor(light.background.r, light.background.g, light.background.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const glm::mat4 view = clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
  gl_.ActiveTexture(GL_TEXTURE4);
  gl_.BindTexture(GL_TEXTURE_2D, light.floor.texture);
  for (const GpuProgram* program : {&ground_given_light_, &character_given_light_}) {
    program->use();
    gl_.Uniform1i(program->uniform("floor_light"), 4);
    gl_.Uniform1i(program->uniform("use_floor_light"), program == &ground_given_light_);
    gl_.Uniform2fv(program->uniform("floor_first_m"), 1, glm::value_ptr(light.floor.first_m));
    gl_.Uniform2fv(program->uniform("floor_extent_m"), 1, glm::value_ptr(light.floor.extent_m));
    gl_.Uniform1f(program->uniform("exposure"), light.exposure);
    gl_.Uniform3fv(program->uniform("background"), 1, glm::value_ptr(light.background));
  }
  if (light.floor.texture) draw_ground(ground_given_light_, glm::vec3(0.5f), view);
  draw_characters(character_given_light_, instances, view);
}

// All that an engine does with Nook's lights: their texture, and for each instance its number and its
// directional AO.
void Renderer::draw_probe_light(std::span<const DrawnInstance> instances, const Camera& camera,
                                const ProbeLight& light) {
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  if (!character_probe_light_) {
    character_probe_light_ = std::make_unique<GpuProgram>(
        gl_, kCharacterVertex,
        std::initializer_list<const char*>{kVersion, light.glsl, kScreenAo, kProbeLightFragment});
    ground_probe_light_ = std::make_unique<GpuProgram>(
        gl_, kGroundVertex,
        std::initializer_list<const char*>{kVersion, "#define GROUND\n", light.glsl, kScreenAo,
                                           kProbeLightFragment});
  }
  gl_.Enable(GL_DEPTH_TEST);
  const glm::vec3 background = 1.0f - glm::exp(-light.exposure * light.horizon);
  gl_.ClearColor(background.r, background.g, background.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const glm::mat4 view = clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
  const struct {
    GLenum unit, target;
    GLuint texture;
  } textures[] = {{GL_TEXTURE2, GL_TEXTURE_2D, light.screen_ao.texture},
                  {GL_TEXTURE3, GL_TEXTURE_2D, light.screen_ao.depth},
                  {GL_TEXTURE4, GL_TEXTURE_2D, light.floor.texture},
                  {GL_TEXTURE5, GL_TEXTURE_BUFFER, light.texture}};
  for (const auto& t : textures) {
    gl_.ActiveTexture(t.unit);
    gl_.BindTexture(t.target, t.texture);
  }
  for (const GpuProgram* program : {ground_probe_light_.get(), character_probe_light_.get()}) {
    program->use();
    gl_.Uniform1i(program->uniform("screen_ao"), 2);
    gl_.Uniform1i(program->uniform("screen_depth"), 3);
    gl_.Uniform1i(program->uniform("floor_light"), 4);
    gl_.Uniform1i(program->uniform("nook_scene_lights"), 5);
    gl_.Uniform3fv(program->uniform("ground_irradiance"), 1, glm::value_ptr(light.ground_irradiance));
    gl_.Uniform2fv(program->uniform("floor_first_m"), 1, glm::value_ptr(light.floor.first_m));
    gl_.Uniform2fv(program->uniform("floor_extent_m"), 1, glm::value_ptr(light.floor.extent_m));
    gl_.Uniform1i(program->uniform("use_screen_ao"), light.screen_ao.texture != 0);
    gl_.Uniform1f(program->uniform("ao_strength"), light.ao_strength);
    gl_.Uniform1f(program->uniform("exposure"), light.exposure);
    gl_.Uniform1f(program->uniform("fog_start_m"), light.fog_start_m);
    gl_.Uniform3fv(program->uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
    gl_.Uniform3fv(program->uniform("background"), 1, glm::value_ptr(background));
  }
  draw_ground(*ground_probe_light_, light.ground_albedo, view);
  draw_characters(*character_probe_light_, instances, view);
}

}  // namespace crowd
