// nook_gl_upload_bind: what it sets, what it leaves, and the programs that it refuses.
#include <cstring>
#include <string>

#include "platform/program.h"
#include "tests/gl/probe_capture_scene.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr char vertex_text[] =
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }\n";
constexpr char lobes_text[] =
    "out vec4 pixel;\n"
    "void main() { pixel = vec4(nook_probe_irradiance(nook_probe_place(vec3(0.0)), vec3(0.0, 1.0, 0.0)), "
    "1.0); }\n";
constexpr char grid_text[] =
    "out vec4 pixel;\n"
    "void main() { pixel = vec4(nook_grid_irradiance(vec3(0.0), vec3(0.0, 1.0, 0.0)), 1.0); }\n";
constexpr char plain_text[] = "out vec4 pixel;\nvoid main() { pixel = vec4(1.0); }\n";

nook_gl_upload_info described(nook_gl_upload upload) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(upload, &info));
  return info;
}

bool message_has(const char* part) {
  return std::strstr(nook_last_message(), part) != nullptr;
}

GLint integer(const GladGLContext& gl, GLenum name) {
  GLint value = -1;
  gl.GetIntegerv(name, &value);
  return value;
}

}  // namespace

TEST_CASE("an upload binds its textures and constants to a program of its kind, and refuses others") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  Fixture fixture(context);
  const Probes black = black_grid(probe::vogel_basis(12), {2, 2, 2});
  const GlProbe lobes = fixture.upload(black);
  const Grid grid = fixture.upload_grid(black, NOOK_GL_PROBE_SH);
  const nook_gl_upload_info volume = described(grid.get());
  const platform::Program lobes_program(gl, {glsl_header(gl), vertex_text},
                                        {glsl_header(gl), described(lobes.get()).glsl, lobes_text});
  const platform::Program grid_program(gl, {glsl_header(gl), vertex_text},
                                       {glsl_header(gl), volume.glsl, grid_text});
  const platform::Program plain(gl, {glsl_header(gl), vertex_text}, {glsl_header(gl), plain_text});
  GLuint sampler = 0;
  gl.GenSamplers(1, &sampler);
  gl.BindSampler(2, sampler);
  gl.UseProgram(0);
  gl.ActiveTexture(GL_TEXTURE5);

  NOOK_OK_OR_FAIL(nook_gl_upload_bind(grid.get(), grid_program.name(), 2));
  CHECK(GLuint(integer(gl, GL_CURRENT_PROGRAM)) == grid_program.name());
  // The default mode restores the unit.
  CHECK(integer(gl, GL_ACTIVE_TEXTURE) == GL_TEXTURE5);
  gl.ActiveTexture(GL_TEXTURE2);
  CHECK(GLuint(integer(gl, GL_TEXTURE_BINDING_3D)) == volume.textures[0].texture);
  CHECK(integer(gl, GL_SAMPLER_BINDING) == 0);
  GLint unit = -1;
  gl.GetUniformiv(grid_program.name(), grid_program.uniform("nook_grid_texels"), &unit);
  CHECK(unit == 2);
  float origin[4] = {-1, -1, -1, -1};
  gl.GetUniformfv(grid_program.name(), grid_program.uniform("nook_grid_frame[0]"), origin);
  CHECK(std::memcmp(origin, volume.constant_values, sizeof origin) == 0);

  gl.UseProgram(0);
  CHECK(nook_gl_upload_bind(grid.get(), lobes_program.name(), 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(
      message_has("upload of a grid of diffuse light: it has the sampler nook_probe_texels, which belongs to "
                  "a probe of lobes"));
  CHECK(nook_gl_upload_bind(lobes.get(), grid_program.name(), 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(
      message_has("upload of a probe of lobes: it has the sampler nook_grid_texels, which belongs to a grid "
                  "of diffuse light"));
  CHECK(nook_gl_upload_bind(lobes.get(), plain.name(), 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("need the sampler nook_probe_texels"));
  CHECK(nook_gl_upload_bind(lobes.get(), 0, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("not the name of a linked program"));
  CHECK(nook_gl_upload_bind(lobes.get(), lobes_program.name(), 0xffffffffu) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("first_unit is too large"));
  CHECK(nook_gl_upload_bind(nullptr, lobes_program.name(), 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(integer(gl, GL_CURRENT_PROGRAM) == 0);
  CHECK(gl.GetError() == GL_NO_ERROR);
  gl.DeleteSamplers(1, &sampler);
}
