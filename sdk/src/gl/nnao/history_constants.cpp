#include "sdk/src/gl/nnao/history_constants.h"

#include <algorithm>

#include "sdk/src/nnao/history.h"

namespace nook::gl {
namespace {

const float* row(const FrameConstants& constants, int index) {
  return &constants.values[std::size_t(4 * index)];
}

bool is_cut(const nook_nnao_frame_desc& frame, const FrameConstants& constants, const EarlierFrame& earlier) {
  const float* surface = row(constants, NOOK_FRAME_SURFACE);
  return frame.reset || !earlier.drawn || float(earlier.width) != surface[2] ||
         float(earlier.height) != surface[3] ||
         row(earlier.constants, NOOK_FRAME_SPREAD)[0] != row(constants, NOOK_FRAME_SPREAD)[0];
}

}  // namespace

HistoryConstants history_constants(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier) {
  HistoryConstants values{};
  std::copy_n(frame.earlier_from_view, 12, values.begin());
  const auto set = [&](int index, std::array<float, 4> four) {
    std::copy(four.begin(), four.end(), values.begin() + std::ptrdiff_t(4 * index));
  };
  const float* rays = row(earlier.constants, NOOK_FRAME_SURFACE_RAYS);
  set(NOOK_EARLIER_RAYS, {rays[0], rays[1], rays[2], rays[3]});
  const bool cut = is_cut(frame, constants, earlier);
  set(NOOK_EARLIER_SIZE, {float(earlier.width - 1), float(earlier.height - 1),
                          cut ? 1.0f : float(pass.temporal_frames), frame.motion_texture ? 1.0f : 0.0f});
  const float per_pixel = pass.half_resolution ? 0.5f : 1.0f;
  set(NOOK_EARLIER_MOTION, {per_pixel * frame.motion_scale[0], per_pixel * frame.motion_scale[1],
                            nnao::noise_reach(std::uint32_t(pass.taps)), 0});
  return values;
}

}  // namespace nook::gl
