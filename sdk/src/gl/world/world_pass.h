// Draws how occluders (casters) darken the surfaces in a depth buffer.
//   full resolution  host depth -> AO and result
//   half resolution  host depth -> depth of every fourth pixel -> AO by far bodies, for fewer pixels
//                    -> AO by near bodies, for every fourth pixel, times the AO by far bodies
//                    -> upsample and result
// If compute shaders can write images, both AO stages at half resolution are dispatches. Each group of
// threads skips the bodies that do not reach any surface of the group's pixels.
#pragma once

#include <nook/nook_world.h>

#include <array>
#include <optional>

#include "sdk/src/gl/nnao/screen_pass.h"
#include "sdk/src/gl/world/body_watch.h"
#include "sdk/src/gl/world/frame_casters.h"
#include "sdk/src/gl/world/world_frame.h"

namespace nook::gl {

// Every call may change any state of the user `screen` and of the uploads, so the caller must hold a
// StateGuard.
class WorldPass : public ScreenPass {
 public:
  // Throws Failure.
  WorldPass(Device& device, const nook_world_desc& desc);

  // Draws a frame. If it throws Failure, nothing has been drawn.
  void render(const WorldFrame& frame, const ReachingGroups& groups);

  bool computes() const { return computes_; }
  const FrameCasters& casters() const { return casters_; }
  std::uint64_t bytes() const;

 private:
  struct Stage : ScreenStage {
    GLint groups = -1, columns = -1, first_tile = -1, tile_size = -1, composition = -1, counts = -1;
    // Locations that only coloured passes have.
    GLint far = -1, first_far_tile = -1;  // only used at half resolution
    GLint light_terms = -1, cone = -1, light_columns = -1, first_light_tile = -1, first_shade = -1;
  };
  Stage make_stage(Object program) const;
  Stage make_draw(const char* fragment, const char* defines, bool gathers = false) const;
  Stage make_upsample(const char* defines) const;
  Stage make_darkening(const char* defines) const;
  // Returns all #define lines of a stage.
  std::array<char, 160> defines_of(const char* own) const;
  TextureFormat half_format() const;
  void make_half(const nook_world_desc& desc);
  void set_light(const Stage& stage, const WorldFrame& frame) const;
  void set_frame(const Stage& stage, const WorldFrame& frame, const FrameConstants& constants) const;
  void make_body_watch();
  // If the watch exists, checks whether the bodies of the frame are where depth shows them. The host's depth
  // and mask must be bound. Draws into the pass's own texture, which the frame overwrites later.
  void watch_bodies(const WorldFrame& frame, const ReachingGroups& groups, const FrameConstants& constants);
  void draw_depth(const WorldFrame& frame, const FrameConstants& constants) const;
  // Draws or dispatches the current program, which must be an AO stage at half resolution.
  void darken(const RenderTexture& target, int width, int height) const;
  void darken_half(const WorldFrame& frame, const FrameConstants& constants) const;
  const Stage& output_of(const WorldFrame& frame) const;

  bool half_, coloured_, computes_;
  int far_step_;                                             // pixels
  Stage output_, layered_output_, counts_;                   // at half resolution, these stages upsample
  Stage half_depth_, masked_half_depth_, half_ao_, far_ao_;  // the masked stage skips replaced pixels
  RenderTexture far_texture_;
  RenderTexture depth_, ao_;  // depth and AO of every fourth pixel
  FrameCasters casters_;
  std::optional<BodyWatch> body_watch_;
  struct {
    ScreenStage stage;
    GLint question = -1, count = -1, spheres = -1, light = -1;
  } body_stage_;
};

}  // namespace nook::gl
