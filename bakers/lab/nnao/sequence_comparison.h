// Measures means of AO over the frames of a moving camera, against ray tracing and against the same pass
// without them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/lab/nnao/measured_view.h"
#include "platform/platform.h"

namespace nook::lab {

// A view is the last of this many frames.
inline constexpr std::size_t sequence_frames = 8;

// The result of a pass at the end of a path.
struct SequenceError {
  int taps = 0;
  int frames = 1;  // frames from the cut to the view; 1: each frame alone
  double mse = 0;
  double disoccluded_mse = 0;  // over surfaces that the frame before does not show; 0 without any
  double change = 0;           // mean change of a surface's AO between frames
};

struct SequenceView {
  std::string scene, source, camera;
  double step_px = 0;  // mean motion on the screen between frames, over surfaces that both show
  std::size_t surfaces = 0, disoccluded = 0;  // pixels
  std::vector<SequenceError> errors;
};

// The view needs a path of sequence_frames. Draws the pass by the public interface, with the embedded
// network. The request uses the view's radius.
SequenceView measure_sequence(platform::Context& context, const MeasuredView& view,
                              measure::AoRequest request);

// Views with fewer disoccluded pixels do not count in ratios over them, because they would be chance.
inline constexpr std::size_t fewest_disoccluded = 100;

// Members `rows`: means over each source's views and over the sources, with the columns of
// docs/lab/nnao_protocol.md; `ratios`: of errors; `views`: each view and pass. views: one or more.
nlohmann::ordered_json sequence_report(std::span<const SequenceView> views, std::uint64_t seed);

std::string sequence_markdown(const nlohmann::ordered_json& report);

}  // namespace nook::lab
