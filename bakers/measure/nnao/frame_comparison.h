// Draws one recorded frame with every method. Compares the AO with the recorded AO and with the oracle, and
// makes rows of a report.
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
  nook::nnao::RecordedPass pass;  // settings of the library's pass; other methods only set `taps`
  bool is_library = false;        // drawn by the library's pass
  std::string network;            // for the library's pass: recorded, embedded or file
  std::vector<float> ao;          // with the frame's intensity, power, layer and view applied
  // Empty for the recorded row itself. Also empty for methods outside the library if the recorded AO has a
  // layer, intensity or power, because those methods do not support them.
  std::optional<AoDifference> from_recorded;
  // Errors over pixels with a surface, without intensity, power and layer.
  std::optional<double> oracle_mse, oracle_bias;
};

// Names of methods as in tables, or NAME:TAPS. If empty, uses the library's rows and the oracle.
using MethodFilter = std::vector<std::string>;

// Returns the names of the library's rows that a filter may contain for any frame.
std::vector<std::string> frame_method_names();

// A method outside the library, which gets a row of its own.
struct FrameMethod {
  std::string name;  // as in tables
  int taps = 0;
  std::function<std::vector<float>(const FrameReplay&)> draw;  // returns the AO of the frame's pixels
};

// `other_network` is the file of another network to measure; empty for none. `progress` counts methods; if it
// returns false, the function throws Failure(CANCELLED). The methods in `further` are drawn if the filter
// names them. The order of the rows is recorded, replayed, nnao_file, the presets, the methods in `further`,
// the oracles. A frame without a perspective projection has no rows for `further` and the oracles.
std::vector<FrameRow> compare_frame(FrameReplay& replay, const nook::nnao::Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress,
                                    std::span<const FrameMethod> further = {});

// Returns the rows of `nook evaluate nnao --frame`, one object each. Differences are relative to the recorded
// AO. They are null if no AO was recorded. Errors are relative to the oracle. They are null if the frame has
// no oracle. The key `network` is null for methods outside the library.
nlohmann::ordered_json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                                  std::span<const FrameRow> rows);

// Averages over frames. Returns one row with the frame name "mean" for each method and tap count. Each value
// is the mean over the frames that have the value, but largest_difference is the maximum. `rows` are the rows
// of all frames, made by frame_rows. Returns no rows for fewer than two frames.
nlohmann::ordered_json frame_mean_rows(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
