// The screen-space pass on the GPU: linear depth, the network, the filter, and the output.
//
// The network runs in the AO stage, which is a draw or a dispatch. All other stages are draws.
//   full resolution  host depth -> depth -> AO and edges -> [mean ->] [filter along x and y ->]
//                    filter along x -> filter along y and resolve
//   half resolution  host depth -> depth of every fourth pixel -> AO and edges -> [mean ->]
//                    [filter along x and y ->] filter along x and y -> upsample and resolve
// Only passes with max_history_frames compute the mean over frames. Passes with several views draw the views
// one after another. The paper's form reads normals at its taps, so it has another stage between depth and
// AO, which writes normals.
#pragma once

#include <nook/nook_nnao.h>

#include <array>
#include <optional>

#include "sdk/src/gl/functions.h"
#include "sdk/src/gl/nnao/screen_pass.h"
#include "sdk/src/gl/nnao/stage_timer.h"
#include "sdk/src/gl/texel_table.h"
#include "sdk/src/nnao/network.h"

namespace nook::gl {

// Returns the GLSL functions with which the host's shaders use the result for lighting.
const char* screen_ao_glsl();

std::uint64_t texture_bytes(const nook_nnao_desc& desc, nnao::NetworkForm form);

// Returns the number of filter draws, which alternate between x and y. At full resolution, the last filter
// along y is not counted, because it is part of the resolve stage.
constexpr int filter_draws(const nook_nnao_desc& desc) {
  return desc.half_resolution || desc.blur == 0 ? 2 * desc.blur : 2 * desc.blur - 1;
}

// Every call may change any OpenGL state in touched_state.h, so the caller must hold a StateGuard.
class NnaoPass : public ScreenPass {
 public:
  // Throws Failure.
  NnaoPass(Device& device, const NnaoSettings& desc, const nnao::Network& network);

  // Draws a frame that passed check_frame, and stores facts about the host's images in `frame`. If it throws
  // Failure, nothing has been drawn.
  void render(NnaoFrame& frame);

  nook_nnao_path path() const { return path_; }
  const std::optional<StageTimer>& timer() const { return timer_; }

 private:
  ScreenStage make_stage(Object program) const;
  void make_programs(const nnao::Network& network);
  void make_textures(nnao::NetworkForm form);
  void upload_filters(const nnao::Network& network);

  bool temporal() const { return desc_.max_history_frames != 0; }
  bool half() const { return desc_.half_resolution != 0; }
  // Binds a texture of the host, or unbinds the unit if `texture` is 0. Pass true for `samples` if the
  // texture is multisampled.
  void bind_host(GLuint unit, GLuint texture, bool samples = false) const;
  void bind_depth(GLuint texture) const;
  void bind_normals(GLuint texture) const;
  // Draws a stage into one of the pass's textures. The old contents of the texture are discarded.
  void draw_stage(const ScreenStage& stage, const FrameConstants& constants, const RenderTexture& target,
                  const Viewport& viewport) const;
  void run_network(const FrameConstants& constants, const Viewport& surface) const;
  // If max_history_frames is set, each layer has its own textures. Otherwise all layers share one set.
  struct LayerTextures {
    RenderTexture depth[2];    // depth of the surface; if AO is averaged over frames, two textures are used
                               // in turn
    RenderTexture history[2];  // means over frames; the two textures are used in turn
    EarlierFrame earlier;
  };
  LayerTextures& textures_of(int layer) { return layers_[temporal() ? std::size_t(layer) : 0]; }
  // Returns which of the two textures the current frame writes.
  std::size_t turn(const LayerTextures& layer) const { return temporal() ? layer.earlier.count % 2 : 0; }

  // Draws one layer. `frame` must have the matrices of this layer.
  void render_layer(const NnaoFrame& frame, int layer);
  // Averages AO with the previous frames, and returns the texture of the mean.
  GLuint accumulate(const NnaoFrame& frame, const FrameConstants& constants, const Viewport& surface,
                    LayerTextures& kept);
  void end_stage() {
    if (timer_) timer_->end_stage();
  }

  nook_nnao_path path_;
  // Only the paper's form uses normals_stage_. The filter stages filter along x and along y.
  ScreenStage depth_stage_, apart_depth_stage_, normals_stage_, occlusion_stage_, accumulate_stage_,
      filter_stages_[2], resolve_stage_, layered_stage_, show_normals_stage_;
  GLint earlier_location_ = -1;  // uniform location in accumulate_stage_
  std::array<LayerTextures, max_layers> layers_;
  RenderTexture normals_;  // of the surface
  RenderTexture ao_[2];    // AO of the surface; the filter writes the second texture
  TexelTable filters_;     // filters of the paper's form
  std::optional<StageTimer> timer_;
};

// Resolves the path of a descriptor to NOOK_NNAO_PATH_FRAGMENT or NOOK_NNAO_PATH_COMPUTE. Throws
// Failure(NOOK_ERROR_UNSUPPORTED) if the host asks for compute but the context does not support it.
nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked);

}  // namespace nook::gl
