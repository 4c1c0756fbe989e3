// Checks the ranges of the AO settings. The same ranges are valid for the settings of a host's frame and of a
// recording.
#pragma once

#include <cstddef>

#include "sdk/src/core/checks.h"

namespace nook::nnao {

// Messages print a name such as "desc.fade_end" from this offset on. Messages about a descriptor print the
// whole name. Messages about a recording skip "desc.".
inline constexpr std::size_t name_in_desc = 0, name_in_recording = 5;

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if a setting is out of range. Frame is a type with the members
// of nook_nnao_frame_desc that are checked here.
template <class Frame>
void check_shape(const Frame& frame, std::size_t name) {
  check_fits(&"desc.max_radius_px"[name], frame.max_radius_px,
             frame.max_radius_px == 0 || frame.max_radius_px >= 1, "at least 1 pixel, or 0 for the default");
  check_fits(&"desc.min_radius_px"[name], frame.min_radius_px, frame.min_radius_px >= 0,
             "0 or more pixels, 0 for no minimum");
  check_fits(&"desc.fade_begin"[name], frame.fade_begin, frame.fade_begin >= 0, "0 or more metres");
  check_fits(&"desc.fade_end"[name], frame.fade_end,
             frame.fade_end > frame.fade_begin || (frame.fade_end == 0 && frame.fade_begin == 0),
             "more metres than fade_begin, or 0 for both and no fade");
  check_fits(&"desc.intensity"[name], frame.intensity, frame.intensity >= 0 && frame.intensity <= 16,
             "0 to 16");
  check_fits(&"desc.power"[name], frame.power, frame.power > 0 && frame.power <= 16, "more than 0, up to 16");
}

}  // namespace nook::nnao
