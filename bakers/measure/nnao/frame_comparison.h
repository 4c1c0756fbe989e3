// Draws one recorded frame by every method, and compares the AO with the recorded AO and with the oracle, in
// rows of a report.
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

// Compares one AO image with another over all pixels. Both are rounded to 8 bits.
struct AoDifference {
  double mean = 0;          // mean |a - b|
  double largest = 0;       // largest |a - b|
  double share_beyond = 0;  // share of pixels that differ by more than one step
};
AoDifference difference_of(std::span<const float> a, std::span<const float> b);

struct FrameRow {
  std::string method;
  nook::nnao::RecordedPass pass;  // settings of the library's pass; other methods have taps only
  bool is_library = false;        // drawn by the library's pass
  std::string network;            // for the library's pass: recorded, embedded or file
  std::vector<float> ao;          // with the frame's intensity, power, layer and view
  // Empty for the recorded row itself. Also empty for other methods if the recorded AO has a layer, intensity
  // or power, because they have none.
  std::optional<AoDifference> from_recorded;
  // Errors over pixels with a surface, without intensity, power and layer.
  std::optional<double> oracle_mse, oracle_bias;
};

// Names as in tables, or name:taps. Empty: the library's rows and the oracle.
using MethodFilter = std::vector<std::string>;

// Returns the names of the library's rows that a filter may have for every frame.
std::vector<std::string> frame_method_names();

// A method from elsewhere, as a row of a frame.
struct FrameMethod {
  std::string name;  // as in tables
  int taps = 0;
  std::function<std::vector<float>(const FrameReplay&)> draw;  // returns the AO of the frame's pixels
};

// other_network: the file of a further network to measure; empty: none. progress counts methods; false stops,
// which throws Failure(CANCELLED). further: methods that are drawn if the filter names them. The order of the
// rows is recorded, replayed, nnao_file, the presets, the further methods, the oracles. A frame without a
// perspective lacks the last two.
std::vector<FrameRow> compare_frame(FrameReplay& replay, const nook::nnao::Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress,
                                    std::span<const FrameMethod> further = {});

// Returns the rows of `nook evaluate nnao --frame`, one object each. Differences are from the recorded AO,
// and null without one. Errors are from the oracle, and null without one. network is null for methods other
// than the library's.
nlohmann::ordered_json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                                  std::span<const FrameRow> rows);

// Returns for each method and number of taps the means over the frames that have the number, as a row of the
// frame "mean". largest_difference is the largest. Returns nothing for fewer than two frames. rows: the rows
// of all frames, each made by frame_rows.
nlohmann::ordered_json frame_mean_rows(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
