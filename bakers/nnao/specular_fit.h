// Fits the specular occlusion of sdk/src/nnao/lighting.h to ray tracing in procedural scenes. Most samples
// use the AO and the bent normal that hosts get: the network's output after the pass's filter. Some samples
// use the reference AO and bent normal.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/nnao/dataset.h"
#include "sdk/src/nnao/lighting.h"

namespace nook::bake::nnao {

struct SpecularFitSettings {
  // The fit reads the fields scenes, views, points_per_view, rays, width, height and seed. It chooses flat
  // pixels as often as others, because a host lights all pixels.
  DatasetSettings data{.scenes = 192, .views = 960, .points_per_view = 300, .rays = 256};
  std::uint32_t taps = 9;   // taps of the network
  std::uint32_t rays = 64;  // rays for each of the five roughness values
  std::uint32_t steps = 40000;
  std::uint64_t seed = 1;
};

// A point, and the unoccluded share of its reflection at each roughness.
struct SpecularSample {
  static constexpr std::size_t gloss_count = 5;

  nook::nnao::LitPixel reference, network;
  std::array<float, gloss_count> roughness{}, visible{};
};

struct SpecularSamples {
  std::vector<SpecularSample> training, validation;  // the last sixth of the scenes is the validation set
};
// Returns the same bits on any number of threads. All pixels of a view use the same radius in metres. At the
// view's median depth, its length on the screen is log-uniform from 12 to 110 pixels. Return false from
// `progress` to stop; the function then throws Failure(CANCELLED).
SpecularSamples trace_specular_samples(const nook::nnao::Network& network,
                                       const SpecularFitSettings& settings,
                                       const DatasetProgress& progress = {});

nook::nnao::SpecularNumbers fit_specular(const std::vector<SpecularSample>& samples,
                                         const SpecularFitSettings& settings);

// Mean squared errors over all samples, evaluated with the network's AO.
struct SpecularError {
  double fitted = 0;
  double lagarde = 0;  // error of lagarde_occlusion with the same AO
};
SpecularError specular_error(const std::vector<SpecularSample>& samples,
                             const nook::nnao::SpecularNumbers& numbers);

// Returns the unoccluded share of a reflection, estimated from AO alone (S. Lagarde, C. de Rousiers, Moving
// Frostbite to PBR, 2014). `facing` is dot(normal, viewer).
float lagarde_occlusion(float ao, float facing, float roughness);

// Returns the text of shaders/nnao/specular_numbers.h.
std::string specular_header(const nook::nnao::SpecularNumbers& numbers, const SpecularFitSettings& settings);

}  // namespace nook::bake::nnao
