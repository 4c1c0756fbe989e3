#include "sdk/src/api/gl/nnao_descriptors.h"

#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/taps.h"

namespace nook::api {
namespace {

nook_nnao_debug_desc checked_debug(const void* next) {
  const auto* const given = find_extension<nook_nnao_debug_desc>(next);
  const nook_nnao_debug_desc debug = given ? read_descriptor(given) : default_desc<nook_nnao_debug_desc>();
  check_known("debug.path", debug.path, NOOK_NNAO_PATH_COMPUTE);
  check_known("debug.depth_sample", debug.depth_sample, NOOK_NNAO_SAMPLE_NEAREST);
  check_switch("debug.timers", debug.timers);
  return debug;
}

gl::NnaoSettings settings_of(const nook_nnao_desc* given) {
  nook_nnao_desc desc = read_descriptor<nook_nnao_desc, nook_nnao_debug_desc>(given);
  const nook_nnao_debug_desc debug = checked_debug(desc.next);
  check_known("desc.preset", desc.preset, NOOK_NNAO_PRESET_BEST);
  if (desc.taps == -1)
    desc.taps = desc.preset == NOOK_NNAO_PRESET_BEST ? nnao::best_taps : nnao::default_taps;
  if (desc.half_resolution == -1) desc.half_resolution = desc.preset == NOOK_NNAO_PRESET_FAST;
  if (desc.blur == -1) desc.blur = 1;
  desc.next = nullptr;
  return {desc, debug.path, debug.depth_sample, debug.timers != 0};
}

}  // namespace

gl::NnaoFrame read_nnao_frame(const nook_gl_frame_desc* frame, const nook_nnao_frame_desc* desc) {
  auto settings = read_descriptor<nook_nnao_frame_desc, nook_nnao_frame_debug_desc>(desc);
  const auto* const debug = find_extension<nook_nnao_frame_debug_desc>(settings.next);
  settings.next = nullptr;
  return {read_descriptor(frame), settings, debug ? read_descriptor(debug).show : NOOK_NNAO_VIEW_AO};
}

void check_max_size(std::int32_t max_width, std::int32_t max_height) {
  constexpr std::int32_t largest = 16384;
  if (max_width < 1 || max_height < 1 || max_width > largest || max_height > largest)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.max_width and desc.max_height are out of range (got %d x %d, need 1 x 1 to %d x %d)",
                  max_width, max_height, largest, largest);
}

gl::NnaoSettings checked_nnao_desc(const nook_nnao_desc* given) {
  const gl::NnaoSettings desc = settings_of(given);
  check_max_size(desc.max_width, desc.max_height);
  if (desc.taps < 0 || nnao::horizon_grid(static_cast<std::uint32_t>(desc.taps)).steps == 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.taps is unknown (got %d, need 9, 16, 32, 64, 128 or 256, or -1 for the preset's number)",
        desc.taps);
  check_fits("desc.half_resolution", desc.half_resolution,
             desc.half_resolution >= 0 && desc.half_resolution <= 1, "0 or 1, or -1 for the preset's value");
  check_fits("desc.blur", desc.blur, desc.blur >= 0 && desc.blur <= 2,
             "0 to 2, or -1 for the preset's value");
  check_fits("desc.blur_sharpness", desc.blur_sharpness, desc.blur_sharpness > 0, "more than 0");
  check_switch("desc.bent_normals", desc.bent_normals);
  check_fits("desc.max_history_frames", desc.max_history_frames,
             desc.max_history_frames == 0 || (desc.max_history_frames >= 2 && desc.max_history_frames <= 64),
             "0, or 2 to 64");
  if (desc.max_history_frames != 0 && desc.bent_normals)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.max_history_frames cannot be combined with desc.bent_normals (got %d and 1); use "
                  "only one of them",
                  desc.max_history_frames);
  check_range("desc.depth_samples", desc.depth_samples, 0, 16);
  check_range("desc.views", desc.views, 0, gl::max_layers);
  if (desc.normal_samples != 0 && desc.normal_samples != desc.depth_samples)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.normal_samples differs from desc.depth_samples (got %d and %d, need 0 or the same "
                  "number); each pixel uses the normal of the same sample that its depth comes from",
                  desc.normal_samples, desc.depth_samples);
  if (!desc.network && desc.network_size != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.network is NULL, but desc.network_size is %zu; pass the bytes of the network, or set "
                  "the size to 0 for the embedded network",
                  desc.network_size);
  return desc;
}

std::span<const std::byte> network_bytes(const nook_nnao_desc& desc) {
  if (!desc.network) return nnao::default_network_file();
  return {static_cast<const std::byte*>(desc.network), desc.network_size};
}

void check_form(const nook_nnao_desc& desc, nnao::NetworkForm form) {
  if (desc.bent_normals && form == nnao::NetworkForm::paper)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.bent_normals needs a network of the horizon form, but desc.network has the paper's "
                  "form; train a network of the horizon form, or leave desc.network NULL");
}

}  // namespace nook::api
