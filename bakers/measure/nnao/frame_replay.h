// Draws a recorded frame again from its recorded depth, with the library's pass and with the oracle. The
// library's pass can use the recorded settings or other settings.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bakers/measure/nnao/network_pass.h"
#include "bakers/measure/nnao/oracle_pass.h"
#include "sdk/src/nnao/recording.h"

namespace nook::measure {

// Returns the frame's depth and normals in view space, as the evaluation of views uses them.
bake::nnao::TracedView view_of_frame(const nook::nnao::Recording& recording);

class FrameReplay {
 public:
  // The recording must outlive this object.
  FrameReplay(const GladGLContext& gl, const NookGl& nook, const nook::nnao::Recording& recording);

  // The oracle needs a perspective projection and a radius in metres.
  bool has_oracle() const { return !view_.camera.rays.orthographic && recording_.frame.radius_kind == 0; }
  const bake::nnao::TracedView& view() const { return view_; }

  // Returns the AO of the library's pass at the pixels of the recording. If `network` is empty, uses the
  // embedded network.
  std::vector<float> draw(const nook::nnao::RecordedPass& settings, std::span<const std::byte> network,
                          nook_nnao_view shown) const;
  std::vector<float> draw(Oracle oracle);

  // The functions below are for other methods that draw frames with an oracle. They return the frame's depth
  // and normals, and the recorded request. `read` reads the AO from a texture of the frame's size.
  const GpuView& gpu_view() const { return gpu_view_; }
  AoRequest request() const;
  std::vector<float> read(GLuint texture) const { return read_red(gl_, texture, width(), height()); }

 private:
  int width() const { return int(recording_.width); }
  int height() const { return int(recording_.height); }

  const GladGLContext& gl_;
  const NookGl& nook_;
  const nook::nnao::Recording& recording_;
  bake::nnao::TracedView view_;
  GpuImage depth_;
  std::unique_ptr<GpuImage> normals_, layer_;  // null: the frame has none
  GpuView gpu_view_;
  std::unique_ptr<OraclePass> oracle_;
};

}  // namespace nook::measure
