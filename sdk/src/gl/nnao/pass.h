// The screen-space pass on the GPU: normals, the network, the blur, and the output.
//
// The network's stage, AO, is a draw or a dispatch; the other stages are draws.
//   full resolution  host depth -> normals -> AO -> blur along x -> blur along y and resolve
//   half resolution  host depth -> depth and normals -> AO -> blur along x -> along y -> upsample and resolve
#pragma once

#include <nook/nook_nnao.h>

#include <optional>

#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/gl/nnao/stage_timer.h"
#include "sdk/src/gl/texel_table.h"
#include "sdk/src/nnao/network.h"

namespace nook::gl {

// Returns the memory of all textures of a pass.
std::uint64_t texture_bytes(const nook_nnao_desc& desc);

// Every call may change any of the touched state; the caller holds a StateGuard.
class NnaoPass {
 public:
  // Throws Failure.
  NnaoPass(Device& device, const nook_nnao_desc& desc, const nnao::Network& network);

  // Draws a frame that passed check_frame. Throws Failure before anything is drawn.
  void render(const nook_nnao_frame_desc& frame);
  void recheck() { checked_.reset(); }

  // Returns the path of the network's stage: FRAGMENT or COMPUTE.
  nook_nnao_path path() const { return path_; }
  GLuint ao_texture() const { return own_.texture(); }
  const std::optional<StageTimer>& timer() const { return timer_; }

 private:
  struct Stage {
    Object program;
    GLint frame = -1, ao_origin = -1, blur_axis = -1, blur_reach = -1;
  };
  Stage make_stage(Object program) const;
  void make_programs(const nnao::Network& network);
  void make_textures();
  void upload_filters(const nnao::Network& network);

  void check(const nook_nnao_frame_desc& frame);
  bool blurs(const nook_nnao_frame_desc& frame) const;
  bool half() const { return desc_.half_resolution != 0; }
  void bind_texture(GLuint unit, GLuint texture) const;
  void set_frame(const Stage& stage, const FrameConstants& constants) const;
  void draw(const Stage& stage, const FrameConstants& constants, GLuint framebuffer,
            const Viewport& viewport) const;
  // into_place is the place of the surface in the texture.
  void run_network(const FrameConstants& constants, const RenderTexture& into,
                   const Viewport& into_place) const;
  void draw_blur(const FrameConstants& constants, const RenderTexture& from, const Viewport& from_place,
                 bool vertical, const RenderTexture& into) const;
  void draw_resolve(const nook_nnao_frame_desc& frame, const FrameConstants& constants,
                    const RenderTexture& ao);
  void end_stage() {
    if (timer_) timer_->end_stage();
  }

  Device& device_;
  nook_nnao_desc desc_;  // without network and next
  nook_nnao_path path_;
  Stage normals_, occlusion_, blur_, resolve_;
  RenderTexture surface_;  // normals, and at half resolution depth
  RenderTexture ao_[2];    // of the surface; at full resolution own_ replaces the second
  RenderTexture own_;
  Object sampler_, vertex_array_, target_framebuffer_;
  TexelTable filters_;  // of the paper's form
  std::optional<StageTimer> timer_;
  std::optional<HostImages> checked_;
};

}  // namespace nook::gl
