// Every method over the views of one scene.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/border_bias.h"
#include "bakers/measure/nnao/measured_view.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::measure {

struct ComparisonRow {
  std::string method;
  int taps = 0;
  bool blurred = false;
  double mse = 0, ssim = 0, correlation = 0;
  bake::nnao::BorderBias border;
  double flicker = 0;  // mean |change| of a surface's AO when the image slides by one pixel
  int fetches = 0;     // a pixel
  double ms = 0;       // median wall clock of a frame, round glFinish
};

struct ComparisonSettings {
  AoRequest request;                     // its radius is each view's
  std::vector<std::byte> other_network;  // a file beside the embedded one; empty: none
  std::string other_name;                // in tables
  std::vector<std::string> methods;      // names in tables; empty: all
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

// keep: whether a method's blurred images are kept. Views have one size. progress counts methods; false
// stops, which throws Failure(CANCELLED).
Comparison compare(platform::Context& context, std::span<const MeasuredView> views,
                   const ComparisonSettings& settings,
                   const std::function<bool(const std::string& method, int taps)>& keep,
                   const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace nook::measure
