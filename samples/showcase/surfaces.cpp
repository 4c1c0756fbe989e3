#include "samples/showcase/surfaces.h"

#include <glad/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "platform/program.h"

namespace showcase {
namespace {

const char* const vertex_glsl = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 colour;
layout(location = 4) in vec3 open;
uniform mat4 clip_from_world;
out vec3 position_ws;
out vec3 normal_ws;
out vec2 texture_uv;
out vec3 vertex_colour;
out vec3 vertex_open;
void main() {
  position_ws = position;
  normal_ws = normal;
  texture_uv = uv;
  vertex_colour = colour;
  vertex_open = open;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

// Beside the position, the shader writes a number: 1 for props, 2 or more for actors. The sky keeps 0.
const char* const fragment_glsl = R"(#version 330 core
in vec3 position_ws;
in vec3 normal_ws;
in vec2 texture_uv;
in vec3 vertex_colour;
in vec3 vertex_open;
uniform sampler2D base_colour;
uniform float number;
layout(location = 0) out vec4 place;
layout(location = 1) out vec4 facing;
layout(location = 2) out vec4 albedo;
layout(location = 3) out vec4 open_share;
layout(location = 4) out vec2 layer;
void main() {
  place = vec4(position_ws, number);
  facing = vec4(normalize(normal_ws), 1.0);
  albedo = vec4(texture(base_colour, texture_uv).rgb * vertex_colour, 1.0);
  open_share = vec4(vertex_open, 1.0);
  layer = vec2(1.0, number > 1.5 ? 1.0 : 0.0);
}
)";

enum Target { place, facing, albedo, open_share, layer, depth, target_count };
struct Format {
  GLenum internal, format, type, attachment;
};
constexpr Format formats[target_count] = {
    {GL_RGBA32F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT0},
    {GL_RGBA16F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT1},
    {GL_RGBA16F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT2},
    {GL_RGBA16F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT3},
    {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, GL_COLOR_ATTACHMENT4},
    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_DEPTH_ATTACHMENT}};

// The OpenGL objects of a frame.
class Frame {
 public:
  Frame(const GladGLContext& gl, int width_px, int height_px)
      : gl_(gl), width_(width_px), height_(height_px) {
    gl.GenTextures(target_count, textures);
    gl.GenFramebuffers(1, &framebuffer_);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.ActiveTexture(GL_TEXTURE0);
    GLenum draw[depth];
    for (std::size_t t = 0; t < target_count; ++t) {
      const Format& f = formats[t];
      gl.BindTexture(GL_TEXTURE_2D, textures[t]);
      gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(f.internal), width_, height_, 0, f.format, f.type, nullptr);
      for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, f.attachment, GL_TEXTURE_2D, textures[t], 0);
      if (t < depth) draw[t] = f.attachment;
    }
    gl.DrawBuffers(depth, draw);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("showcase: this OpenGL cannot draw into five textures of floats");
  }
  ~Frame() {
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteTextures(target_count, textures);
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  void begin() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, width_, height_);
    const float nothing[4] = {0, 0, 0, 0}, up[4] = {0, 1, 0, 0}, open[4] = {1, 0, 0, 0}, far_plane = 1;
    for (GLint t = 0; t < depth; ++t)
      gl_.ClearBufferfv(GL_COLOR, t, t == facing ? up : t == layer ? open : nothing);
    gl_.ClearBufferfv(GL_DEPTH, 0, &far_plane);
    gl_.Enable(GL_DEPTH_TEST);
  }

  std::vector<glm::vec4> read(GLuint texture) const {
    std::vector<glm::vec4> values(std::size_t(width_ * height_));
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    gl_.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, values.data());
    return values;
  }

  GLuint textures[target_count] = {};

 private:
  const GladGLContext& gl_;
  int width_, height_;
  GLuint framebuffer_ = 0;
};

// Draws meshes one after another. Fills the same buffers again for each mesh.
class MeshDrawer {
 public:
  MeshDrawer(const GladGLContext& gl, const Stage& stage)
      : gl_(gl), program_(gl, {vertex_glsl}, {fragment_glsl}), textures_(stage.textures.size() + 1) {
    gl.GenVertexArrays(1, &array_);
    gl.GenBuffers(buffer_count, buffers_);
    gl.GenTextures(GLsizei(textures_.size()), textures_.data());
    const Texture white{1, 1, {255, 255, 255}};
    for (std::size_t t = 0; t < textures_.size(); ++t)
      upload(t == 0 ? white : stage.textures[t - 1], textures_[t]);
  }
  ~MeshDrawer() {
    gl_.DeleteVertexArrays(1, &array_);
    gl_.DeleteBuffers(buffer_count, buffers_);
    gl_.DeleteTextures(GLsizei(textures_.size()), textures_.data());
  }
  MeshDrawer(const MeshDrawer&) = delete;
  MeshDrawer& operator=(const MeshDrawer&) = delete;

  void begin(const glm::mat4& clip_from_world) const {
    program_.use();
    gl_.UniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip_from_world));
    gl_.Uniform1i(program_.uniform("base_colour"), 0);
    gl_.BindVertexArray(array_);
  }

  // `open` has a value for each vertex. If it is empty, nothing is occluded.
  void draw(const Mesh& mesh, const std::vector<glm::vec3>& open, float number) const {
    gl_.Uniform1f(program_.uniform("number"), number);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, textures_[std::size_t(mesh.texture + 1)]);
    attribute(0, 3, mesh.positions_ws);
    attribute(1, 3, mesh.normals_ws);
    attribute(2, 2, mesh.uvs);
    attribute(3, 3, mesh.colours);
    attribute(4, 3, open.empty() ? std::vector<glm::vec3>(mesh.positions_ws.size(), glm::vec3(1)) : open);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[5]);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(mesh.triangles.size() * sizeof(std::uint32_t)),
                   mesh.triangles.data(), GL_STREAM_DRAW);
    gl_.DrawElements(GL_TRIANGLES, GLsizei(mesh.triangles.size()), GL_UNSIGNED_INT, nullptr);
  }

 private:
  static constexpr GLsizei buffer_count = 6;

  template <class T>
  void attribute(GLuint slot, GLint components, const std::vector<T>& values) const {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[slot]);
    gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof(T)), values.data(), GL_STREAM_DRAW);
    gl_.EnableVertexAttribArray(slot);
    gl_.VertexAttribPointer(slot, components, GL_FLOAT, GL_FALSE, 0, nullptr);
  }

  void upload(const Texture& texture, GLuint name) const {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, name);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, texture.width_px, texture.height_px, 0, GL_RGB,
                   GL_UNSIGNED_BYTE, texture.rgb.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }

  const GladGLContext& gl_;
  platform::Program program_;
  GLuint array_ = 0, buffers_[buffer_count] = {};
  std::vector<GLuint> textures_;
};

// Runs both passes as an engine does, and returns the open share of the sky on props.
std::vector<glm::vec4> nook_passes(platform::Context& context, const Stage& stage, const Cast& cast,
                                   const Frame& textures, int width_px, int height_px) {
  nook_gl_desc gl_desc = nook::gl_desc();
  gl_desc.get_proc = platform::Context::loader;
  gl_desc.get_proc_user = &context;
  const nook::Gl gl(cast.context(), gl_desc);

  nook_nnao_desc screen_desc = nook::nnao_desc(NOOK_NNAO_PRESET_BEST);
  screen_desc.max_width = width_px;
  screen_desc.max_height = height_px;
  nook_world_desc world_desc = nook::world_pass_desc();
  world_desc.max_width = width_px;
  world_desc.max_height = height_px;
  world_desc.coloured = 1;
  nook::Nnao screen(gl, screen_desc);
  nook::WorldPass world(gl, world_desc);

  const glm::mat4 view = crowd::view_from_world(stage.camera),
                  projection = crowd::clip_from_view(stage.camera, float(width_px) / float(height_px));
  const glm::mat3 view_from_normal(view);
  nook_gl_frame_desc frame = nook::gl_frame_desc();
  frame.width = width_px;
  frame.height = height_px;
  frame.depth_texture = textures.textures[depth];
  frame.normal_texture = textures.textures[facing];
  frame.normal_scale = 1;
  frame.normal_bias = 0;
  std::copy_n(glm::value_ptr(view_from_normal), 9, frame.normal_matrix);
  std::copy_n(glm::value_ptr(projection), 16, frame.projection);
  std::copy_n(glm::value_ptr(view), 16, frame.view);
  // The vertices of actors already have their occlusion.
  frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;
  frame.gbuffer_ao_texture = textures.textures[layer];
  nook_nnao_frame_desc screen_frame = nook::nnao_frame_desc();
  screen_frame.radius = stage.radius_m;
  screen.render(frame, screen_frame);

  const std::vector<nook_lobe> lobes = stage_lobes(cast.context(), stage);
  nook_world_frame_desc world_frame = nook::world_frame_desc();
  world_frame.scene = cast.scene().get();
  world_frame.ao_texture = screen.info().texture;
  world_frame.lobes = lobes.data();
  world_frame.lobe_count = std::uint32_t(lobes.size());
  world.render(frame, world_frame);
  return textures.read(world.info().texture);
}

}  // namespace

Surfaces draw_surfaces(platform::Context& context, const Stage& stage, const Cast& cast, int width_px,
                       int height_px) {
  const GladGLContext& gl = context.gl();
  const Frame frame(gl, width_px, height_px);
  const MeshDrawer drawer(gl, stage);
  frame.begin();
  drawer.begin(crowd::clip_from_world(stage.camera, float(width_px) / float(height_px)));
  for (const Mesh& prop : stage.props) drawer.draw(prop, {}, 1);
  for (std::size_t i = 0; i < cast.actors().size(); ++i)
    drawer.draw(cast.actors()[i].mesh, cast.actors()[i].directional_ao, float(i + 2));
  const std::vector<glm::vec4> world = nook_passes(context, stage, cast, frame, width_px, height_px);

  Surfaces surfaces{width_px, height_px, std::vector<Pixel>(std::size_t(width_px * height_px))};
  std::vector<Pixel>& pixels = surfaces.pixels;
  std::vector<glm::vec4> values = frame.read(frame.textures[place]);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int number = int(values[i].w + 0.5f);
    pixels[i].position_ws = glm::vec3(values[i]);
    pixels[i].kind = number == 0 ? Kind::sky : number == 1 ? Kind::prop : Kind::actor;
    pixels[i].actor = std::uint16_t(std::max(number - 2, 0));
    pixels[i].screen_open = glm::vec3(world[i]);
  }
  values = frame.read(frame.textures[facing]);
  const glm::mat4 world_from_clip =
      glm::inverse(crowd::clip_from_world(stage.camera, float(width_px) / float(height_px)));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t x = i % std::size_t(width_px), y = i / std::size_t(width_px);
    const glm::vec4 far_ws = world_from_clip * glm::vec4((2 * float(x) + 1) / float(width_px) - 1,
                                                         (2 * float(y) + 1) / float(height_px) - 1, 1, 1);
    pixels[i].normal_ws =
        glm::normalize(pixels[i].kind == Kind::sky ? glm::vec3(far_ws) / far_ws.w - stage.camera.eye_ws
                                                   : glm::vec3(values[i]));
  }
  values = frame.read(frame.textures[albedo]);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].albedo = glm::vec3(values[i]);
  values = frame.read(frame.textures[open_share]);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].directional_ao = glm::vec3(values[i]);
  return surfaces;
}

}  // namespace showcase
