// Every method over one recorded frame: its AO against the recorded AO, and against the oracle; and the rows
// of a report.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bakers/measure/nnao/frame_replay.h"

namespace nook::measure {

inline constexpr char recorded_name[] = "recorded", replayed_name[] = "replayed",
                      file_name[] = "nnao_file";  // the recorded settings with another network

// An image of AO against another one, over all pixels, both rounded to 8 bits.
struct AoDifference {
  double mean = 0;          // of |a - b|
  double largest = 0;       // of |a - b|
  double share_beyond = 0;  // of the pixels that differ by more than one step
};
AoDifference difference_of(std::span<const float> a, std::span<const float> b);

struct FrameRow {
  std::string method;
  nook::nnao::RecordedPass pass;  // of the library's pass; taps alone for the others
  bool is_library = false;        // drawn by the library's pass
  std::string network;            // of the library's pass: recorded, embedded or file
  std::vector<float> ao;          // with the frame's intensity, power, layer and view
  // None of the recorded row itself, and of other methods than the library's where the recorded AO has a
  // layer, intensity or power, which they have not.
  std::optional<AoDifference> from_recorded;
  // Over pixels with a surface, of AO without intensity, power and layer.
  std::optional<double> oracle_mse, oracle_bias;
};

// Names in tables or name:taps; empty: the library's rows and the oracle.
using MethodFilter = std::vector<std::string>;

// The names of the library's rows that a filter can have for every frame.
std::vector<std::string> frame_method_names();

// A method of another room, as a row of a frame.
struct FrameMethod {
  std::string name;  // in tables
  int taps = 0;
  std::function<std::vector<float>(const FrameReplay&)> draw;  // returns the AO of the frame's pixels
};

// other_network: the file of a network that is measured as well; empty: none. progress counts methods; false
// stops, which throws Failure(CANCELLED). further: methods that are drawn where the filter names them. The
// order of the rows: recorded, replayed, nnao_file, the presets, the further methods, the oracles. A frame
// without a perspective has none of the last two.
std::vector<FrameRow> compare_frame(FrameReplay& replay, const nook::nnao::Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress,
                                    std::span<const FrameMethod> further = {});

// The rows of `nook evaluate nnao --frame`.
// One object for each row. Differences are those from the recorded AO, null for a frame without; errors those
// against the oracle, null without one. network is null for other methods than the library's.
nlohmann::ordered_json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                                  std::span<const FrameRow> rows);

// For each method and number of taps the means over the frames that have the number, as a row of the frame
// "mean"; none for fewer than two frames. The difference largest_difference is the largest. rows: those of
// frame_rows of every frame in turn.
nlohmann::ordered_json frame_mean_rows(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
