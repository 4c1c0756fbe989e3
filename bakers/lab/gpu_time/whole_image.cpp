#include "bakers/lab/gpu_time/whole_image.h"

#include "platform/program.h"

namespace nook::lab {
namespace {

const char header_text[] = "#version 330 core\n";
const char vertex_text[] =
    "out vec2 at;\n"
    "void main() {\n"
    "  at = vec2(gl_VertexID == 1 ? 2 : 0, gl_VertexID == 2 ? 2 : 0);\n"
    "  gl_Position = vec4(2.0 * at - 1.0, 0, 1);\n"
    "}\n";

}  // namespace

WholeImage::WholeImage(const GladGLContext& gl, int width, int height, const std::string& functions,
                       const std::string& body)
    : gl_(gl), width_(width), height_(height), target_(gl, GL_RGBA16F, GL_RGBA, width, height, nullptr) {
  const std::string main_text = "in vec2 at; out vec4 result;\nvoid main() {\n  vec3 colour;\n" + body +
                                "  result = vec4(colour, 1.0);\n}\n";
  program_ = platform::link_program(gl, {header_text, vertex_text},
                                    {header_text, functions.c_str(), main_text.c_str()});
  gl.GenVertexArrays(1, &vertex_array_);
}

WholeImage::~WholeImage() {
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteProgram(program_);
}

void WholeImage::bind(GLenum target, GLuint texture, const char* uniform) {
  gl_.UseProgram(program_);
  gl_.ActiveTexture(GL_TEXTURE0 + GLenum(units_));
  gl_.BindTexture(target, texture);
  gl_.Uniform1i(gl_.GetUniformLocation(program_, uniform), units_++);
  gl_.ActiveTexture(GL_TEXTURE0);
}

void WholeImage::draw() const {
  gl_.UseProgram(program_);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
  gl_.Viewport(0, 0, width_, height_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace nook::lab
