// The part of an engine that calls Nook for its characters: one model, an instance of it for each member of
// the crowd, and their evaluation on OpenGL.
#pragma once

#include <nook/experimental/nook_debug.hpp>
#include <nook/nook.hpp>
#include <span>
#include <vector>

#include "platform/platform.h"
#include "samples/crowd/crowd_renderer.h"
#include "samples/crowd/hero.h"

namespace crowd {

struct CrowdSize {
  std::uint32_t characters = 100, neighbours = 4;
  int tier = 0;  // 33, 43, or 0 for the best that the context has
};

class CrowdScene {
 public:
  // Throws if the model does not belong to the hero. The hero must outlive this object.
  CrowdScene(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
             const CrowdSize& size, const nook_scene_desc& desc = nook::scene_desc());

  // Gives all characters another model of the hero. If the model belongs to another character, throws and
  // changes nothing.
  void set_model(std::span<const unsigned char> model);
  void link_nearest(std::uint32_t neighbours);
  // Lights all characters by the same lobes from the next update on. Without lobes there is no light.
  void set_light(std::span<const nook_lobe> lobes);
  // One pose for each character.
  void set_poses(const std::vector<Bones>& poses);
  // Levels of detail follow the distance to the camera, if lod_error of the scene's descriptor is above 0. It
  // is 0 in the sample, so that all characters have full detail.
  void set_camera(const glm::vec3& eye_ws);
  // Evaluates the AO and leaves it on the GPU. `terms` (a sum of NOOK_TERM_*) selects what darkens a
  // character.
  void update(std::uint32_t terms = NOOK_TERM_ALL);
  // Returns all characters with the results of the last update. `poses` must be the poses of this update.
  std::vector<DrawnInstance> drawn(const std::vector<Bones>& poses) const;
  // The light of the last update. All characters have the same lobes and share the texture and the GLSL, so
  // the view of the first one is enough. drawn() has what differs between characters.
  nook_gl_view light() const { return gl_.view(scene_, instances_[0], NOOK_CHANNEL_DIRECTIONAL_AO); }

  nook::Scene& scene() { return scene_; }
  const nook::Scene& scene() const { return scene_; }
  const nook::Gl& gl() const { return gl_; }
  const nook::Context& context() const { return context_; }
  const nook::CharacterModel& model() const { return model_; }
  const std::vector<nook_instance_id>& instances() const { return instances_; }

 private:
  nook::CharacterModel load(std::span<const unsigned char> bytes) const;

  const Hero& hero_;
  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_;
  nook::Gl gl_;
  std::vector<nook_instance_id> instances_;
  bool lit_ = false;
};

}  // namespace crowd
