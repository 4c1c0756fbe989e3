// The library's own pass, through its public interface.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>

#include <cstddef>
#include <optional>
#include <span>

#include "bakers/measure/nnao/gpu_image.h"
#include "platform/platform.h"

namespace nook::measure {

// The request that every method gets.
struct AoRequest {
  float radius = 0.5f;        // metres
  float max_radius_px = 90;   // where the radius covers more pixels, it shrinks
  float blur_sharpness = 16;  // as nook_nnao_desc's
  float intensity = 1;        // of the library's pass after its filter, as nook_nnao_frame_desc's
  float min_radius_px = 0;    // of the library's pass; other methods have none, and rays neither
};

// Throws Failure with the text of nook_last_message.
void succeed(nook_result result);

// The view matrix of a camera, the inverse of a rotation and a translation, column by column.
void set_view(const Mat3x4& world_from_view, float (&view)[16]);

// Owns what belongs to one OpenGL context.
class NookGl {
 public:
  explicit NookGl(platform::Context& context);
  ~NookGl();
  NookGl(const NookGl&) = delete;
  NookGl& operator=(const NookGl&) = delete;

  nook_gl get() const { return gl_; }
  nook_context context() const { return context_; }

 private:
  nook_context context_ = nullptr;
  nook_gl gl_ = nullptr;
};

// Both descriptors of a frame of the screen-space pass.
struct ScreenFrame : nook_gl_frame_desc, nook_nnao_frame_desc {};

// The frame of a view whose depth is linear: size, depth, normals, projection.
ScreenFrame frame_of(const GpuView& view);

// A form in which the pass is measured.
struct NetworkForm {
  int taps = 9;
  bool half_resolution = false;
  int blur = 1;       // how often the filter runs
  bool bent = false;  // with bent normals
  int temporal_frames = 0;
  nook_nnao_path path = NOOK_NNAO_PATH_FRAGMENT;  // as other methods, so that times compare
};

class NetworkPass {
 public:
  // network empty: the embedded one.
  NetworkPass(const NookGl& gl, int width, int height, const NetworkForm& form,
              std::span<const std::byte> network, float blur_sharpness);
  ~NetworkPass();
  NetworkPass(const NetworkPass&) = delete;
  NetworkPass& operator=(const NetworkPass&) = delete;

  // Returns the pass's texture: R8, or RGBA8 with bent normals. world_from_view: of the camera; none: it does
  // not matter. cut: earlier frames are not used. motion: a texture of motion vectors in pixels; 0: none.
  // All three matter with temporal_frames alone.
  GLuint draw(const GpuView& view, const AoRequest& request, bool blurred,
              const std::optional<Mat3x4>& world_from_view = {}, bool cut = true, GLuint motion = 0);
  bool horizon_form() const { return info_.horizon_form != 0; }

  // Texture fetches for each pixel of all stages.
  int fetches(bool blurred) const;

 private:
  NetworkForm form_;
  nook_nnao pass_ = nullptr;
  nook_nnao_info info_{};
};

}  // namespace nook::measure
