#include "material_program.h"

#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace material {
namespace {

constexpr char version[] = "#version 330 core\n";

constexpr char vertex_text[] = R"glsl(
layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent; layout(location = 3) in vec2 tiles;
uniform mat4 view_projection;
out vec3 position_ws, normal_ws, tangent_ws; out vec2 uv;
void main() {
  position_ws = position; normal_ws = normal; tangent_ws = tangent; uv = tiles;
  gl_Position = view_projection * vec4(position, 1.0);
}
)glsl";

// Between the version and this stands the material's own text.
constexpr char fragment_text[] = R"glsl(
in vec3 position_ws, normal_ws, tangent_ws; in vec2 uv;
uniform vec3 eye, key_direction, fill_direction;
uniform int pass;
out vec4 pixel;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  // The inside of a surface is its mirror image.
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 normal = side * normalize(normal_ws);
  vec3 tangent = side * normalize(tangent_ws - normal * dot(normal, tangent_ws));
  vec2 place = vec2(side * uv.x, uv.y); dx.x *= side; dy.x *= side;
  // Tangent space from world space: its rows are the axes.
  mat3 to_tangent = transpose(mat3(tangent, cross(normal, tangent), normal));
  vec3 view = to_tangent * normalize(eye - position_ws);

  float alpha = pass == 0 ? 1.0 : nook_material_visibility(nook_material_occlusion(place, dx, dy, view));
  if (pass == 1 ? alpha < 1.0 : alpha <= 0.0 || (pass == 2 && alpha >= 1.0)) discard;

  vec4 modes[NOOK_LIGHT_FOURS];
  nook_material_decode(place, dx, dy, view, modes);
  vec3 colour = nook_material_radiance(modes, to_tangent * key_direction) * vec3(4.2, 4.0, 3.7) +
                nook_material_radiance(modes, to_tangent * fill_direction) * vec3(0.5, 0.6, 0.8);
  pixel = vec4(max(colour, 0.0), alpha);
}
)glsl";

GLuint compile(const GladGLContext& gl, GLenum stage, std::initializer_list<const char*> texts) {
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, GLsizei(texts.size()), texts.begin(), nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[2048] = "";
  gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl.DeleteShader(shader);
  throw std::runtime_error(std::string("material: a shader does not compile: ") + log);
}

}  // namespace

MaterialProgram::MaterialProgram(const GladGLContext& gl, const nook::GlMaterial& material)
    : gl_(gl), textures_(material.textures()) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, {version, vertex_text});
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, {version, material.info().glsl, fragment_text});
  program_ = gl.CreateProgram();
  gl.AttachShader(program_, vertex);
  gl.AttachShader(program_, fragment);
  gl.LinkProgram(program_);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (!linked) {
    gl.DeleteProgram(program_);
    throw std::runtime_error("material: the program does not link");
  }
  gl.UseProgram(program_);
  for (std::size_t i = 0; i < textures_.size(); ++i) gl.Uniform1i(uniform(textures_[i].uniform), GLint(i));
}

MaterialProgram::~MaterialProgram() {
  gl_.DeleteProgram(program_);
}

void MaterialProgram::begin(const View& view, Pass pass) const {
  gl_.UseProgram(program_);
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(i));
    gl_.BindTexture(textures_[i].target, textures_[i].texture);
  }
  gl_.UniformMatrix4fv(uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(view.view_projection));
  gl_.Uniform3fv(uniform("eye"), 1, glm::value_ptr(view.eye));
  gl_.Uniform3fv(uniform("key_direction"), 1, glm::value_ptr(view.key_direction));
  gl_.Uniform3fv(uniform("fill_direction"), 1, glm::value_ptr(view.fill_direction));
  gl_.Uniform1i(uniform("pass"), int(pass));
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(pass != Pass::part_visible);
  if (pass == Pass::part_visible) {
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    gl_.Disable(GL_BLEND);
  }
}

}  // namespace material
