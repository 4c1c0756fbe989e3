// The compute shaders that nook_gpu_cost counts make what the fragment shaders of the comparison make.
#include <algorithm>
#include <cmath>
#include <string>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/raytrace/random.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

std::unique_ptr<platform::Context> make_compute_context() {
  platform::ContextRequest request;
  request.major = 4;
  request.minor = 3;
  return platform::create_context(request);
}

class ComputeProgram {
 public:
  ComputeProgram(const GladGLContext& gl, const std::string& path) : gl_(gl), name_(gl.CreateProgram()) {
    const GLuint shader = gl.CreateShader(GL_COMPUTE_SHADER);
    for (const measure::EmbeddedShader& embedded : baseline_shaders())
      if (path == embedded.path) gl.ShaderSource(shader, 1, &embedded.text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(name_, shader);
    gl.DeleteShader(shader);
    gl.LinkProgram(name_);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(name_, GL_LINK_STATUS, &linked);
    REQUIRE(linked == GL_TRUE);
    gl.UseProgram(name_);
    gl.Uniform2f(at("texel"), 1 / float(width), 1 / float(height));
  }
  ~ComputeProgram() { gl_.DeleteProgram(name_); }
  ComputeProgram(const ComputeProgram&) = delete;
  ComputeProgram& operator=(const ComputeProgram&) = delete;

  GLint at(const char* uniform) const { return gl_.GetUniformLocation(name_, uniform); }
  void bind(const char* sampler, GLuint unit, GLuint texture) const {
    gl_.ActiveTexture(GL_TEXTURE0 + unit);
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    // The gathers of the border clamp.
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      gl_.TexParameteri(GL_TEXTURE_2D, axis, GL_CLAMP_TO_EDGE);
    gl_.Uniform1i(at(sampler), GLint(unit));
  }
  void run(GLuint groups_x, GLuint groups_y) const {
    gl_.DispatchCompute(groups_x, groups_y, 1);
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
  }

 private:
  const GladGLContext& gl_;
  GLuint name_;
};

float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("two pixels a thread are denoised as one is") {
  const auto context = make_compute_context();
  const GladGLContext& gl = context->gl();
  const GpuView view(gl, traced(corner(), camera()));
  bake::Random random(1);
  std::vector<float> noise(std::size_t(width * height));
  for (float& value : noise) value = random.unit();
  const GpuImage ao(gl, GL_R8, GL_RED, width, height, noise.data());
  GLuint vertex_array = 0;
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  EdgeDenoiser denoiser(gl, width, height);
  denoiser.find_edges(view);
  const std::vector<float> by_fragments = read_red(gl, denoiser.denoise(ao.texture(), 1, 1), width, height);

  const GpuImage target(gl, GL_R8, GL_RED, width, height, nullptr);
  const ComputeProgram program(gl, "denoise.comp");
  program.bind("ao_image", 0, ao.texture());
  program.bind("edge_image", 1, denoiser.edge_image().texture());
  gl.Uniform1f(program.at("own_weight"), 1.2f);
  gl.Uniform1f(program.at("scale"), 1);
  gl.BindImageTexture(0, target.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R8);
  program.run(width / 16, height / 8);
  // Sums of another order may round to the next level.
  CHECK(largest_difference(by_fragments, read_red(gl, target.texture(), width, height)) < 1.1f / 255);
  gl.DeleteVertexArrays(1, &vertex_array);
  CHECK(gl.GetError() == GL_NO_ERROR);
}

TEST_CASE("all levels of depth at once are those made one by one") {
  const auto context = make_compute_context();
  const GladGLContext& gl = context->gl();
  const GpuView view(gl, traced(corner(), camera()));
  constexpr float radius_m = 0.2f, falloff = 0.6f;
  GLuint vertex_array = 0, texture = 0;
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  DepthLevels levels(gl, width, height);
  levels.draw(view, radius_m, falloff);

  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexStorage2D(GL_TEXTURE_2D, DepthLevels::count, GL_R32F, width, height);
  const ComputeProgram program(gl, "depth_levels.comp");
  program.bind("depth_image", 0, view.depth.texture());
  gl.Uniform1f(program.at("level_radius_m"), 0.75f * radius_m);
  gl.Uniform1f(program.at("falloff"), falloff);
  for (int level = 0; level < DepthLevels::count; ++level)
    gl.BindImageTexture(GLuint(level), texture, level, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  program.run(width / 16, height / 16);
  for (int level = 0; level < DepthLevels::count; ++level) {
    std::vector<float> by_fragments(std::size_t((width >> level) * (height >> level))),
        at_once = by_fragments;
    for (const auto& [made, values] : {std::pair{levels.texture(), &by_fragments}, {texture, &at_once}}) {
      gl.BindTexture(GL_TEXTURE_2D, made);
      gl.GetTexImage(GL_TEXTURE_2D, level, GL_RED, GL_FLOAT, values->data());
    }
    INFO("level " << level);
    CHECK(*std::ranges::min_element(by_fragments) > 1);
    CHECK(largest_difference(by_fragments, at_once) < 1e-4f);
  }
  gl.DeleteTextures(1, &texture);
  gl.DeleteVertexArrays(1, &vertex_array);
  CHECK(gl.GetError() == GL_NO_ERROR);
}
