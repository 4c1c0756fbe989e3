// Casters darken what a depth buffer shows: one draw over the viewport.
#pragma once

#include <nook/nook_gl_world.h>

#include <optional>
#include <span>

#include "sdk/src/core/capsule.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/gl/texel_table.h"

namespace nook::gl {

// Casters that stand together, in world space.
struct ReachingGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;
  float reach = 0;  // metres from the centre; no point beyond it is darkened
};

// The casters of a frame. group(index) is called for each once, in order, and what it returns lives until the
// next call.
struct ReachingGroups {
  std::uint32_t count = 0;    // groups
  std::uint32_t casters = 0;  // of all groups
  const void* user = nullptr;
  ReachingGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

// No point is beyond this reach; its square is still a float.
inline constexpr float endless_reach = 1e15f;

// Every call may change any of the touched state of the user `screen`, and of uploads; the caller holds a
// StateGuard.
class WorldPass {
 public:
  // Throws Failure.
  WorldPass(Device& device, const nook_world_pass_desc& desc);

  // Draws a frame that passed check_frame. view is column-major. Throws Failure before anything is drawn.
  void render(const nook_nnao_frame_desc& frame, const float* view, const ReachingGroups& groups);
  void recheck() { checked_.reset(); }

  GLuint ao_texture() const { return own_.texture(); }
  const TexelTable& table() const { return casters_; }
  std::uint32_t group_count() const { return groups_; }
  std::uint32_t caster_count() const { return caster_count_; }
  std::uint64_t bytes() const;

 private:
  struct Stage {
    Object program;
    GLint frame = -1, groups = -1;
  };
  Stage make_stage(const char* defines);
  void check(const nook_nnao_frame_desc& frame);
  void upload(const float* view, const ReachingGroups& groups);

  Device& device_;
  int max_width_, max_height_;
  Stage stage_, layered_stage_;
  RenderTexture own_;
  Object sampler_, vertex_array_, target_framebuffer_;
  TexelTable casters_;
  std::uint32_t groups_ = 0, caster_count_ = 0;
  std::optional<HostImages> checked_;
};

}  // namespace nook::gl
