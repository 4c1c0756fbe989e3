#include <algorithm>
#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/network_shader.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"
#include "sdk/src/nnao/taps.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {
namespace {

[[noreturn]] void refuse_compute(const Functions& gl) {
  const int major = gl.version / 10, minor = gl.version % 10;
  if (gl.limited_by_host)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "debug.path needs compute shaders (got tier %d on %s %d.%d, need tier %d); leave "
                  "nook_gl_desc.max_tier 0, or use NOOK_NNAO_PATH_AUTOMATIC",
                  tier_of(gl), api_name(gl), major, minor,
                  gl.profile == Profile::desktop ? NOOK_GL_TIER_43 : NOOK_GL_TIER_ES31);
  if (!gl.can.compute)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "debug.path needs compute shaders (got %s %d.%d, need %s or newer); use "
                  "NOOK_NNAO_PATH_AUTOMATIC",
                  api_name(gl), major, minor, gl.profile == Profile::desktop ? "4.3" : "3.1");
  throw Failure(NOOK_ERROR_UNSUPPORTED,
                "debug.path needs compute shaders (get_proc did not return \"glBindImageTexture\" on %s "
                "%d.%d); pass the context's own loader, or use NOOK_NNAO_PATH_AUTOMATIC",
                api_name(gl), major, minor);
}

}  // namespace

nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked) {
  const bool can_compute = gl.can.compute_images;
  if (asked == NOOK_NNAO_PATH_COMPUTE && !can_compute) refuse_compute(gl);
  if (asked != NOOK_NNAO_PATH_AUTOMATIC) return asked;
  // If compute shaders cannot write R8 images, they must write four bytes for each AO value. Drawing is
  // faster in this case.
  return can_compute && gl.can.r8_images ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT;
}

namespace {

struct TexturePlan {
  TextureFormat format;
  int width, height;
  const char* label;
};

// The textures of a pass. A texture whose width is 0 is not created.
struct PassPlan {
  // `own` has one texture per layer. If AO is averaged over frames, `depth` and `history` also have one
  // texture per layer.
  TexturePlan depth[2], normals, ao[2], history[2], own;
  int own_layers = 1, kept_layers = 1;
};

// The formats for depth, normals and AO that the context can draw into.
struct PassFormats {
  TextureFormat depth = TextureFormat::depth;
  TextureFormat normal = TextureFormat::normal, ao = TextureFormat::ao_edges, own = TextureFormat::ao;
};

PassFormats formats_of(const nook_nnao_desc& desc) {
  PassFormats formats;
  if (desc.normal_samples) formats.depth = TextureFormat::sampled_depth;
  if (desc.bent_normals) {
    formats.ao = TextureFormat::ao_image;
    formats.own = TextureFormat::bent_ao;
  }
  return formats;
}

PassFormats formats_of(const nook_nnao_desc& desc, const Functions& gl, nook_nnao_path path) {
  PassFormats formats = formats_of(desc);
  if (!gl.can.norm16_targets) formats.normal = TextureFormat::normal_bits;
  if (path == NOOK_NNAO_PATH_COMPUTE && !gl.can.r8_images) formats.ao = TextureFormat::ao_image;
  return formats;
}

PassPlan plan_of(const nook_nnao_desc& desc, nnao::NetworkForm form, const PassFormats& formats) {
  const bool half = desc.half_resolution != 0, paper = form == nnao::NetworkForm::paper,
             filtered = filter_draws(desc) > 0;
  const int width = surface_length(desc.max_width, half), height = surface_length(desc.max_height, half);
  const int temporal_width = desc.max_history_frames ? width : 0;
  return {{{formats.depth, width, height, "nook: linear depth"},
           {formats.depth, temporal_width, height, "nook: linear depth of the frame before"}},
          {formats.normal, paper ? width : 0, height, "nook: normals"},
          {{formats.ao, width, height, "nook: AO of the surface"},
           {formats.ao, filtered ? width : 0, height, "nook: filtered AO of the surface"}},
          {{TextureFormat::ao_image, temporal_width, height, "nook: mean AO over frames"},
           {TextureFormat::ao_image, temporal_width, height, "nook: mean AO over the frames before"}},
          {formats.own, desc.max_width, desc.max_height, "nook: screen-space AO"},
          drawn_layers(desc),
          desc.max_history_frames ? drawn_layers(desc) : 1};
}

}  // namespace

const char* screen_ao_glsl() {
  return embedded_text("nnao/host.glsl");
}

std::uint64_t texture_bytes(const nook_nnao_desc& desc, nnao::NetworkForm form) {
  const PassPlan plan = plan_of(desc, form, formats_of(desc));
  const auto bytes = [](const TexturePlan& texture) {
    return std::uint64_t(texture.width) * std::uint64_t(texture.height) * bytes_per_texel(texture.format);
  };
  std::uint64_t kept = 0;
  for (const TexturePlan& texture : {plan.depth[0], plan.depth[1], plan.history[0], plan.history[1]})
    kept += bytes(texture);
  return std::uint64_t(plan.kept_layers) * kept + bytes(plan.normals) + bytes(plan.ao[0]) +
         bytes(plan.ao[1]) + std::uint64_t(plan.own_layers) * bytes(plan.own);
}

NnaoPass::NnaoPass(Device& device, const NnaoSettings& desc, const nnao::Network& network)
    : ScreenPass(device, desc),
      path_(chosen_path(device.gl, desc.path)),
      filters_(device.memory, filter_unit) {
  check_size();
  make_programs(network);
  make_textures(network.form);
  if (network.form == nnao::NetworkForm::paper) upload_filters(network);
  // The initial colour is fully open: AO is 1, in red or in alpha. In a pass with bent normals, the initial
  // bent normal is the direction to the viewer.
  const GLfloat aside = desc.bent_normals ? 0.5f : 1;
  make_objects({aside, aside, 1, 1});
  if (desc.timers && !device.gl.can.timestamps)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "debug.timers needs time stamps, which this %s does not have (need OpenGL 3.3 or "
                  "GL_EXT_disjoint_timer_query); leave debug.timers 0",
                  api_name(device.gl));
  if (desc.timers) timer_.emplace(device);
  device.check("making the screen-space pass");
}

ScreenStage NnaoPass::make_stage(Object program) const {
  constexpr SamplerUnit samplers[] = {{"nook_depth", NOOK_UNIT_DEPTH},
                                      {"nook_host_depth", NOOK_UNIT_HOST_DEPTH},
                                      {"nook_host_normal", NOOK_UNIT_NORMAL},
                                      {"nook_normal", NOOK_UNIT_NORMAL},
                                      {"nook_ao", NOOK_UNIT_AO},
                                      {"nook_filters", NOOK_UNIT_FILTERS},
                                      {"nook_layer", NOOK_UNIT_LAYER},
                                      {"nook_history", NOOK_UNIT_HISTORY},
                                      {"nook_history_depth", NOOK_UNIT_HISTORY_DEPTH},
                                      {"nook_motion", NOOK_UNIT_MOTION}};
  ScreenStage stage;
  ScreenPass::make_stage(stage, std::move(program), samplers);
  return stage;
}

void NnaoPass::make_programs(const nnao::Network& network) {
  const bool horizon = network.form == nnao::NetworkForm::horizon;
  const nnao::TapGrid grid = nnao::horizon_grid(static_cast<std::uint32_t>(desc_.taps));
  const PassDefines given = pass_defines(desc_, horizon, grid);
  const char* const defines = given.text;
  char layered[sizeof given.text + 32], apart[sizeof given.text + 64], along_y[sizeof given.text + 32];
  std::snprintf(layered, sizeof layered, "%s#define NOOK_LAYERED 1\n", defines);
  std::snprintf(apart, sizeof apart, "%s#define NOOK_NO_SURFACE_ABOVE NOOK_EXCLUDED_ABOVE\n", defines);
  std::snprintf(along_y, sizeof along_y, "%s#define NOOK_FILTER_ALONG_Y 1\n", defines);
  const bool samples = desc_.depth_samples > 0, sample_arrays = samples && desc_.views > 0;
  const auto drawn = [&](const char* path, const char* text, bool medium_precision = false) {
    return make_stage(
        draw_program(device_, "nnao/screen.vert", path, text, {samples, sample_arrays, medium_precision}));
  };
  depth_stage_ = drawn("nnao/depth.frag", defines);
  apart_depth_stage_ = drawn("nnao/depth.frag", apart);
  if (!horizon) normals_stage_ = drawn("nnao/normals.frag", defines);
  occlusion_stage_ =
      path_ == NOOK_NNAO_PATH_COMPUTE
          ? make_stage(compute_program(device_, "nnao/occlusion.comp", defines, {samples, sample_arrays}))
          : drawn("nnao/occlusion.frag", defines);
  if (temporal()) {
    accumulate_stage_ = drawn("nnao/accumulate.frag", defines);
    earlier_location_ = uniform_location(device_, accumulate_stage_.program, "nook_earlier");
  }
  // Medium precision in the filter of AO at half resolution changes the error by at most 0.1 %
  // (docs/opengl_es.md).
  for (int axis = 0; axis < std::min(filter_draws(desc_), 2); ++axis)
    filter_stages_[axis] =
        drawn("nnao/filter.frag", axis == 0 ? defines : along_y, half() && desc_.bent_normals == 0);
  resolve_stage_ = drawn("nnao/resolve.frag", defines);
  layered_stage_ = drawn("nnao/resolve.frag", layered);
  show_normals_stage_ = drawn("nnao/show_normals.frag", defines);
  if (device_.debug) make_watch(drawn("nnao/surface.frag", apart), true);
  // Both forms of the network have the same number of groups for the same number of taps.
  device_.gl.UseProgram(occlusion_stage_.program.name());
  device_.gl.Uniform1i(uniform_location(device_, occlusion_stage_.program, "nook_tap_groups"),
                       static_cast<GLint>(grid.directions));
  const Vector<float> constants = network_constants(network, grid, device_.memory);
  device_.gl.Uniform4fv(uniform_location(device_, occlusion_stage_.program, "nook_network"),
                        static_cast<GLsizei>(constants.size() / 4), constants.data());
}

void NnaoPass::make_textures(nnao::NetworkForm form) {
  const PassPlan plan = plan_of(desc_, form, formats_of(desc_, device_.gl, path_));
  const auto make = [&](RenderTexture& texture, const TexturePlan& planned) {
    if (planned.width > 0)
      texture = RenderTexture(device_, planned.format, planned.width, planned.height, planned.label);
  };
  for (int layer = 0; layer < plan.kept_layers; ++layer)
    for (int i = 0; i < 2; ++i) {
      make(layers_[std::size_t(layer)].depth[i], plan.depth[i]);
      make(layers_[std::size_t(layer)].history[i], plan.history[i]);
    }
  make(normals_, plan.normals);
  make(ao_[0], plan.ao[0]);
  make(ao_[1], plan.ao[1]);
  if (desc_.views > 0)
    own_ = RenderTexture(device_, plan.own.format, plan.own.width, plan.own.height, plan.own_layers,
                         plan.own.label);
  else
    make(own_, plan.own);
}

void NnaoPass::upload_filters(const nnao::Network& network) {
  const auto& filters = network.paper.filters;
  filters_.replace(device_, GL_RGBA32F, filters.size() / 4, filters.data(), "nook: filters");
}

}  // namespace nook::gl
