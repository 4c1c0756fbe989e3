// Draws moving bodies in clothes on a tiled floor, under a sky: without occlusion, with Nook's, or with given
// irradiance. All three pictures have the same exposure.
#pragma once

#include <span>

#include "bakers/lab/crowd/plain_look.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {

struct DressedLook {
  const Light& light;
  glm::vec2 floor_offset_m{0};  // where the tiles begin: a floor that moves under walkers
  float ao_strength = 1;        // 0 draws without occlusion
};

class DressedBodies {
 public:
  // parts must outlive this object. lights is the GLSL of the scene's view, which Nook returns.
  DressedBodies(const GladGLContext& gl, Renderer& parts, const char* lights);

  // All pictures go into the bound framebuffer, whose viewport must be set. The instances' albedo is the
  // colour of the shirt.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const DressedLook& look,
            GLuint lobes_texture, const ScreenAo& screen_ao);
  // The instances' light is irradiance, and so is the floor's texture. Outside the texture the floor is open.
  void draw_given(std::span<const DrawnInstance> instances, const Camera& camera, const DressedLook& look,
                  const FloorTexture& irradiance);

 private:
  glm::mat4 begin(const Camera& camera, const DressedLook& look);
  void set_look(const platform::Program& program, const Camera& camera, const DressedLook& look);

  const GladGLContext& gl_;
  Renderer& parts_;
  platform::Program character_, ground_, given_character_, given_ground_;
  glm::vec3 background_{0};
};

}  // namespace crowd::lab
