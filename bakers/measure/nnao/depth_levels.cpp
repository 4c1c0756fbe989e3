#include "bakers/measure/nnao/depth_levels.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace nook::measure {
namespace {

constexpr int hilbert_side = 64;

// The distance along the curve from its start to a cell (D. Hilbert, 1891): the quadrants from the largest to
// the smallest, each turned so that the curve enters it where it left the one before.
float hilbert_place(int x, int y) {
  int place = 0;
  for (int half = hilbert_side / 2; half > 0; half /= 2) {
    const bool right = (x & half) != 0, up = (y & half) != 0;
    place += half * half * (up ? (right ? 2 : 1) : (right ? 3 : 0));
    if (up) continue;
    if (right) {
      x = hilbert_side - 1 - x;
      y = hilbert_side - 1 - y;
    }
    std::swap(x, y);
  }
  return float(place);
}

}  // namespace

DepthLevels::DepthLevels(const GladGLContext& gl, int width, int height)
    : gl_(gl), width_(width), height_(height), program_(gl, "depth_level.frag") {
  gl.GenTextures(1, &texture_);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, axis, GL_CLAMP_TO_EDGE);
  gl.GenFramebuffers(count, framebuffers_);
  for (int level = 0; level < count; ++level)
    gl.TexImage2D(GL_TEXTURE_2D, level, GL_R32F, std::max(width >> level, 1), std::max(height >> level, 1), 0,
                  GL_RED, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, count - 1);
  for (int level = 0; level < count; ++level) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[level]);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, level);
  }
}

DepthLevels::~DepthLevels() {
  gl_.DeleteFramebuffers(count, framebuffers_);
  gl_.DeleteTextures(1, &texture_);
}

void DepthLevels::draw(const GpuView& view, float radius_m, float falloff) {
  gl_.UseProgram(program_.name());
  gl_.Uniform1i(program_.at("finer_image"), 0);
  gl_.Uniform1f(program_.at("level_radius_m"), 0.75f * radius_m);
  gl_.Uniform1f(program_.at("falloff"), falloff);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, view.depth.texture());
  for (int level = 0; level < count; ++level) {
    gl_.Viewport(0, 0, std::max(width_ >> level, 1), std::max(height_ >> level, 1));
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[level]);
    gl_.Uniform1i(program_.at("from_host"), level == 0);
    if (level > 0) {
      // Only the level that is read is visible while the next one is drawn.
      gl_.BindTexture(GL_TEXTURE_2D, texture_);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level - 1);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
    }
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, count - 1);
}

GpuImage hilbert_image(const GladGLContext& gl) {
  std::vector<float> places;
  for (int y = 0; y < hilbert_side; ++y)
    for (int x = 0; x < hilbert_side; ++x) places.push_back(hilbert_place(x, y));
  return {gl, GL_R32F, GL_RED, hilbert_side, hilbert_side, places.data()};
}

}  // namespace nook::measure
