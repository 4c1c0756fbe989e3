#include "bakers/measure/nnao/edge_denoiser.h"

namespace nook::measure {
namespace {

constexpr float last_own_weight = 1.2f, earlier_own_weight = last_own_weight / 5;

}  // namespace

EdgeDenoiser::EdgeDenoiser(const GladGLContext& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      find_(gl, "edges.frag"),
      denoise_(gl, "denoise.frag"),
      edges_(gl, GL_R8, GL_RED, width, height, nullptr),
      images_{{gl, GL_R8, GL_RED, width, height, nullptr}, {gl, GL_R8, GL_RED, width, height, nullptr}} {}

void EdgeDenoiser::start(const GpuProgram& program, const GpuImage& target) const {
  gl_.Viewport(0, 0, width_, height_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl_.UseProgram(program.name());
  gl_.Uniform2i(program.at("size_px"), width_, height_);
}

void EdgeDenoiser::find_edges(const GpuView& view) {
  start(find_, edges_);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, view.depth.texture());
  gl_.Uniform1i(find_.at("depth_image"), 0);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

GLuint EdgeDenoiser::denoise(GLuint ao, int passes, float scale) {
  for (int pass = 0; pass < passes; ++pass) {
    const bool last = pass + 1 == passes;
    start(denoise_, images_[pass % 2]);
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, edges_.texture());
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, ao);
    gl_.Uniform1i(denoise_.at("ao_image"), 0);
    gl_.Uniform1i(denoise_.at("edge_image"), 1);
    gl_.Uniform1f(denoise_.at("own_weight"), last ? last_own_weight : earlier_own_weight);
    gl_.Uniform1f(denoise_.at("scale"), last ? scale : 1);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    ao = images_[pass % 2].texture();
  }
  return ao;
}

}  // namespace nook::measure
