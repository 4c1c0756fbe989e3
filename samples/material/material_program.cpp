#include "samples/material/material_program.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

namespace material {
namespace {

constexpr char version[] = "#version 330 core\n";

constexpr char vertex_text[] = R"glsl(
layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent; layout(location = 3) in vec2 tiles;
uniform mat4 view_projection;
out vec3 position_ws, normal_ws, tangent_ws; out vec2 uv;
invariant gl_Position;
void main() {
  position_ws = position; normal_ws = normal; tangent_ws = tangent; uv = tiles;
  gl_Position = view_projection * vec4(position, 1.0);
}
)glsl";

// The material's GLSL is inserted between the version and this text.
constexpr char fragment_text[] = R"glsl(
in vec3 position_ws, normal_ws, tangent_ws; in vec2 uv;
uniform vec3 eye, key_direction, fill_direction;
out vec4 pixel;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  // The inside of a surface is the mirror image of its outside.
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 normal = side * normalize(normal_ws);
  vec3 tangent = side * normalize(tangent_ws - normal * dot(normal, tangent_ws));
  vec2 place = vec2(side * uv.x, uv.y); dx.x *= side; dy.x *= side;
  // The rows of the matrix from world space to tangent space are the axes.
  mat3 to_tangent = transpose(mat3(tangent, cross(normal, tangent), normal));
  vec3 view = to_tangent * normalize(eye - position_ws);
  float alpha = 1.0;
#if PASS != COLOUR
#if FETCHES == 0
  alpha = nook_material_visibility(nook_material_occlusion(place, dx, dy, view));
#else
  alpha = nook_material_visibility(nook_material_occlusion_anisotropic(place, dx, dy, view, FETCHES));
#endif
#endif
#if PASS == DEPTH
  if (alpha < 1.0) discard;
  pixel = vec4(0.0);
#else
#if PASS == PART_VISIBLE
  if (alpha <= 0.0 || alpha >= 1.0) discard;
#endif
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
#if FETCHES == 0
  nook_material_decode(place, dx, dy, view, modes);
#else
  nook_material_decode_anisotropic(place, dx, dy, view, FETCHES, modes);
#endif
  vec3 colour = nook_material_radiance(modes, to_tangent * key_direction) * vec3(4.2, 4.0, 3.7) +
                nook_material_radiance(modes, to_tangent * fill_direction) * vec3(0.5, 0.6, 0.8);
  pixel = vec4(max(colour, 0.0), alpha);
#endif
}
)glsl";

constexpr char pass_names[] = "#define DEPTH 0\n#define COLOUR 1\n#define PART_VISIBLE 2\n";
constexpr const char* pass_choice[] = {"#define PASS DEPTH\n", "#define PASS COLOUR\n",
                                       "#define PASS PART_VISIBLE\n"};

}  // namespace

MaterialProgram::MaterialProgram(const GladGLContext& gl, const nook::Upload& material, std::uint32_t fetches)
    : gl_(gl), material_(material) {
  const std::string fetch_count = "#define FETCHES " + std::to_string(fetches) + "\n";
  for (const char* choice : pass_choice) {
    programs_.emplace_back(
        gl, std::initializer_list<const char*>{version, vertex_text},
        std::initializer_list<const char*>{version, pass_names, choice, fetch_count.c_str(),
                                           material.info().glsl, fragment_text});
  }
}

// Without a VOTF, the depth pass reads no texture of the material, and nook_gl_upload_bind fails for a
// program that uses no sampler of the upload.
bool MaterialProgram::samples_material(const platform::Program& program) const {
  const nook_gl_upload_info info = material_.info();
  const auto first = info.textures, last = info.textures + info.texture_count;
  return std::any_of(first, last, [&](const nook_gl_upload_texture& texture) {
    return program.uniform(texture.uniform) >= 0;
  });
}

void MaterialProgram::begin(const View& view, Pass pass) const {
  const platform::Program& program = programs_[std::size_t(pass == Pass::whole ? Pass::colour : pass)];
  if (samples_material(program))
    material_.bind(program.name(), 0);
  else
    gl_.UseProgram(program.name());
  gl_.UniformMatrix4fv(program.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(view.view_projection));
  gl_.Uniform3fv(program.uniform("eye"), 1, glm::value_ptr(view.eye));
  gl_.Uniform3fv(program.uniform("key_direction"), 1, glm::value_ptr(view.key_direction));
  gl_.Uniform3fv(program.uniform("fill_direction"), 1, glm::value_ptr(view.fill_direction));

  const bool writes_colour = pass != Pass::depth, writes_depth = pass == Pass::depth || pass == Pass::whole;
  const auto mask = GLboolean(writes_colour);
  gl_.ColorMask(mask, mask, mask, mask);
  gl_.DepthMask(GLboolean(writes_depth));
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(pass == Pass::colour ? GL_EQUAL : GL_LESS);
  if (pass == Pass::part_visible) {
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    gl_.Disable(GL_BLEND);
  }
}

}  // namespace material
