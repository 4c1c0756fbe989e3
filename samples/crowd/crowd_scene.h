// Nook's side of the crowd: one model, an instance of it for each character, and their evaluation on OpenGL.
#pragma once

#include <nook/nook_gl.h>
#include <nook/experimental/nook_debug.hpp>

#include <glm/glm.hpp>
#include <nook/nook.hpp>
#include <span>
#include <vector>

#include "platform/platform.h"
#include "samples/crowd/hero.h"
#include "samples/crowd/renderer.h"

namespace crowd {

struct CrowdSceneRequest {
  std::uint32_t characters = 1, neighbours = 4;
  int tier = 0;  // 33, 43, or 0 for the best that the context has
  nook_form form = NOOK_FORM_DEFAULT;
  float lod_error = 0;  // AO, rms at 10 m from the camera; 0 keeps full detail
};

class CrowdScene {
 public:
  CrowdScene(platform::Context& context, std::span<const unsigned char> model_bytes,
             const CrowdSceneRequest& request);

  // Gives all characters another model of the same mesh and skeleton. Throws if it is of another character,
  // and then changes nothing.
  void set_model(std::span<const unsigned char> model_bytes);
  std::size_t size() const { return instances_.size(); }

  // One pose for each character, in the order of the characters.
  void set_poses(const std::vector<Bones>& poses);
  // Evaluates the AO and leaves it on the GPU. The terms (NOOK_TERM_*) are what darkens a character.
  void update(std::uint32_t terms = NOOK_TERM_ALL);
  // Levels of detail follow the distance to the camera.
  void set_camera(const glm::vec3& eye_ws);
  VertexSource ao(std::size_t character) const;
  // Waits for the GPU, so this is for reports and not for frames.
  std::vector<float> read_ao(std::size_t character) const;

  // Lights all characters by the same lobes from the next update on. Without lobes there is no light.
  void set_light(std::span<const nook_lobe> lobes);
  // The light after the last update, which needs a light to have been set before it.
  nook_gl_view light(std::size_t character) const;

  // The directional occlusion of some characters under one light, three floats for each vertex. The CPU
  // evaluates it.
  std::vector<std::vector<float>> directional_ao(std::span<const std::uint32_t> characters,
                                                 std::span<const nook_lobe> lobes);

  void link_nearest(std::uint32_t neighbours);

  // The parts of the last update, for debug views. Links are the characters that darken a character.
  nook_scene_instance_info info(std::size_t character) const;
  glm::vec3 centre_ws(std::size_t character) const;
  std::vector<nook_scene_sphere> spheres(std::size_t character) const;
  std::vector<std::uint32_t> links(std::size_t character) const;
  // Their shadows are those of the last update_on_cpu, which evaluates the poses once more.
  std::vector<nook_scene_key_point> key_points(std::size_t character) const;
  void update_on_cpu();

  nook_scene handle() const { return scene_.get(); }
  const nook::Gl& gl() const { return gl_; }
  nook_scene_info stats() const { return scene_.info(); }
  const nook::CharacterModel& model() const { return model_; }
  const nook::Context& context() const { return context_; }

 private:
  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_;
  nook::Gl gl_;
  std::vector<nook_instance_id> instances_;
};

}  // namespace crowd
