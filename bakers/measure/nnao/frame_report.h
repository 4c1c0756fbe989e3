// The rows of `nook evaluate nnao --frame`, and their means over frames.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/measure/nnao/frame_comparison.h"

namespace nook::measure {

// One object for each row. Differences are those from the recorded AO, null for a frame without; errors those
// against the oracle, null without one. network is null for the baselines and the oracles.
nlohmann::ordered_json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                                  std::span<const FrameRow> rows);

// For each method and number of taps the means over the frames that have the number, as a row of the frame
// "mean"; none for fewer than two frames. The difference largest_difference is the largest. rows: those of
// frame_rows of every frame in turn.
nlohmann::ordered_json frame_mean_rows(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
