#include "samples/gltf_viewer/renderer.h"

#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace viewer {
namespace {

enum Slot : GLuint { position_slot, normal_slot, albedo_slot, joints_slot, weights_slot, ao_slot };

// Both passes draw the same depth, because gl_Position is invariant.
const char* const vertex_glsl = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;
layout(location = 5) in float ao;
uniform samplerBuffer matrices;
uniform mat4 view_from_world;
uniform mat4 clip_from_view;
uniform float ground_half_size_m;
uniform bool is_ground;
invariant gl_Position;
out vec3 surface_normal_ws, surface_albedo, surface_position_ws;
out float surface_ao;
mat4 joint_matrix(int joint) {
  int first = 4 * joint;
  return mat4(texelFetch(matrices, first), texelFetch(matrices, first + 1), texelFetch(matrices, first + 2),
              texelFetch(matrices, first + 3));
}
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1 & 1)) * 2.0 - 1.0;
  vec4 position_ws = vec4(corner.x * ground_half_size_m, 0.0, -corner.y * ground_half_size_m, 1.0);
  surface_normal_ws = vec3(0.0, 1.0, 0.0);
  surface_albedo = vec3(0.42);
  surface_ao = 1.0;
  if (!is_ground) {
    mat4 skin = weights.x * joint_matrix(int(joints.x)) + weights.y * joint_matrix(int(joints.y)) +
                weights.z * joint_matrix(int(joints.z)) + weights.w * joint_matrix(int(joints.w));
    position_ws = skin * vec4(position, 1.0);
    surface_normal_ws = mat3(skin) * normal;
    surface_albedo = albedo;
    surface_ao = ao;
  }
  surface_position_ws = position_ws.xyz;
  gl_Position = clip_from_view * (view_from_world * position_ws);
}
)";

const char* const depth_glsl = R"(#version 330 core
uniform bool is_ground;
out vec2 layer;
void main() { layer = vec2(1.0, is_ground ? 0.0 : 1.0); }
)";

// Ambient light comes from everywhere and is multiplied by AO. AO does not touch the lamp.
const char* const colour_glsl = R"(#version 330 core
in vec3 surface_normal_ws, surface_albedo, surface_position_ws;
in float surface_ao;
uniform sampler2D screen_ao;
uniform float ground_half_size_m;
out vec4 colour;
void main() {
  vec3 n = normalize(surface_normal_ws);
  float ao = surface_ao * texelFetch(screen_ao, ivec2(gl_FragCoord.xy), 0).r;
  vec3 ambient = mix(vec3(0.62, 0.60, 0.57), vec3(0.82, 0.86, 0.92), 0.5 + 0.5 * n.y);
  float lamp = 0.35 * max(dot(n, normalize(vec3(0.5, 0.8, 0.6))), 0.0);
  vec3 lit = surface_albedo * (ambient * ao + lamp);
  float far = smoothstep(0.3, 1.0, length(surface_position_ws.xz) / ground_half_size_m);
  colour = vec4(pow(mix(lit, vec3(0.40, 0.46, 0.54), far), vec3(1.0 / 2.2)), 1.0);
}
)";

const void* at(std::uint64_t offset) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset));
}

}  // namespace

Renderer::Renderer(const GladGLContext& gl, const CharacterFile& file, int width, int height)
    : gl_(gl),
      depth_program_(gl, {vertex_glsl}, {depth_glsl}),
      colour_program_(gl, {vertex_glsl}, {colour_glsl}),
      width_(width),
      height_(height),
      index_count_(GLsizei(file.triangles.size())) {
  gl.GenVertexArrays(1, &array_);
  gl.GenBuffers(3, buffers_);
  gl.BindVertexArray(array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(file.vertices.size() * sizeof(Vertex)), file.vertices.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(file.triangles.size() * sizeof(std::uint32_t)),
                file.triangles.data(), GL_STATIC_DRAW);
  for (GLuint slot = position_slot; slot <= ao_slot; ++slot) gl.EnableVertexAttribArray(slot);
  constexpr GLsizei stride = sizeof(Vertex);
  gl.VertexAttribPointer(position_slot, 3, GL_FLOAT, GL_FALSE, stride, at(offsetof(Vertex, position)));
  gl.VertexAttribPointer(normal_slot, 3, GL_FLOAT, GL_FALSE, stride, at(offsetof(Vertex, normal)));
  gl.VertexAttribPointer(albedo_slot, 3, GL_FLOAT, GL_FALSE, stride, at(offsetof(Vertex, albedo)));
  gl.VertexAttribIPointer(joints_slot, 4, GL_UNSIGNED_SHORT, stride, at(offsetof(Vertex, matrices)));
  gl.VertexAttribPointer(weights_slot, 4, GL_FLOAT, GL_FALSE, stride, at(offsetof(Vertex, weights)));
  // Until a frame brings its AO, the attribute reads a constant float from a buffer.
  gl.VertexAttribPointer(ao_slot, 1, GL_FLOAT, GL_FALSE, stride, at(offsetof(Vertex, weights)));

  gl.GenTextures(texture_count, textures_);
  gl.GenFramebuffers(2, framebuffers_);
  const struct {
    GLint internal_format;
    GLenum format, type;
  } formats[] = {{GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT},
                 {GL_RG8, GL_RG, GL_UNSIGNED_BYTE},
                 {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}};
  for (const int t : {depth_texture, layer_texture, colour_texture}) {
    gl.BindTexture(GL_TEXTURE_2D, textures_[t]);
    gl.TexImage2D(GL_TEXTURE_2D, 0, formats[t].internal_format, width, height, 0, formats[t].format,
                  formats[t].type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  }
  for (const int f : {0, 1}) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[f]);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, textures_[depth_texture], 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                            textures_[f == 0 ? layer_texture : colour_texture], 0);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("gltf_viewer: this OpenGL cannot draw RG8 and RGBA8 with 24-bit depth");
  }
}

Renderer::~Renderer() {
  gl_.DeleteFramebuffers(2, framebuffers_);
  gl_.DeleteTextures(texture_count, textures_);
  gl_.DeleteBuffers(3, buffers_);
  gl_.DeleteVertexArrays(1, &array_);
}

void Renderer::draw(const platform::Program& program) {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Viewport(0, 0, width_, height_);
  program.use();
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_BUFFER, textures_[matrix_texture]);
  gl_.Uniform1i(program.uniform("matrices"), 0);
  gl_.UniformMatrix4fv(program.uniform("view_from_world"), 1, GL_FALSE,
                       glm::value_ptr(view_.view_from_world));
  gl_.UniformMatrix4fv(program.uniform("clip_from_view"), 1, GL_FALSE, glm::value_ptr(view_.clip_from_view));
  gl_.Uniform1f(program.uniform("ground_half_size_m"), ground_half_size_m_);
  gl_.BindVertexArray(array_);
  gl_.Uniform1i(program.uniform("is_ground"), 1);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_.Uniform1i(program.uniform("is_ground"), 0);
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void Renderer::draw_depth(const Pose& pose, const View& view, float ground_half_size_m) {
  view_ = view;
  ground_half_size_m_ = ground_half_size_m;
  gl_.BindBuffer(GL_TEXTURE_BUFFER, buffers_[2]);
  gl_.BufferData(GL_TEXTURE_BUFFER, GLsizeiptr(pose.matrices.size() * sizeof(glm::mat4)),
                 pose.matrices.data(), GL_STREAM_DRAW);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_BUFFER, textures_[matrix_texture]);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffers_[2]);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
  gl_.ClearColor(1, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw(depth_program_);
}

void Renderer::draw_colour(const VertexAo& character_ao, GLuint screen_ao) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]);
  gl_.ClearColor(0.66f, 0.70f, 0.76f, 1);  // the encoded colour of the far ground
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  colour_program_.use();
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, screen_ao);
  gl_.Uniform1i(colour_program_.uniform("screen_ao"), 1);
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, character_ao.buffer);
  gl_.VertexAttribPointer(ao_slot, 1, GL_FLOAT, GL_FALSE, GLsizei(character_ao.stride),
                          at(character_ao.offset));
  draw(colour_program_);
}

void Renderer::bind_picture() const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
}

void Renderer::show(GLuint framebuffer, int width, int height) const {
  bind_picture();
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace viewer
