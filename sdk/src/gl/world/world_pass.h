// Casters darken what a depth buffer shows.
//   full resolution  host depth -> AO and result
//   half resolution  host depth -> depth of every fourth pixel; AO by far bodies of fewer still; AO of every
//                    fourth by near bodies, times that -> upsample and result
// Where there are compute shaders that write images, both stages of AO at half resolution are dispatches
// whose groups leave out the bodies that reach none of their surfaces.
#pragma once

#include <nook/nook_gl_world.h>

#include <array>
#include <optional>
#include <span>

#include "sdk/src/core/capsule.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/gl/texel_table.h"
#include "sdk/src/world/caster_parts.h"
#include "sdk/src/world/light_terms.h"
#include "sdk/src/world/tile_lists.h"

namespace nook::gl {

// Casters that stand together, in world space.
struct ReachingGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;
  float radius = 0;    // of a sphere round them
  float reach = 0;     // metres from the centre; no point beyond it is darkened
  float strength = 0;  // square metres, see caster_strength
  // Square metres; the AO that they take at the distance d is at most cutoff_error times this / d^2.
  float strength_over_cutoff = 0;
  const world::CasterParts* parts = nullptr;  // NULL: one caster

  // Metres from the centre where one capsule begins to stand for the casters.
  float merging_distance(float level_error) const;
};

// The groups of a frame. group(index) is called for each at most twice, and what it returns lives until the
// next call.
struct ReachingGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  ReachingGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

// No point is beyond this reach; its square is still a float.
inline constexpr float endless_reach = 1e15f;

// A cone of light, in world space.
struct LightCone {
  Vec3 axis;  // unit, towards the light
  float half_angle_radians = 0;
  float reach = 0;  // metres
};

// A frame that passed its checks.
struct WorldFrame {
  const nook_nnao_frame_desc& screen;
  const float* view;  // column-major
  std::uint32_t ao_texture = 0;
  nook_world_composition composition = NOOK_WORLD_PRODUCT;
  float level_error = 0;
  nook_world_view show = NOOK_WORLD_VIEW_AO;
  world::LightTerms light;  // in view space; of coloured passes
  std::optional<LightCone> cone;
};

// Every call may change any of the touched state of the user `screen`, and of uploads; the caller holds a
// StateGuard.
class WorldPass {
 public:
  // Throws Failure.
  WorldPass(Device& device, const nook_world_pass_desc& desc);

  // Draws a frame. Throws Failure before anything is drawn.
  void render(const WorldFrame& frame, const ReachingGroups& groups);
  void recheck() { checked_.reset(); }

  // Returns true if the pass has stages that are compute shaders.
  bool computes() const { return computes_; }
  GLuint ao_texture() const { return own_.texture(); }
  const TexelTable& table() const { return casters_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(kept_.size()); }
  std::uint32_t caster_count() const { return caster_count_; }
  std::uint64_t bytes() const;

 private:
  struct Stage {
    Object program;
    GLint frame = -1, groups = -1, columns = -1, first_tile = -1, tile_size = -1, composition = -1,
          counts = -1;
    // Only coloured passes have these.
    GLint far = -1, first_far_tile = -1;  // of half resolution
    GLint light_terms = -1, cone = -1, light_columns = -1, first_light_tile = -1, first_shade = -1;
  };
  Stage make_stage(Object program) const;
  Stage make_draw(const char* fragment, const char* defines, bool gathers = false) const;
  Stage make_upsample(const char* defines) const;
  Stage make_darkening(const char* defines) const;
  // All defines of a stage.
  std::array<char, 160> defines_of(const char* own) const;
  TextureFormat half_format() const;
  void make_half(const nook_world_pass_desc& desc);
  void check(const WorldFrame& frame);
  // Chooses the groups of a frame and returns the texels of their table.
  std::uint64_t choose(const WorldFrame& frame, const ReachingGroups& groups);
  // Puts a group that reaches tiles into the lists.
  void keep(const WorldFrame& frame, const world::TileGrid& grid, std::uint32_t index,
            const ReachingGroup& group, const world::TileRange& tiles);
  // Chooses the groups whose shadow falls into the view, with their texels.
  std::uint64_t choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                              const ReachingGroups& groups);
  void upload(const WorldFrame& frame, const ReachingGroups& groups);
  void set_light(const Stage& stage, const WorldFrame& frame) const;
  void set_frame(const Stage& stage, const WorldFrame& frame, const FrameConstants& constants) const;
  void draw(GLuint framebuffer, const Viewport& viewport) const;
  void draw_depth(const WorldFrame& frame, const FrameConstants& constants) const;
  // Runs the stage of AO at half resolution whose program is in use.
  void darken(const RenderTexture& target, int width, int height) const;
  void darken_half(const WorldFrame& frame, const FrameConstants& constants) const;
  const Stage& output_of(const WorldFrame& frame) const;
  void draw_output(const Stage& stage, const WorldFrame& frame, const FrameConstants& constants);

  Device& device_;
  int max_width_, max_height_;
  bool half_, coloured_, computes_;
  int far_step_;                                             // pixels
  Stage output_, layered_output_, counts_;                   // at half resolution the upsample
  Stage half_depth_, masked_half_depth_, half_ao_, far_ao_;  // masked: without replaced pixels
  RenderTexture far_texture_;
  RenderTexture own_, depth_, ao_;  // depth and AO of every fourth pixel
  Object sampler_, vertex_array_, target_framebuffer_;
  TexelTable casters_;          // and behind them the lists of tiles
  Vector<std::uint32_t> kept_;  // the groups that reach the view
  Vector<world::TileRange> ranges_;
  Vector<float> lists_;
  Vector<world::TileRange> near_ranges_;  // at half resolution: of what is nearer than its merging distance
  Vector<float> near_lists_;
  std::uint32_t first_near_tile_ = 0;
  bool far_ = false;              // a body may be beyond its merging distance
  Vector<std::uint32_t> shades_;  // the groups whose shadow in the cone falls into the view
  Vector<world::TileRange> shade_ranges_;
  Vector<float> shade_lists_;
  std::uint32_t first_shade_ = 0, first_light_tile_ = 0, light_columns_ = 0;
  std::uint32_t caster_count_ = 0, tile_columns_ = 0, first_tile_ = 0, tile_px_ = 32;
  std::optional<HostImages> checked_;
};

}  // namespace nook::gl
