// XeGTAO's edge-aware denoiser, for any AO.
#pragma once

#include "bakers/measure/nnao/gpu_image.h"

namespace nook::measure {

class EdgeDenoiser {
 public:
  EdgeDenoiser(const GladGLContext& gl, int width, int height);

  // Draws the edges of a view into edge_image().
  void find_edges(const GpuView& view);
  const GpuImage& edge_image() const { return edges_; }

  // Returns the texture (R8) with the AO after some passes, times scale. Needs the edges, and a vertex array.
  GLuint denoise(GLuint ao, int passes, float scale);

 private:
  void start(const GpuProgram& program, const GpuImage& target) const;

  const GladGLContext& gl_;
  int width_, height_;
  GpuProgram find_, denoise_;
  GpuImage edges_, images_[2];
};

}  // namespace nook::measure
