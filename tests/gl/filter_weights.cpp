#include "tests/gl/filter_weights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "platform/program.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/test_context.h"

namespace nook::test {
namespace {

constexpr int places = 1000;  // not a power of two, whose places would be exact

const char vertex_text[] =
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }\n";
const char fragment_text[] =
    "uniform highp sampler2D two; out vec4 value;\n"
    "void main() { value = vec4(textureLod(two, vec2(0.25 + gl_FragCoord.x / 2000.0, 0.5), 0.0).x); }\n";

}  // namespace

float filter_weight_error(const GladGLContext& gl) {
  const GLuint program =
      platform::link_program(gl, {glsl_header(gl), vertex_text}, {glsl_header(gl), fragment_text});
  Textures textures(gl);
  // Halves 0 and 1, as materials have them: of bytes llvmpipe weighs with bytes.
  const std::uint16_t halves[] = {0x0000, 0x3c00};
  const GLuint two = textures.make(GL_R16F, GL_RED, GL_HALF_FLOAT, 2, 1, halves),
               value = textures.floats(GL_RGBA32F, 4, places, 1, {});
  GLuint framebuffer = 0, vertex_array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, value, 0);
  gl.Viewport(0, 0, places, 1);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, two);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  gl.UseProgram(program);
  gl.Uniform1i(gl.GetUniformLocation(program, "two"), 0);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.UseProgram(0);
  gl.BindTexture(GL_TEXTURE_2D, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.BindVertexArray(0);
  gl.DeleteVertexArrays(1, &vertex_array);
  gl.DeleteProgram(program);
  const std::vector<float> drawn = read_texture(gl, value, places, 1);
  float largest = 0;
  for (int i = 0; i < places; ++i)
    largest = std::max(largest, std::abs(drawn[std::size_t(i)] - (float(i) + 0.5f) / float(places)));
  return largest;
}

}  // namespace nook::test
