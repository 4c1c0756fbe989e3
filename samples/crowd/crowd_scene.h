// Nook's side of the crowd: one model, an instance for each character, evaluated through OpenGL.
#pragma once

#include <nook/nook_gl.h>
#include <nook/nook.hpp>
#include <span>
#include <vector>

#include "platform/platform.h"
#include "samples/crowd/hero.h"
#include "samples/crowd/renderer.h"

namespace crowd {

struct CrowdSceneRequest {
  std::uint32_t characters = 1, neighbours = 4;
  int tier = 0;  // 0: the best that the context has
  nook_combine combine = NOOK_COMBINE_COMPOSED;
};

class CrowdScene {
 public:
  CrowdScene(platform::Context& context, std::span<const unsigned char> model_bytes,
             const CrowdSceneRequest& request);

  // One pose for each character, in their order.
  void set_poses(const std::vector<Bones>& poses);
  // terms: NOOK_TERM_*, which casters count. Leaves the AO on the GPU.
  void update(std::uint32_t terms = NOOK_TERM_ALL);
  AoSource ao(std::size_t character) const;
  // Waits for the GPU: for reports, not for frames.
  std::vector<float> read_ao(std::size_t character) const;

  // Lights all characters by the same lobes from the next update on; none: no light.
  void set_light(std::span<const nook_probe_lobe> lobes);
  // Of the last update, which saw a light.
  nook_gl_light_view light(std::size_t character) const;

  // Directional occlusion of some characters under one light, three floats a vertex, evaluated on the CPU.
  std::vector<std::vector<float>> directional_ao(std::span<const std::uint32_t> characters,
                                                 std::span<const nook_probe_lobe> lobes);

  void link_nearest(std::uint32_t neighbours);
  nook_gl_info gl_info() const;
  nook_gl gl() const { return gl_.get(); }
  nook_scene_stats stats() const { return scene_.stats(); }
  const nook::CharacterModel& model() const { return model_; }
  const nook::Context& context() const { return context_; }

 private:
  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_;
  nook::Unique<nook_gl, nook_gl_destroy> gl_;
  std::vector<nook_instance_id> instances_;
};

}  // namespace crowd
