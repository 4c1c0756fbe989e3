// The characters of a stage in their poses, and everything of the showcase that calls Nook's runtime.
#pragma once

#include <nook/nook.hpp>
#include <nook/nook_bake.hpp>
#include <vector>

#include "samples/showcase/stage.h"

namespace showcase {

// A posed character: its triangles in world space, and the values that Nook computes for its vertices.
struct PosedActor {
  Mesh mesh;
  std::vector<glm::vec3> directional_ao;  // the open share of each colour of the light, per vertex
};

// Returns the lobes of a probe of the sky at a place. The walls of the stage hide parts of the sky.
std::vector<nook_lobe> probe_of_sky(const nook::Context& context, const Stage& stage,
                                    const glm::vec3& place_ws);
// The probe that lights the props.
std::vector<nook_lobe> stage_lobes(const nook::Context& context, const Stage& stage);
glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction);

// Returns the colour of the built-in character's clothes at a vertex, by its position in the rest pose.
glm::vec3 clothes(const glm::vec3& rest_m, const glm::vec3& shirt);

class Cast {
 public:
  // Reads, poses and lights all actors of the stage, and adds their textures to it.
  explicit Cast(Stage& stage);

  const nook::Context& context() const { return context_; }
  const nook::Scene& scene() const { return scene_; }
  const std::vector<PosedActor>& actors() const { return actors_; }
  // The probe at each actor.
  const std::vector<std::vector<nook_lobe>>& lobes() const { return lobes_; }

 private:
  nook::Context context_;
  nook::Scene scene_{context_};
  std::vector<nook::CharacterModel> models_;
  std::vector<PosedActor> actors_;
  std::vector<std::vector<nook_lobe>> lobes_;
};

}  // namespace showcase
