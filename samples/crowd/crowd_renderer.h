// Draws skinned instances of one character on a ground plane. Nook's values come in as vertex attributes.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "platform/program.h"
#include "samples/crowd/camera.h"
#include "samples/crowd/hero.h"
#include "samples/crowd/light.h"

namespace crowd {

// Where the values of an instance's vertices are stored. Nook's views of an instance have these fields.
struct VertexSource {
  GLuint buffer = 0;  // 0 if there is none
  std::uint64_t offset = 0;
  std::uint32_t stride = sizeof(float);
};

struct DrawnInstance {
  const Bones* bones = nullptr;
  VertexSource ao;  // one float for each vertex; without a buffer the instance is fully open
  glm::vec3 albedo{0.6f};
  VertexSource light;     // three floats for each vertex: directional AO
  GLint light_texel = 0;  // first texel of the instance's light, from Nook's view
};

// The result of the screen-space pass and the world pass, for the same instances and the same camera.
struct ScreenAo {
  // 0 if no pass has run. Red is AO. Under a light, red, green and blue are the open shares of the soft
  // light, and alpha is the open share of the sun.
  GLuint texture = 0;
  GLuint depth = 0;  // single-sampled, as large as the viewport
};

// The light of a picture, and how it is shown.
struct Look {
  const Light& light;
  GLuint lobes_texture = 0;    // Nook's view of the scene's light, for characters
  const char* glsl = nullptr;  // Nook's GLSL that reads the texture
  float ao_strength = 1;
  float fog_start_m = 22;
  ScreenAo screen_ao;
};

class Renderer {
 public:
  Renderer(const GladGLContext& gl, const Hero& hero);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Draws depth, normals and the G-buffer AO of the screen-space pass into the bound framebuffer. You must
  // clear it and set the viewport before. The G-buffer AO is 1 everywhere; its weight is 1 only on
  // characters.
  void draw_surfaces(std::span<const DrawnInstance> instances, const Camera& camera, float aspect);
  // Draws into the bound framebuffer; you must set its viewport before. Characters are lit by the irradiance
  // times their directional AO, and the ground by the irradiance times look.screen_ao.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const Look& look);

  // Draw parts of a picture, with programs that use character_vertex and ground_vertex.
  void draw_characters(const platform::Program& program, std::span<const DrawnInstance> instances,
                       const glm::mat4& clip_from_ws);
  void draw_ground(const platform::Program& program, const glm::vec3& albedo, const glm::mat4& clip_from_ws);

 private:
  enum Buffer { positions, normals, joints, weights, triangles, bone_matrices, buffer_count };

  void make_character(const Hero& hero);
  void bind_values(GLuint slot, GLint components, const VertexSource& values);
  void upload_bones(std::span<const DrawnInstance> instances);
  void set_look(const platform::Program& program, const Camera& camera, const Look& look,
                const glm::vec3& background);

  const GladGLContext& gl_;
  platform::Program character_surface_, ground_surface_;
  std::optional<platform::Program> character_, ground_;  // created with the first picture, which has the GLSL
  GLsizei index_count_;
  std::size_t bone_texels_;
  GLuint arrays_[2] = {};  // character, ground
  GLuint buffers_[buffer_count] = {};
  GLuint bone_texture_ = 0;
  std::size_t chunk_ = 1;  // instances whose bones fit into one texture buffer
};

inline constexpr glm::vec3 ground_albedo{0.36f, 0.36f, 0.37f};

// The sample's shaders, for OpenGL 3.3 core. Fragment shaders write linear light to an sRGB target. Both
// vertex shaders also write surface_ao, plain AO. Only the fragment shaders of nook-lab-crowd read it; the
// fragment shaders of the sample use directional AO from surface_light. Only nook-lab-motion reads
// surface_rest_m, the position of a character's vertex in the rest pose. Characters use linear blend
// skinning. Their bones are in a texture buffer, with three texels for each bone.
extern const char* const character_vertex;
// One big quad on y = 0, made from gl_VertexID.
extern const char* const ground_vertex;
extern const char* const glsl_version;
// GLSL functions that read ScreenAo in a fragment shader. fetch_screen_light() returns all channels.
// fetch_screen_ao() returns the red channel, for nook-lab-crowd.
extern const char* const fetch_screen_glsl;

}  // namespace crowd
