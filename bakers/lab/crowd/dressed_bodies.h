// Draws moving bodies in clothes on a tiled floor, under a sky. There are three kinds of pictures: without
// occlusion, with Nook's occlusion, and with irradiance that the caller computed. All three have the same
// exposure.
#pragma once

#include <span>

#include "bakers/lab/crowd/plain_look.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {

struct DressedLook {
  const Light& light;
  glm::vec2 floor_offset_m{0};  // offset of the tile pattern, to move the floor under walkers
  float ao_strength = 1;        // 0 draws without occlusion
};

class DressedBodies {
 public:
  // `parts` must outlive this object. `lights` is the GLSL text with which Nook describes the scene's view.
  DressedBodies(const GladGLContext& gl, Renderer& parts, const char* lights);

  // All functions below draw into the bound framebuffer. Set the viewport before you call them. The albedo of
  // an instance is the colour of its shirt.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const DressedLook& look,
            GLuint lobes_texture, const ScreenAo& screen_ao);
  // Draws with given irradiance. The `light` of each instance and the texture of the floor must hold
  // irradiance. Outside the texture, the floor is drawn without occlusion.
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
