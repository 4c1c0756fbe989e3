#include "bakers/nnao/specular_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bakers/algebra/adam.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::nnao {

using nook::nnao::LitPixel;
using nook::nnao::SpecularNumbers;

namespace {

constexpr int inputs = SpecularNumbers::inputs, units = SpecularNumbers::units;

// The number of parameters of the fit. Adam sees them as an array in the order of SpecularNumbers.
constexpr std::size_t number_count = sizeof(SpecularNumbers) / sizeof(float);
static_assert(number_count == (inputs + 2) * units + 1);

SpecularNumbers numbers_of(std::span<const float> parameters) {
  SpecularNumbers numbers;
  std::size_t next = 0;
  const auto take = [&](std::array<float, units>& row) {
    std::copy_n(parameters.begin() + std::ptrdiff_t(next), row.size(), row.begin());
    next += row.size();
  };
  for (auto& row : numbers.weights) take(row);
  take(numbers.bias);
  take(numbers.out);
  numbers.out_bias = parameters.back();
  return numbers;
}

// Adds the gradient of one value's squared error with respect to each parameter. Returns the squared error.
// The gradient ignores the clamp, so that values outside the range move back.
double add_gradient(std::span<const float> parameters, const LitPixel& pixel, float roughness, float visible,
                    float weight, std::span<float> gradient) {
  const auto x = nook::nnao::specular_inputs(pixel, roughness);
  const SpecularNumbers numbers = numbers_of(parameters);
  const float error = nook::nnao::specular_occlusion(numbers, pixel, roughness) - visible;
  const float rough = roughness * roughness * roughness * roughness;
  // The derivative of the squared error with respect to `hidden`.
  const float g_hidden = -2 * weight * error * x[0] * (1 - rough);
  for (int u = 0; u < units; ++u) {
    float sum = numbers.bias[std::size_t(u)];
    for (int i = 0; i < inputs; ++i)
      sum += numbers.weights[std::size_t(i)][std::size_t(u)] * x[std::size_t(i)];
    if (sum <= 0) continue;
    const float g_sum = g_hidden * numbers.out[std::size_t(u)];
    for (int i = 0; i < inputs; ++i) gradient[std::size_t(i * units + u)] += g_sum * x[std::size_t(i)];
    gradient[std::size_t(inputs * units + u)] += g_sum;
    gradient[std::size_t((inputs + 1) * units + u)] += g_hidden * sum;
  }
  gradient.back() += g_hidden;
  return double(error) * double(error);
}

double squared(float x) {
  return double(x) * double(x);
}

}  // namespace

float lagarde_occlusion(float ao, float facing, float roughness) {
  const float power = std::exp2(-16 * roughness - 1);
  return std::clamp(std::pow(std::max(facing, 0.0f) + ao, power) - 1 + ao, 0.0f, 1.0f);
}

namespace {

constexpr std::uint32_t batch = 512;
constexpr float rate = 1e-2f;

// A fit in progress.
struct Fit {
  std::vector<float> parameters;
  Adam adam{number_count};
  double loss = 0;  // mean over the last steps
};

Fit start_fit(Random& random) {
  Fit fit;
  const float reach = 1 / std::sqrt(float(inputs)), out_reach = 1 / std::sqrt(float(units));
  for (int i = 0; i < (inputs + 1) * units; ++i) fit.parameters.push_back(random.between(-reach, reach));
  for (int i = 0; i < units; ++i) fit.parameters.push_back(random.between(-out_reach, out_reach));
  fit.parameters.push_back(0);
  return fit;
}

// Takes one step. Returns the error of the batch before the step.
double step_fit(Fit& fit, const std::vector<SpecularSample>& samples, Random& random, float step_rate) {
  std::vector<float> gradient(number_count);
  double error = 0;
  for (std::uint32_t b = 0; b < batch; ++b) {
    const SpecularSample& sample = samples[random.below(std::uint32_t(samples.size()))];
    const LitPixel& pixel = b % 16 ? sample.network : sample.reference;
    for (std::size_t i = 0; i < SpecularSample::gloss_count; ++i)
      error += add_gradient(fit.parameters, pixel, sample.roughness[i], sample.visible[i],
                            1 / float(batch * SpecularSample::gloss_count), gradient);
  }
  fit.adam.step(fit.parameters, gradient, step_rate);
  return error;
}

// Starts several fits with different initial values, and returns the best one after a part of the steps. The
// initial values matter, because a unit whose sum is negative for every sample learns nothing.
Fit best_fit(const std::vector<SpecularSample>& samples, const SpecularFitSettings& settings) {
  constexpr std::uint32_t starts = 16;
  const std::uint32_t length = settings.steps / starts + 1;
  Fit best;
  for (std::uint32_t s = 0; s < starts; ++s) {
    Random numbers(mix_bits(settings.seed + s)), order(settings.seed);
    Fit fit = start_fit(numbers);
    for (std::uint32_t i = 0; i < length; ++i) {
      const double error = step_fit(fit, samples, order, rate);
      if (2 * i >= length) fit.loss += error;
    }
    if (best.parameters.empty() || fit.loss < best.loss) best = std::move(fit);
  }
  return best;
}

}  // namespace

SpecularNumbers fit_specular(const std::vector<SpecularSample>& samples,
                             const SpecularFitSettings& settings) {
  if (samples.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the fit of specular occlusion has no samples");
  Fit fit = best_fit(samples, settings);
  Random order(mix_bits(settings.seed));
  for (std::uint32_t step = 0; step < settings.steps; ++step) {
    const double share = double(step) / double(settings.steps);
    step_fit(fit, samples, order, rate * float(0.5 + 0.5 * std::cos(std::numbers::pi * share)));
  }
  return numbers_of(fit.parameters);
}

SpecularError specular_error(const std::vector<SpecularSample>& samples, const SpecularNumbers& numbers) {
  SpecularError error;
  for (const SpecularSample& sample : samples)
    for (std::size_t i = 0; i < SpecularSample::gloss_count; ++i) {
      const LitPixel& pixel = sample.network;
      const float fitted = nook::nnao::specular_occlusion(numbers, pixel, sample.roughness[i]);
      const float facing = dot(pixel.normal, pixel.to_viewer);
      error.fitted += squared(fitted - sample.visible[i]);
      error.lagarde += squared(lagarde_occlusion(pixel.ao, facing, sample.roughness[i]) - sample.visible[i]);
    }
  const double count = double(std::max<std::size_t>(1, samples.size() * SpecularSample::gloss_count));
  return {error.fitted / count, error.lagarde / count};
}

std::string specular_header(const SpecularNumbers& numbers, const SpecularFitSettings& settings) {
  std::string text =
      "// The numbers of the specular occlusion; sdk/src/nnao/lighting.h defines them. C++ and GLSL both "
      "include\n"
      "// this file, which `nook train specular --seed ";
  text.append(std::to_string(settings.seed)).append("` writes.\n#ifndef NOOK_NNAO_SPECULAR_NUMBERS_H\n");
  text.append("#define NOOK_NNAO_SPECULAR_NUMBERS_H\n\n");
  int next = 0;
  const auto add = [&](const std::array<float, units>& row) {
    for (std::size_t first = 0; first < row.size(); first += 4) {
      char line[120];
      std::snprintf(line, sizeof line, "#define NOOK_SPECULAR_%d %.5f, %.5f, %.5f, %.5f\n", next++,
                    double(row[first]), double(row[first + 1]), double(row[first + 2]),
                    double(row[first + 3]));
      text += line;
    }
  };
  for (const auto& row : numbers.weights) add(row);
  add(numbers.bias);
  add(numbers.out);
  char line[60];
  std::snprintf(line, sizeof line, "#define NOOK_SPECULAR_BIAS %.5f\n\n#endif\n", double(numbers.out_bias));
  return text + line;
}

}  // namespace nook::bake::nnao
