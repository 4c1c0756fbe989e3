// Coordinate textures in shaders: the GLSL against the CPU, and the contract of the C functions.
#include <nook/experimental/nook_synthesis.h>

#include <cmath>

#include "platform/program.h"
#include "sdk/src/gl/touched_state.h"
#include "sdk/src/synthesis/coordinates.h"
#include "tests/gl/material_decoder.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/material/material_sample.h"
#include "tests/synthesis/coordinates_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int count = 64;  // points, one pixel each

const char vertex_text[] =
    "void main() {\n"
    "  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
    "}\n";
const char fragment_text[] =
    "uniform highp sampler2D points;\n"
    "layout(location = 0) out vec4 value;\n"
    "void main() {\n"
    "  vec2 at = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xy;\n"
    "  value = vec4(nook_synthesis_material_uv(at), 0.0, 1.0);\n"
    "}\n";

std::vector<std::byte> sample_bytes() {
  return synthesis::write_coordinates(synthesis::test::sample_coordinates(8, 6, 4));
}

// Draws the material's coordinates of points of the plane, four floats for each.
std::vector<float> draw(const GladGLContext& gl, nook_gl_upload synthesis, const std::vector<float>& rgb) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(synthesis, &info));
  const GLuint program =
      platform::link_program(gl, {glsl_header(gl), vertex_text}, {glsl_header(gl), info.glsl, fragment_text});
  Textures images(gl);
  const GLuint points = images.floats(GL_RGB32F, 3, count, 1, rgb),
               value = images.floats(GL_RGBA32F, 4, count, 1, {});
  gl.UseProgram(program);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, info.textures[0].texture);
  gl.Uniform1i(gl.GetUniformLocation(program, "nook_synthesis_texels"), 0);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, points);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.Uniform1i(gl.GetUniformLocation(program, "points"), 1);
  GLuint framebuffer = 0, vertex_array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, value, 0);
  gl.Viewport(0, 0, count, 1);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.BindVertexArray(0);
  gl.DeleteVertexArrays(1, &vertex_array);
  gl.UseProgram(0);
  gl.BindTexture(GL_TEXTURE_2D, 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
  gl.DeleteProgram(program);
  return read_texture(gl, value, count, 1, 4);
}

}  // namespace

TEST_CASE("synthesis: the GLSL gives the points of the CPU reference") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const std::vector<std::byte> bytes = sample_bytes();
  nook_synthesis synthesis = nullptr;
  nook_gl_upload on_gpu = nullptr;
  NOOK_OK_OR_FAIL(nook_synthesis_load(fixture.host.handle, bytes.data(), bytes.size(), &synthesis));
  CHECK(nook_gl_upload_synthesis(fixture.gl, nullptr, &on_gpu) == NOOK_ERROR_INVALID_ARGUMENT);
  NOOK_OK_OR_FAIL(nook_gl_upload_synthesis(fixture.gl, synthesis, &on_gpu));
  CHECK(info_of(on_gpu).bytes == 8 * 8 * 4);
  material::test::Numbers numbers(5);
  std::vector<float> rgb, plane, wanted(2 * count);
  for (int i = 0; i < count; ++i) {
    // Up to three periods of the plane away, off the borders of texels, where rounding decides.
    const auto texel = [&] { return std::floor(numbers.between(-24, 24)) + numbers.between(0.01f, 0.99f); };
    const float u = texel() / 6, v = texel() / 4;
    rgb.insert(rgb.end(), {u, v, 0});
    plane.insert(plane.end(), {u, v});
  }
  NOOK_OK_OR_FAIL(nook_synthesis_material_uvs(synthesis, plane.data(), count, wanted.data()));
  const std::vector<float> drawn = draw(context.gl(), on_gpu, rgb);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      INFO("point " << i);
      // Coordinates of up to 6 tiles, a few roundings of floats.
      CHECK(drawn[4 * i + k] == Approx(wanted[2 * i + k]).margin(1e-5));
    }
  nook_gl_upload_destroy(&on_gpu);
  nook_synthesis_destroy(&synthesis);
}

TEST_CASE("synthesis: uploading coordinates keeps the promises on OpenGL state") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = sample_bytes();
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS}) {
    MaterialFixture fixture(context, mode);
    nook_synthesis synthesis = nullptr;
    nook_gl_upload on_gpu = nullptr;
    NOOK_OK_OR_FAIL(nook_synthesis_load(fixture.host.handle, bytes.data(), bytes.size(), &synthesis));
    {
      Poison poison(context, gl::materials);
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      NOOK_OK_OR_FAIL(nook_gl_upload_synthesis(fixture.gl, synthesis, &on_gpu));
      CHECK(poison.untouched() == untouched);
      if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
      if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
    }
    nook_gl_upload_destroy(&on_gpu);
    nook_synthesis_destroy(&synthesis);
  }
}
