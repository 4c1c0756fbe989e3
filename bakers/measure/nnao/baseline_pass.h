// Draws the baselines, and blurs them as the library blurs its own AO.
#pragma once

#include <map>
#include <memory>

#include "bakers/measure/nnao/baselines.h"
#include "bakers/measure/nnao/gpu_image.h"

namespace nook::measure {

// The request that every method gets.
struct AoRequest {
  float radius = 0.5f;        // metres
  float max_radius_px = 90;   // where the radius covers more pixels, it shrinks
  float blur_sharpness = 16;  // as nook_nnao_desc's
};

class BaselinePass {
 public:
  BaselinePass(const GladGLContext& gl, int width, int height);
  ~BaselinePass();

  // Returns the texture (R8) that holds the AO until the next call.
  GLuint draw(const BaselineMethod& method, const GpuView& view, const AoRequest& request, bool blurred);
  // Blurs AO that lies in a texture of the same size.
  GLuint blur(GLuint ao, const GpuView& view, const AoRequest& request);

 private:
  void set_surface(const GpuProgram& program, const GpuView& view, const AoRequest& request) const;

  const GladGLContext& gl_;
  int width_, height_;
  GLuint vertex_array_ = 0;
  std::map<Baseline, std::unique_ptr<GpuProgram>> programs_;
  GpuProgram blur_;
  GpuImage images_[2];
};

}  // namespace nook::measure
