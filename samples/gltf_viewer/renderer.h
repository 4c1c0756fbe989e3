// Draws a skinned character on a ground plane, in ambient light and one lamp.
#pragma once

#include <glad/gl.h>

#include "platform/program.h"
#include "samples/gltf_viewer/viewed_character.h"

namespace viewer {

struct View {
  glm::mat4 view_from_world, clip_from_view;
};

// Where the AO of the vertices is stored: one float for each vertex.
struct VertexAo {
  GLuint buffer = 0;
  std::uint64_t offset = 0;
  std::uint32_t stride = 0;
};

class Renderer {
 public:
  Renderer(const GladGLContext& gl, const CharacterFile& file, int width, int height);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Call this first. It draws depth, and the G-buffer AO for the screen pass, which is (1, 1) on the
  // character and (1, 0) elsewhere.
  void draw_depth(const Pose& pose, const View& view, float ground_half_size_m);
  GLuint depth() const { return textures_[depth_texture]; }
  GLuint layer() const { return textures_[layer_texture]; }
  // Then call this. It draws the colours, with both kinds of AO.
  void draw_colour(const VertexAo& character_ao, GLuint screen_ao);
  // Binds the framebuffer with the colours for reading.
  void bind_picture() const;
  void show(GLuint framebuffer, int width, int height) const;

 private:
  enum { depth_texture, layer_texture, colour_texture, matrix_texture, texture_count };
  void draw(const platform::Program& program);

  const GladGLContext& gl_;
  platform::Program depth_program_, colour_program_;
  int width_, height_;
  GLsizei index_count_;
  GLuint array_ = 0, buffers_[3] = {}, textures_[texture_count] = {}, framebuffers_[2] = {};
  View view_;
  float ground_half_size_m_ = 1;
};

}  // namespace viewer
