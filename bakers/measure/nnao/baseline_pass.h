// Draws the baselines, and denoises them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bakers/measure/nnao/baselines.h"
#include "bakers/measure/nnao/depth_levels.h"
#include "bakers/measure/nnao/edge_denoiser.h"
#include "bakers/measure/nnao/frame_comparison.h"
#include "bakers/measure/nnao/gpu_image.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::measure {

class BaselinePass {
 public:
  BaselinePass(const GladGLContext& gl, int width, int height);
  ~BaselinePass();

  // Returns the texture (R8) that holds the AO until the next call. denoised: by the tuning's denoiser.
  GLuint draw(const BaselineMethod& method, const GpuView& view, const AoRequest& request, bool denoised);
  // The bent normals of XeGTAO before its denoiser, in view space, and the packed edges, both row by row.
  struct BentImage {
    std::vector<Vec3> bent_normal;  // zero where there is no surface
    std::vector<float> edges;
  };
  BentImage draw_bent(const BaselineMethod& xegtao, const GpuView& view, const AoRequest& request);
  // Smooths AO that lies in a texture of the same size.
  GLuint denoise(GLuint ao, const GpuView& view, const AoRequest& request, Denoiser denoiser);

 private:
  const GpuProgram& program(const BaselineMethod& method, const std::string& more_defines = "");
  void set_surface(const GpuProgram& program, const GpuView& view, const AoRequest& request) const;
  void draw_raw(const BaselineMethod& method, const GpuView& view, const AoRequest& request);
  // XeGTAO writes the edges too, and AO above 1 for its own denoiser.
  void draw_xegtao(const GpuProgram& shader, const BaselineMethod& method, const GpuView& view,
                   const AoRequest& request, float scale, GLuint framebuffer);
  GLuint blur(GLuint ao, const GpuView& view, const AoRequest& request);
  // Runs one of the own denoisers of what is shipped.
  GLuint draw_own(Denoiser denoiser, GLuint ao, const GpuView& view, const AoRequest& request);

  const GladGLContext& gl_;
  int width_, height_;
  GLuint vertex_array_ = 0, with_edges_ = 0;
  std::map<std::string, std::unique_ptr<GpuProgram>> programs_;  // by path and defines, made at first use
  GpuProgram blur_, box_, disc_, gaussian_;
  GpuImage images_[2];
  EdgeDenoiser edge_denoiser_;
  DepthLevels depth_levels_;
  GpuImage hilbert_;
};

// The baselines as rows of a replayed frame, each denoised. gl must outlive the result.
std::vector<FrameMethod> frame_baselines(const GladGLContext& gl);

}  // namespace nook::measure
