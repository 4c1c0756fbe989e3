#include "bakers/nnao/specular_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numbers>

#include "bakers/nnao/adam.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/specular_visibility.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::nnao {

using nook::nnao::LitPixel;
using nook::nnao::SpecularNumbers;

namespace {

constexpr int inputs = SpecularNumbers::inputs, units = SpecularNumbers::units;

// The numbers in a row, as Adam takes them, in the order of SpecularNumbers.
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

// AO and bent normal of a network about as they are after the filter, which stops at edges and lines: the
// means over some of the noise values.
constexpr std::uint32_t averaged_noise = 2;

LitPixel network_pixel(const nook::nnao::Network& network, const TracedView& view, const DataPoint& point,
                       Vec3 to_viewer, std::uint32_t taps, Random& random) {
  LitPixel pixel{{}, point.normal, to_viewer, 0};
  const std::uint32_t first = random.below(NOOK_NOISE_COUNT);
  for (std::uint32_t i = 0; i < averaged_noise; ++i) {
    const std::uint32_t rank = (first + 4 * i) % NOOK_NOISE_COUNT;
    const nook::nnao::Openness open = nook::nnao::evaluate_openness(
        network, view.view(), point.normal, {point.radius, Dataset::max_radius_px + 1, taps}, point.x,
        point.y, nook::nnao::tap_noise_of_rank(rank));
    pixel.ao += std::clamp(open.ao, 0.0f, 1.0f) / float(averaged_noise);
    pixel.bent_normal += open.bent_normal;
  }
  pixel.bent_normal = normalised(pixel.bent_normal);
  return pixel;
}

LitPixel reference_pixel(const DataPoint& point, Vec3 to_viewer) {
  const Vec3 bent = normalised(point.open_direction);
  return {length(bent) > 0 ? bent : point.normal, point.normal, to_viewer, point.ao};
}

SpecularSample trace_sample(const RayScene& rays, const TracedView& view, const DataPoint& point,
                            const nook::nnao::Network& network, const SpecularFitSettings& settings,
                            std::uint64_t seed) {
  const Camera& camera = view.camera;
  const float depth = view.depth[std::size_t(point.y) * camera.width + point.x];
  const PixelRay ray = pixel_ray(camera, float(point.x) + 0.5f, float(point.y) + 0.5f);
  const Vec3 to_viewer_ws = normalised(-ray.direction_ws);
  const Vec3 to_viewer = view_direction(camera, to_viewer_ws);
  SpecularSample sample;
  sample.reference = reference_pixel(point, to_viewer);
  const Vec3 position = ray.origin_ws + depth * ray.direction_ws;
  const GlossyPoint glossy{position, transform_vector(camera.world_from_view, point.normal), to_viewer_ws,
                           point.radius, origin_offset(position, depth, point.radius)};
  Random random(seed);
  sample.network = network_pixel(network, view, point, to_viewer, settings.taps, random);
  for (std::size_t i = 0; i < SpecularSample::gloss_count; ++i) {
    sample.roughness[i] = (float(i) + random.between(0.1f, 1)) / float(SpecularSample::gloss_count);
    sample.visible[i] =
        trace_specular_visibility(rays, glossy, sample.roughness[i], settings.rays, random.bits());
  }
  return sample;
}

// Adds the gradient of the squared error of one value for each number, and returns the error squared. The
// gradient passes through the clamp, so that values outside it come back.
double add_gradient(std::span<const float> parameters, const LitPixel& pixel, float roughness, float visible,
                    float weight, std::span<float> gradient) {
  const auto x = nook::nnao::specular_inputs(pixel, roughness);
  const SpecularNumbers numbers = numbers_of(parameters);
  const float error = nook::nnao::specular_occlusion(numbers, pixel, roughness) - visible;
  const float rough = roughness * roughness * roughness * roughness;
  // The derivative of the occlusion for `hidden`.
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

SpecularSamples trace_specular_samples(const nook::nnao::Network& network,
                                       const SpecularFitSettings& settings, const DatasetProgress& progress) {
  const Dataset data = make_dataset(settings.data);
  const std::uint32_t scenes = settings.data.scenes;
  std::vector<std::vector<const DataPoint*>> of_scene(scenes);
  for (const auto* part : {&data.training, &data.validation})
    for (const DataPoint& point : *part) of_scene[point.view % scenes].push_back(&point);
  std::vector<std::vector<SpecularSample>> samples(scenes);
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::uint32_t(0), scenes, [&](std::uint32_t s) {
    if (cancelled) return;
    const FlushDenormals flush;
    const RayScene rays(make_scene(settings.data.seed, s).soup);
    for (std::size_t i = 0; i < of_scene[s].size(); ++i) {
      const DataPoint& point = *of_scene[s][i];
      samples[s].push_back(trace_sample(rays, data.views[point.view], point, network, settings,
                                        mix_bits(settings.seed ^ mix_bits(s * 1000003ull + i))));
    }
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    if (!progress(++done, scenes)) cancelled = true;
  });
  if (cancelled) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing reflections");
  SpecularSamples result;
  const std::uint32_t first_validation = scenes - scenes / 6;
  for (std::uint32_t s = 0; s < scenes; ++s) {
    auto& part = s < first_validation ? result.training : result.validation;
    part.insert(part.end(), samples[s].begin(), samples[s].end());
  }
  return result;
}

namespace {

constexpr std::uint32_t batch = 512;
constexpr float rate = 1e-2f;

// A fit under way.
struct Fit {
  std::vector<float> parameters;
  Adam adam{number_count};
  double loss = 0;  // of the last steps
};

Fit start_fit(Random& random) {
  Fit fit;
  const float reach = 1 / std::sqrt(float(inputs)), out_reach = 1 / std::sqrt(float(units));
  for (int i = 0; i < (inputs + 1) * units; ++i) fit.parameters.push_back(random.between(-reach, reach));
  for (int i = 0; i < units; ++i) fit.parameters.push_back(random.between(-out_reach, out_reach));
  fit.parameters.push_back(0);
  return fit;
}

// Returns the error of the batch before the step.
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

// Units whose sums are below 0 everywhere learn nothing, so that fits differ by their first numbers. Returns
// the best of several after a part of the steps.
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
