// Draws one recorded frame with every method. Compares each AO image with the recorded AO and with the
// oracle, and returns the results as rows of a report.
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
  nook::nnao::RecordedPass pass;  // settings of the library's pass; rows of other methods only set `taps`
  bool is_library = false;        // drawn by the library's pass
  std::string network;            // only for the library's pass: "recorded", "embedded" or "file"
  std::vector<float> ao;          // with the frame's intensity, power, layer and view applied
  // The difference from the recorded AO. It is empty in the row of the recorded AO itself. It is also empty
  // for methods outside the library if the recorded AO has a layer, an intensity or a power, because those
  // methods do not support these settings.
  std::optional<AoDifference> from_recorded;
  // Errors relative to the oracle over all pixels with a surface. The compared images are without intensity,
  // power and layer.
  std::optional<double> oracle_mse, oracle_bias;
};

// The methods to draw. Each entry is a name as in the tables, or NAME:TAPS. If the filter is empty, the
// library's rows and the oracle are drawn.
using MethodFilter = std::vector<std::string>;

// Returns the names of the library's rows that a filter may contain for any frame.
std::vector<std::string> frame_method_names();

// A method outside the library, which gets a row of its own.
struct FrameMethod {
  std::string name;  // name of the method in tables
  int taps = 0;
  std::function<std::vector<float>(const FrameReplay&)> draw;  // returns the AO of the frame's pixels
};

// `other_network` holds the bytes of another network file to measure, or is empty. `progress` counts methods.
// If it returns false, the function throws Failure(CANCELLED). The methods in `further` are drawn if the
// filter names them. The rows are in this order: recorded, replayed, nnao_file, the presets, the methods in
// `further`, the oracles. If the frame does not have a perspective projection, there are no rows for the
// methods in `further` and for the oracles.
std::vector<FrameRow> compare_frame(FrameReplay& replay, const nook::nnao::Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress,
                                    std::span<const FrameMethod> further = {});

// Returns the rows of `nook evaluate nnao --frame`, one object each. Differences are relative to the recorded
// AO. They are null if no AO was recorded. Errors are relative to the oracle. They are null if the frame has
// no oracle. The key `network` is null for methods outside the library.
nlohmann::ordered_json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                                  std::span<const FrameRow> rows);

// Averages over frames. Returns one row for each method and tap count, with the frame name "mean". Each value
// is the mean over those frames whose value is not null. The exception is largest_difference, which is the
// maximum. `rows` must contain the rows of all frames, as frame_rows returns them. If there are fewer than
// two frames, returns no rows.
nlohmann::ordered_json frame_mean_rows(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
