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

// A method's numbers over one view, or over several.
struct Measurement {
  measure::ImageError error;
  BorderBias border;
  Calibration calibration;
  std::vector<double> flicker;  // per view: mean |change| of a surface's AO when the image slides by one
                                // pixel; empty for an oracle
  std::vector<double> ms;       // wall clock of each frame, including glFinish

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
  std::string denoiser;            // the tuned denoiser of a baseline, the library's, or none
};

// Returns a row's numbers over some views. which: indices of views.
Measurement pooled(const ComparisonRow& row, std::span<const std::size_t> which);

// Names further rows of the embedded network: at half resolution, and with the filter twice.
inline constexpr char half_name[] = "nnao_half", twice_name[] = "nnao_twice";

struct ComparisonSettings {
  measure::AoRequest request;            // uses each view's radius
  std::vector<std::byte> other_network;  // a network file to compare with the embedded one; empty: none
  std::string other_name;                // in tables
  // Names as in tables, or name:taps. empty: all but the oracles; so does "all".
  std::vector<std::string> methods;
  bool raw = true;  // also measure each method without its blur
};

// A method's AO of a view, for pictures.
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

// keep: keeps a method's blurred images. Views need one size. progress counts methods; false stops, which
// throws Failure(CANCELLED).
Comparison compare(platform::Context& context, std::span<const MeasuredView> views,
                   const ComparisonSettings& settings,
                   const std::function<bool(const std::string& method, int taps)>& keep,
                   const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace nook::lab
