#include "bakers/measure/nnao/baseline_pass.h"

namespace nook::measure {

BaselinePass::BaselinePass(const GladGLContext& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      blur_(gl, "blur.frag"),
      images_{{gl, GL_R8, GL_RED, width, height, nullptr}, {gl, GL_R8, GL_RED, width, height, nullptr}} {
  gl.GenVertexArrays(1, &vertex_array_);
  for (const Baseline baseline : all_baselines)
    programs_[baseline] = std::make_unique<GpuProgram>(gl, baseline_shader(baseline));
}

BaselinePass::~BaselinePass() {
  gl_.DeleteVertexArrays(1, &vertex_array_);
}

void BaselinePass::set_surface(const GpuProgram& program, const GpuView& view,
                               const AoRequest& request) const {
  gl_.Viewport(0, 0, width_, height_);
  gl_.BindVertexArray(vertex_array_);
  gl_.UseProgram(program.name());
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, view.normal.texture());
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, view.depth.texture());
  gl_.Uniform1i(program.at("depth_image"), 0);
  gl_.Uniform1i(program.at("normal_image"), 1);
  gl_.Uniform4f(program.at("screen_rays"), view.rays.x_scale, view.rays.x_offset, view.rays.y_scale,
                view.rays.y_offset);
  gl_.Uniform2i(program.at("size_px"), width_, height_);
  gl_.Uniform1f(program.at("radius_m"), request.radius);
  gl_.Uniform1f(program.at("max_radius_px"), request.max_radius_px);
}

GLuint BaselinePass::draw(const BaselineMethod& method, const GpuView& view, const AoRequest& request,
                          bool blurred) {
  const GpuProgram& program = *programs_.at(method.baseline);
  set_surface(program, view, request);
  const BaselineGrid grid = baseline_grid(method.baseline, method.taps);
  const BaselineTuning& tuning = method.tuning;
  gl_.Uniform1f(program.at("radius_scale"), tuning.radius_scale);
  gl_.Uniform1f(program.at("power"), tuning.power);
  gl_.Uniform1i(program.at("groups"), grid.groups);
  gl_.Uniform1i(program.at("steps"), grid.steps);
  // A baseline has one of these; the location of the others is -1, which OpenGL ignores.
  for (const char* shape : {"bias", "falloff", "thickness"}) gl_.Uniform1f(program.at(shape), tuning.shape);
  gl_.Uniform1i(program.at("equal_weights"), tuning.equal_weights);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, images_[0].framebuffer());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  return blurred ? blur(images_[0].texture(), view, request) : images_[0].texture();
}

GLuint BaselinePass::blur(GLuint ao, const GpuView& view, const AoRequest& request) {
  set_surface(blur_, view, request);
  gl_.Uniform1i(blur_.at("ao_image"), 2);
  gl_.Uniform1f(blur_.at("sharpness"), request.blur_sharpness);
  for (const bool vertical : {false, true}) {
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(GL_TEXTURE_2D, vertical ? images_[1].texture() : ao);
    gl_.Uniform2i(blur_.at("axis"), !vertical, vertical);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, images_[vertical ? 0 : 1].framebuffer());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.ActiveTexture(GL_TEXTURE0);
  return images_[0].texture();
}

}  // namespace nook::measure
