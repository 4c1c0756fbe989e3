#include "bakers/lab/nnao/baseline_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nook::lab {

using namespace measure;

namespace {

constexpr int hilbert_side = 64;

// Returns the distance from the start of the Hilbert curve to a cell, measured along the curve (D. Hilbert,
// 1891). The loop goes from the largest quadrants to the smallest. It rotates each quadrant so that the curve
// enters it where the curve left the previous one.
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
    : gl_(gl), width_(width), height_(height), program_(gl, baseline_shaders(), "depth_level.frag") {
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
      // While a level is drawn, the shader may sample only the level before it.
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

namespace {

constexpr float last_own_weight = 1.2f, earlier_own_weight = last_own_weight / 5;

}  // namespace

EdgeDenoiser::EdgeDenoiser(const GladGLContext& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      find_(gl, baseline_shaders(), "edges.frag"),
      denoise_(gl, baseline_shaders(), "denoise.frag"),
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

namespace {

// Before its denoiser, XeGTAO's AO may exceed 1. The shader divides by this factor, so that the value fits
// the texture.
constexpr float headroom = 1.5f;

}  // namespace

BaselinePass::BaselinePass(const GladGLContext& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      blur_(gl, baseline_shaders(), "blur.frag"),
      box_(gl, baseline_shaders(), "box.frag"),
      disc_(gl, baseline_shaders(), "disc.frag"),
      gaussian_(gl, baseline_shaders(), "gaussian.frag"),
      images_{{gl, GL_R8, GL_RED, width, height, nullptr}, {gl, GL_R8, GL_RED, width, height, nullptr}},
      edge_denoiser_(gl, width, height),
      depth_levels_(gl, width, height),
      hilbert_(hilbert_image(gl)) {
  gl.GenVertexArrays(1, &vertex_array_);
  gl.GenFramebuffers(1, &with_edges_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, with_edges_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, images_[0].texture(), 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D,
                          edge_denoiser_.edge_image().texture(), 0);
  const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl.DrawBuffers(2, targets);
}

BaselinePass::~BaselinePass() {
  gl_.DeleteFramebuffers(1, &with_edges_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
}

const GpuProgram& BaselinePass::program(const BaselineMethod& method, const std::string& more_defines) {
  const std::string path = baseline_shader(method.baseline),
                    defines = baseline_defines(method) + more_defines;
  std::unique_ptr<GpuProgram>& made = programs_[path + "\n" + defines];
  if (!made) made = std::make_unique<GpuProgram>(gl_, baseline_shaders(), path, defines);
  return *made;
}

void BaselinePass::set_surface(const GpuProgram& program, const GpuView& view,
                               const AoRequest& request) const {
  gl_.Viewport(0, 0, width_, height_);
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

void BaselinePass::draw_raw(const BaselineMethod& method, const GpuView& view, const AoRequest& request) {
  const GpuProgram& shader = program(method);
  set_surface(shader, view, request);
  const BaselineGrid grid = baseline_grid(method.baseline, method.taps);
  const BaselineTuning& tuning = method.tuning;
  gl_.Uniform1f(shader.at("radius_scale"), tuning.radius_scale);
  gl_.Uniform1f(shader.at("power"), tuning.power);
  gl_.Uniform1i(shader.at("groups"), grid.groups);
  gl_.Uniform1i(shader.at("steps"), grid.steps);
  // The shader of a baseline has at most one of these uniforms. The locations of the others are -1, and
  // OpenGL ignores -1.
  for (const char* shape : {"bias", "falloff", "thickness", "threshold"})
    gl_.Uniform1f(shader.at(shape), tuning.shape);
  gl_.Uniform2f(shader.at("bias_turn"), std::cos(tuning.shape), std::sin(tuning.shape));
  gl_.Uniform1i(shader.at("equal_weights"), tuning.equal_weights);
  gl_.Uniform1f(shader.at("strength"), tuning.strength);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, images_[0].framebuffer());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void BaselinePass::draw_xegtao(const GpuProgram& shader, const BaselineMethod& method, const GpuView& view,
                               const AoRequest& request, float scale, GLuint framebuffer) {
  const BaselineTuning& tuning = method.tuning;
  depth_levels_.draw(view, tuning.radius_scale * request.radius, tuning.shape);
  set_surface(shader, view, request);
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, hilbert_.texture());
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, depth_levels_.texture());
  gl_.Uniform1i(shader.at("depth_levels"), 0);
  gl_.Uniform1i(shader.at("hilbert_image"), 2);
  gl_.Uniform2f(shader.at("texel"), 1 / float(width_), 1 / float(height_));
  gl_.Uniform1f(shader.at("radius_scale"), tuning.radius_scale);
  gl_.Uniform1f(shader.at("power"), tuning.power);
  gl_.Uniform1i(shader.at("groups"), baseline_grid(method.baseline, method.taps).groups);
  gl_.Uniform1f(shader.at("falloff"), tuning.shape);
  gl_.Uniform1f(shader.at("thin"), tuning.thin);
  gl_.Uniform1f(shader.at("output_scale"), scale);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

BaselinePass::BentImage BaselinePass::draw_bent(const BaselineMethod& xegtao, const GpuView& view,
                                                const AoRequest& request) {
  gl_.BindVertexArray(vertex_array_);
  const GpuImage bent(gl_, GL_RGBA32F, GL_RGBA, width_, height_, nullptr);
  GLuint framebuffer = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const GLuint images[] = {images_[0].texture(), edge_denoiser_.edge_image().texture(), bent.texture()};
  const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  for (std::size_t i = 0; i < 3; ++i)
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, targets[i], GL_TEXTURE_2D, images[i], 0);
  gl_.DrawBuffers(3, targets);
  draw_xegtao(program(xegtao, "#define NOOK_BENT_NORMALS\n"), xegtao, view, request, 1, framebuffer);
  gl_.DeleteFramebuffers(1, &framebuffer);
  BentImage image;
  image.edges = read_red(gl_, edge_denoiser_.edge_image().texture(), width_, height_);
  const std::vector<float> rgba = read_rgba(gl_, bent.texture(), width_, height_);
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    image.bent_normal.push_back({rgba[i], rgba[i + 1], rgba[i + 2]});
  return image;
}

GLuint BaselinePass::draw(const BaselineMethod& method, const GpuView& view, const AoRequest& request,
                          bool denoised) {
  gl_.BindVertexArray(vertex_array_);
  const Denoiser denoiser = method.tuning.denoiser;
  if (method.baseline == Baseline::xegtao) {
    const bool by_edges = denoised && edge_passes(denoiser) > 0;
    draw_xegtao(program(method), method, view, request, by_edges ? 1 / headroom : 1, with_edges_);
    if (by_edges) return edge_denoiser_.denoise(images_[0].texture(), edge_passes(denoiser), headroom);
  } else {
    draw_raw(method, view, request);
  }
  return denoised ? denoise(images_[0].texture(), view, request, denoiser) : images_[0].texture();
}

GLuint BaselinePass::denoise(GLuint ao, const GpuView& view, const AoRequest& request, Denoiser denoiser) {
  gl_.BindVertexArray(vertex_array_);
  if (denoiser == Denoiser::none) return ao;
  if (denoiser == Denoiser::blur) return blur(ao, view, request);
  if (edge_passes(denoiser) == 0) return draw_own(denoiser, ao, view, request);
  edge_denoiser_.find_edges(view);
  return edge_denoiser_.denoise(ao, edge_passes(denoiser), 1);
}

GLuint BaselinePass::draw_own(Denoiser denoiser, GLuint ao, const GpuView& view, const AoRequest& request) {
  const GpuProgram& program = denoiser == Denoiser::box    ? box_
                              : denoiser == Denoiser::disc ? disc_
                                                           : gaussian_;
  const int passes = denoiser == Denoiser::box ? 1 : denoiser == Denoiser::disc ? disc_passes : 2;
  set_surface(program, view, request);
  gl_.Uniform1i(program.at("ao_image"), 2);
  // The default disc radius of N8AO.
  gl_.Uniform1f(program.at("disc_px"), 12);
  for (int pass = 0; pass < passes; ++pass) {
    const GpuImage& target = images_[(pass + 1) % 2];
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(GL_TEXTURE_2D, pass == 0 ? ao : images_[pass % 2].texture());
    gl_.Uniform2i(program.at("axis"), pass == 0, pass == 1);
    gl_.Uniform1f(program.at("turn"), float(pass));
    gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.ActiveTexture(GL_TEXTURE0);
  return images_[passes % 2].texture();
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

std::vector<FrameMethod> frame_baselines(const GladGLContext& gl) {
  // The pass is created when the first baseline is drawn, because most replays draw no baseline.
  const auto pass = std::make_shared<std::unique_ptr<BaselinePass>>();
  std::vector<FrameMethod> methods;
  for (const BaselineMethod& method : baseline_methods())
    methods.push_back({baseline_row(method), method.taps, [&gl, pass, method](const FrameReplay& replay) {
                         const GpuView& view = replay.gpu_view();
                         if (!*pass) *pass = std::make_unique<BaselinePass>(gl, view.width, view.height);
                         return replay.read((*pass)->draw(method, view, replay.request(), true));
                       }});
  return methods;
}

}  // namespace nook::lab
