// Draws the library's own pass through the public interface.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>

#include <cstddef>
#include <optional>
#include <span>

#include "bakers/measure/nnao/gpu_image.h"
#include "platform/platform.h"

namespace nook::measure {

// The AO settings that every method receives.
struct AoRequest {
  float radius = 0.5f;        // metres
  float max_radius_px = 90;   // if the radius covers more pixels, it is reduced
  float blur_sharpness = 16;  // as in nook_nnao_desc
  float intensity = 1;        // applied after the filter of the library's pass, as in nook_nnao_frame_desc
  float min_radius_px = 0;    // only for the library's pass; other methods and rays ignore it
};

// Throws Failure with the text of nook_last_message if `result` is an error.
void succeed(nook_result result);

// Writes the view matrix of a camera, column by column. It is the inverse of world_from_view, which must
// consist of a rotation and a translation.
void set_view(const Mat3x4& world_from_view, float (&view)[16]);

// Owns Nook's objects for one OpenGL context.
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

// Returns the frame descriptors of a view with linear depth. Fills in size, depth, normals and projection.
ScreenFrame frame_of(const GpuView& view);

// The settings with which the library's pass is measured.
struct NetworkForm {
  int taps = 9;
  bool half_resolution = false;
  int blur = 1;       // how many times the filter runs
  bool bent = false;  // true if the pass computes bent normals
  int temporal_frames = 0;
  // The other methods use this path too, so that times are comparable.
  nook_nnao_path path = NOOK_NNAO_PATH_FRAGMENT;
};

class NetworkPass {
 public:
  // If `network` is empty, uses the embedded network.
  NetworkPass(const NookGl& gl, int width, int height, const NetworkForm& form,
              std::span<const std::byte> network, float blur_sharpness);
  ~NetworkPass();
  NetworkPass(const NetworkPass&) = delete;
  NetworkPass& operator=(const NetworkPass&) = delete;

  // Returns the texture that the pass writes: R8, or RGBA8 with bent normals. world_from_view is the pose of
  // the camera. If `cut` is true, earlier frames are not used. `motion` is a texture of motion vectors in
  // pixels, or 0 for none. These three parameters only have an effect if temporal_frames is set.
  GLuint draw(const GpuView& view, const AoRequest& request, bool blurred,
              const std::optional<Mat3x4>& world_from_view = {}, bool cut = true, GLuint motion = 0);
  bool horizon_form() const { return info_.horizon_form != 0; }

  // Returns the texture fetches per pixel, summed over all stages.
  int fetches(bool blurred) const;

 private:
  NetworkForm form_;
  nook_nnao pass_ = nullptr;
  nook_nnao_info info_{};
};

}  // namespace nook::measure
