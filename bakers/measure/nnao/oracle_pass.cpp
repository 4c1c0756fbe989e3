#include "bakers/measure/nnao/oracle_pass.h"

namespace nook::measure {

const char* oracle_name(Oracle oracle) {
  return oracle == Oracle::solid ? "oracle" : "oracle_bitmask";
}

OraclePass::OraclePass(const GladGLContext& gl, int width, int height)
    : gl_(gl),
      program_(gl, embedded_shaders(), "oracle.frag"),
      image_(gl, GL_R8, GL_RED, width, height, nullptr) {
  gl.GenVertexArrays(1, &vertex_array_);
}

OraclePass::~OraclePass() {
  gl_.DeleteVertexArrays(1, &vertex_array_);
}

GLuint OraclePass::draw(Oracle oracle, const GpuView& view, float radius) const {
  gl_.Viewport(0, 0, view.width, view.height);
  gl_.BindVertexArray(vertex_array_);
  gl_.UseProgram(program_.name());
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, view.normal.texture());
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, view.depth.texture());
  gl_.Uniform1i(program_.at("depth_image"), 0);
  gl_.Uniform1i(program_.at("normal_image"), 1);
  gl_.Uniform4f(program_.at("screen_rays"), view.rays.x_scale, view.rays.x_offset, view.rays.y_scale,
                view.rays.y_offset);
  gl_.Uniform2i(program_.at("size_px"), view.width, view.height);
  gl_.Uniform1f(program_.at("radius_m"), radius);
  gl_.Uniform1f(program_.at("thickness"), oracle == Oracle::solid ? 0.0f : 0.5f);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, image_.framebuffer());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  return image_.texture();
}

}  // namespace nook::measure
