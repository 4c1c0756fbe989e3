// Measures every method over the views of the scenes.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/lab/nnao/image_bias.h"
#include "bakers/lab/nnao/measured_view.h"
#include "bakers/measure/nnao/image_error.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::lab {

// The measured values of a method, over one view or several.
struct Measurement {
  measure::ImageError error;
  BorderBias border;
  Calibration calibration;
  std::vector<double> flicker;  // per view: mean absolute change of AO when the camera's image is shifted by
                                // one pixel; empty for oracles
  std::vector<double> ms;       // wall-clock time of each frame, including glFinish

  void add(const Measurement& other);
  double mean_flicker() const;
  double median_ms() const;
};

struct ComparisonRow {
  std::string method;
  int taps = 0;
  bool blurred = false;
  int fetches = 0;                 // per pixel
  std::vector<Measurement> views;  // in the order of the views
  // Name of the denoiser: the tuned denoiser of a baseline, the library's denoiser, or none.
  std::string denoiser;
};

// Combines the measurements of a row over the views with the indices `which`.
Measurement pooled(const ComparisonRow& row, std::span<const std::size_t> which);

// Names of two more rows of the embedded network: at half resolution, and with the filter run twice.
inline constexpr char half_name[] = "nnao_half", twice_name[] = "nnao_twice";

struct ComparisonSettings {
  measure::AoRequest request;  // the settings for all views; each view replaces the radius by its own
  std::vector<std::byte> other_network;  // a network file to compare with the embedded network, or empty
  std::string other_name;                // its name in tables
  // Names as in tables, or name:taps. If empty, or "all", measures all methods except the oracles.
  std::vector<std::string> methods;
  bool raw = true;  // also measures each method without its blur
};

// The AO image of one view by one method, for pictures.
struct KeptImage {
  std::string method;
  int taps = 0;
  std::size_t view = 0;
  std::vector<float> ao;
};

struct Comparison {
  std::vector<ComparisonRow> rows;
  std::vector<KeptImage> images;  // blurred
};

// `keep` says for which methods the blurred images are kept. All views must have the same size. `progress`
// counts methods. If it returns false, the function throws Failure(CANCELLED).
Comparison compare(platform::Context& context, std::span<const MeasuredView> views,
                   const ComparisonSettings& settings,
                   const std::function<bool(const std::string& method, int taps)>& keep,
                   const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace nook::lab
