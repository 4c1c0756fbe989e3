#include "bakers/measure/nnao/tuning_grid.h"

#include <algorithm>

namespace nook::measure {
namespace {

// Twentieths of a decade.
constexpr float radius_scales[] = {0.28f, 0.32f, 0.36f, 0.40f, 0.45f, 0.50f, 0.56f, 0.63f, 0.71f, 0.80f,
                                   0.90f, 1.00f, 1.12f, 1.26f, 1.41f, 1.60f, 1.80f, 2.00f, 2.24f, 2.50f,
                                   2.80f, 3.20f, 3.60f, 4.00f, 4.50f, 5.00f, 5.60f, 6.30f, 7.10f, 8.00f};
constexpr float powers[] = {0.28f, 0.32f, 0.36f, 0.40f, 0.45f, 0.50f, 0.56f, 0.63f, 0.71f, 0.80f, 0.90f,
                            1.00f, 1.12f, 1.26f, 1.41f, 1.60f, 1.80f, 2.00f, 2.24f, 2.50f, 2.80f, 3.20f,
                            3.60f, 4.00f, 4.50f, 5.00f, 5.60f, 6.30f, 7.10f, 8.00f, 9.00f, 10.0f};
constexpr float nothing[] = {0};
constexpr float ssao_plus_biases[] = {0,     0.005f, 0.01f, 0.02f, 0.03f, 0.045f,
                                      0.06f, 0.08f,  0.1f,  0.14f, 0.2f};
constexpr float hbao_biases[] = {0, 0.05f, 0.1f, 0.15f, 0.2f, 0.25f, 0.3f, 0.35f, 0.45f, 0.6f, 0.8f};
constexpr float gtao_falloffs[] = {0, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 0.95f};
constexpr float thicknesses[] = {0.035f, 0.05f, 0.07f, 0.1f, 0.14f, 0.2f, 0.28f,
                                 0.4f,   0.56f, 0.8f,  1.1f, 1.6f,  2.2f, 3.2f};
constexpr float xegtao_falloffs[] = {0.02f, 0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.615f, 0.7f, 0.8f, 0.9f, 1};
constexpr float n8ao_falloffs[] = {0.05f, 0.07f, 0.1f, 0.14f, 0.2f, 0.28f, 0.4f,
                                   0.56f, 0.8f,  1.1f, 1.6f,  2.2f, 3.2f};
constexpr float s4ao_falloffs[] = {0.005f, 0.007f, 0.01f, 0.014f, 0.02f, 0.028f, 0.04f, 0.056f,
                                   0.08f,  0.11f,  0.16f, 0.22f,  0.32f, 0.45f,  0.63f};
constexpr float qgis_thresholds[] = {0.2f,  0.25f, 0.3f,  0.35f, 0.4f,  0.45f, 0.5f,
                                     0.55f, 0.6f,  0.65f, 0.7f,  0.75f, 0.8f};
constexpr float compensations[] = {0, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 1, 1.4f, 2, 2.8f, 4};

std::span<const float> shapes(Baseline baseline) {
  switch (baseline) {
    case Baseline::ssao:
      return nothing;
    case Baseline::ssao_plus:
    case Baseline::vtk:
    case Baseline::filament:
      return ssao_plus_biases;
    case Baseline::n8ao:
      return n8ao_falloffs;
    case Baseline::s4ao:
      return s4ao_falloffs;
    case Baseline::qgis:
      return qgis_thresholds;
    case Baseline::hbao:
      return hbao_biases;
    case Baseline::gtao:
      return gtao_falloffs;
    case Baseline::bitmask:
      return thicknesses;
    default:
      return xegtao_falloffs;
  }
}

float value(Baseline baseline, const TuningPlace& place, std::size_t axis) {
  return axis_values(baseline, axis)[std::size_t(place.at[axis])];
}

}  // namespace

std::span<const float> axis_values(Baseline baseline, std::size_t axis) {
  switch (axis) {
    case 0:
      return radius_scales;
    case 1:
      return powers;
    case 2:
      return shapes(baseline);
    default:
      return baseline == Baseline::xegtao ? std::span<const float>(compensations) : nothing;
  }
}

BaselineTuning tuning_at(Baseline baseline, const TuningPlace& place) {
  return {value(baseline, place, 0),
          value(baseline, place, 1),
          value(baseline, place, 2),
          value(baseline, place, 3),
          place.equal_weights,
          place.border,
          place.denoiser};
}

TuningPlace first_place(Baseline baseline) {
  TuningPlace place;
  place.at[0] = int(std::ranges::find(radius_scales, 1.0f) - radius_scales);
  place.at[1] = int(std::ranges::find(powers, 1.0f) - powers);
  place.at[2] = int(shapes(baseline).size() / 2);
  const std::span<const Denoiser> denoisers = denoisers_of(baseline);
  const bool has_edges = std::ranges::find(denoisers, Denoiser::edges_2) != denoisers.end();
  place.denoiser = has_edges ? Denoiser::edges_2 : denoisers.back();
  return place;
}

std::vector<std::string> axes_at_edge(Baseline baseline, const TuningPlace& place) {
  std::vector<std::string> found;
  for (std::size_t axis = 0; axis < tuned_axes; ++axis) {
    const std::span<const float> values = axis_values(baseline, axis);
    const bool first = place.at[axis] == 0, last = place.at[axis] + 1 == int(values.size());
    const bool complete = baseline == Baseline::xegtao && axis == 2;
    if (values.size() > 1 && !complete && ((first && values.front() != 0) || last))
      found.push_back(axis_names[axis]);
  }
  return found;
}

}  // namespace nook::measure
