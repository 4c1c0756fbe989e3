// Fits the specular occlusion of sdk/src/nnao/lighting.h to ray tracing in procedural scenes. Most samples
// have AO and bent normals of a network after the pass's filter, as hosts get them. Some have the reference's
// values.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/nnao/dataset.h"
#include "sdk/src/nnao/lighting.h"

namespace nook::bake::nnao {

struct SpecularFitSettings {
  // The fit reads scenes, views, points_per_view, rays, size and seed. It does not prefer pixels that are not
  // flat, because a host lights all of them.
  DatasetSettings data{.scenes = 192, .views = 960, .points_per_view = 300, .rays = 256};
  std::uint32_t taps = 9;   // for the network
  std::uint32_t rays = 64;  // for each of five roughnesses
  std::uint32_t steps = 40000;
  std::uint64_t seed = 1;
};

// A point with the open share of its reflections.
struct SpecularSample {
  static constexpr std::size_t gloss_count = 5;

  nook::nnao::LitPixel reference, network;
  std::array<float, gloss_count> roughness{}, visible{};
};

struct SpecularSamples {
  std::vector<SpecularSample> training, validation;  // the last sixth of the scenes is for validation
};
// Any number of threads gives the same bits. Each view has one radius. Its length on the screen has a uniform
// logarithm from 12 to 110 pixels at the view's median depth. Return false from progress to stop, which
// throws Failure(CANCELLED).
SpecularSamples trace_specular_samples(const nook::nnao::Network& network,
                                       const SpecularFitSettings& settings,
                                       const DatasetProgress& progress = {});

nook::nnao::SpecularNumbers fit_specular(const std::vector<SpecularSample>& samples,
                                         const SpecularFitSettings& settings);

// Mean squared errors over the samples with the network's AO.
struct SpecularError {
  double fitted = 0;
  double lagarde = 0;  // by S. Lagarde's form of the same AO
};
SpecularError specular_error(const std::vector<SpecularSample>& samples,
                             const nook::nnao::SpecularNumbers& numbers);

// Returns the share of a reflection that AO leaves, by S. Lagarde, C. de Rousiers, Moving Frostbite to PBR,
// 2014. facing is dot(normal, viewer).
float lagarde_occlusion(float ao, float facing, float roughness);

// Returns shaders/nnao/specular_numbers.h.
std::string specular_header(const nook::nnao::SpecularNumbers& numbers, const SpecularFitSettings& settings);

}  // namespace nook::bake::nnao
