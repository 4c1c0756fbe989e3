// Measures temporally accumulated AO while the camera moves. The report compares it with ray tracing, and
// with the same pass without accumulation.
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

// Number of frames in a sequence. The measured view is the last one.
inline constexpr std::size_t sequence_frames = 8;

// The result of a pass at the end of a path.
struct SequenceError {
  int taps = 0;
  int frames = 1;  // number of frames since the camera cut; 1: frames are not accumulated
  double mse = 0;
  // Mean squared error over surfaces that the previous frame does not show; 0 if there are none.
  double disoccluded_mse = 0;
  double change = 0;  // mean change of a surface's AO between frames
};

struct SequenceView {
  std::string scene, source, camera;
  // Mean motion on the screen from frame to frame, over the surfaces that both frames show.
  double step_px = 0;
  std::size_t surfaces = 0, disoccluded = 0;  // pixels
  std::vector<SequenceError> errors;
};

// The path of the view must have sequence_frames frames. Draws the pass through the public interface, with
// the embedded network. The radius of the request is replaced by the radius of the view.
SequenceView measure_sequence(platform::Context& context, const MeasuredView& view,
                              measure::AoRequest request);

// Views with fewer disoccluded pixels than this are left out of the ratios over disoccluded pixels, because
// their errors would be mostly noise.
inline constexpr std::size_t fewest_disoccluded = 100;

// Returns an object with three members. `rows` has the means over the views of each source, and over all
// sources, with the columns of docs/lab/nnao_protocol.md. `ratios` has ratios of errors. `views` has one
// entry for each view and pass. The argument `views` must not be empty.
nlohmann::ordered_json sequence_report(std::span<const SequenceView> views, std::uint64_t seed);

std::string sequence_markdown(const nlohmann::ordered_json& report);

}  // namespace nook::lab
