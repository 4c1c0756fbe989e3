// Draws the AO of the baselines and denoises it.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bakers/lab/nnao/screen_baselines.h"
#include "bakers/measure/nnao/frame_comparison.h"
#include "bakers/measure/nnao/gpu_image.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::lab {

using measure::EmbeddedShader;

// The shaders of bakers/lab/nnao/shaders.
const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();
inline measure::ShaderTable baseline_shaders() {
  return {embedded_shaders_begin(), embedded_shaders_end()};
}

// The depth levels that XeGTAO reads.
class DepthLevels {
 public:
  static constexpr int count = 5;

  DepthLevels(const GladGLContext& gl, int width, int height);
  ~DepthLevels();
  DepthLevels(const DepthLevels&) = delete;
  DepthLevels& operator=(const DepthLevels&) = delete;

  // `radius_m` is the tuned radius of XeGTAO. `falloff` is its falloff range, as a fraction of the radius.
  // Bind a vertex array before the call.
  void draw(const measure::GpuView& view, float radius_m, float falloff);
  GLuint texture() const { return texture_; }

 private:
  const GladGLContext& gl_;
  int width_, height_;
  measure::GpuProgram program_;
  GLuint texture_ = 0, framebuffers_[count] = {};
};

// Returns the noise texture of XeGTAO (R32F). Each of its 64 x 64 texels holds its position along a Hilbert
// curve, 0 to 4095.
measure::GpuImage hilbert_image(const GladGLContext& gl);

// XeGTAO's edge-aware denoiser. It can denoise the AO of any method.
class EdgeDenoiser {
 public:
  EdgeDenoiser(const GladGLContext& gl, int width, int height);

  // Draws the edges of a view into edge_image().
  void find_edges(const measure::GpuView& view);
  const measure::GpuImage& edge_image() const { return edges_; }

  // Runs the denoiser `passes` times, multiplies the result by `scale`, and returns the texture (R8) that
  // holds it. Before the call, call find_edges and bind a vertex array.
  GLuint denoise(GLuint ao, int passes, float scale);

 private:
  void start(const measure::GpuProgram& program, const measure::GpuImage& target) const;

  const GladGLContext& gl_;
  int width_, height_;
  measure::GpuProgram find_, denoise_;
  measure::GpuImage edges_, images_[2];
};

class BaselinePass {
 public:
  BaselinePass(const GladGLContext& gl, int width, int height);
  ~BaselinePass();

  // Returns the texture (R8) with the AO. Its content is valid until the next call. If `denoised` is true,
  // also runs the denoiser that the method's tuning names.
  GLuint draw(const BaselineMethod& method, const measure::GpuView& view, const measure::AoRequest& request,
              bool denoised);
  // The bent normals that XeGTAO computes before denoising, in view space, and the packed edges.
  struct BentImage {
    std::vector<Vec3> bent_normal;  // zero for pixels without a surface
    std::vector<float> edges;
  };
  BentImage draw_bent(const BaselineMethod& xegtao, const measure::GpuView& view,
                      const measure::AoRequest& request);
  // Smooths AO in a texture of the same size.
  GLuint denoise(GLuint ao, const measure::GpuView& view, const measure::AoRequest& request,
                 Denoiser denoiser);

 private:
  const measure::GpuProgram& program(const BaselineMethod& method, const std::string& more_defines = "");
  void set_surface(const measure::GpuProgram& program, const measure::GpuView& view,
                   const measure::AoRequest& request) const;
  void draw_raw(const BaselineMethod& method, const measure::GpuView& view,
                const measure::AoRequest& request);
  // Draws XeGTAO and its edges. The AO may exceed 1, because XeGTAO's own denoiser expects such values.
  void draw_xegtao(const measure::GpuProgram& shader, const BaselineMethod& method,
                   const measure::GpuView& view, const measure::AoRequest& request, float scale,
                   GLuint framebuffer);
  GLuint blur(GLuint ao, const measure::GpuView& view, const measure::AoRequest& request);
  // Runs the denoiser of a shipped method.
  GLuint draw_own(Denoiser denoiser, GLuint ao, const measure::GpuView& view,
                  const measure::AoRequest& request);

  const GladGLContext& gl_;
  int width_, height_;
  GLuint vertex_array_ = 0, with_edges_ = 0;
  // Compiled programs by path and defines; each is compiled on first use.
  std::map<std::string, std::unique_ptr<measure::GpuProgram>> programs_;
  measure::GpuProgram blur_, box_, disc_, gaussian_;
  measure::GpuImage images_[2];
  EdgeDenoiser edge_denoiser_;
  DepthLevels depth_levels_;
  measure::GpuImage hilbert_;
};

// Returns the baselines as methods for replayed frames, each with its denoiser. `gl` must outlive the result.
std::vector<measure::FrameMethod> frame_baselines(const GladGLContext& gl);

}  // namespace nook::lab
