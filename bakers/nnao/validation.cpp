#include "bakers/nnao/validation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::bake::nnao {
namespace {

// Returns the mean of term(point), summed in a fixed order.
template <class Term>
double mean_over(const Dataset& data, std::size_t stride, const Term& term) {
  std::vector<double> terms((data.validation.size() + stride - 1) / stride);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, terms.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) terms[i] = term(data.validation[i * stride]);
  });
  double sum = 0;
  for (const double value : terms) sum += value;
  return sum / double(std::max<std::size_t>(1, terms.size()));
}

double squared(double x) {
  return x * x;
}

}  // namespace

namespace {

constexpr float dark_below = 0.35f, bent_below = 0.7f;

double degrees_between(Vec3 a, Vec3 b) {
  return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

// Returns the middle value. For an even count, returns the upper of the two middle values. Returns 0 if there
// are no values.
double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The network's output at one point: with the noise value of the point's pixel, and the mean over all noise
// values.
struct PointOutput {
  double own = 0, mean = 0;  // AO
  Vec3 bent_normal;          // from the mean over all noise values
};

PointOutput output_of(const nook::nnao::Network& network, const Dataset& data, const DataPoint& point,
                      std::uint32_t taps) {
  const View view = data.views[point.view].view();
  const nook::nnao::Sampling sampling{point.radius, Dataset::max_radius_px + 1, taps};
  PointOutput output;
  for (std::uint32_t y = 0; y < NOOK_NOISE_SIZE; ++y)
    for (std::uint32_t x = 0; x < NOOK_NOISE_SIZE; ++x) {
      const nook::nnao::Openness open =
          nook::nnao::evaluate_openness(network, view, point.normal, sampling, point.x, point.y,
                                        nook::nnao::tap_noise(point.x + x, point.y + y));
      const double ao = std::clamp(double(open.ao), 0.0, 1.0);
      output.mean += ao / NOOK_NOISE_COUNT;
      output.bent_normal = output.bent_normal + open.bent_normal;
      if (x == 0 && y == 0) output.own = ao;
    }
  output.bent_normal = normalised(output.bent_normal);
  return output;
}

}  // namespace

ValidationRow validate(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                       std::size_t stride) {
  std::vector<PointOutput> outputs((data.validation.size() + stride - 1) / stride);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, outputs.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      outputs[i] = output_of(network, data, data.validation[i * stride], taps);
  });
  ValidationRow row{taps};
  double dark = 0;
  std::vector<double> bent, normal;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const DataPoint& point = data.validation[i * stride];
    const double ao = double(point.ao);
    row.mse += squared(outputs[i].own - ao) / double(outputs.size());
    row.mse_blurred += squared(outputs[i].mean - ao) / double(outputs.size());
    if (point.ao < dark_below) {
      row.dark_bias += outputs[i].mean - ao;
      ++dark;
    }
    const Vec3 reference = normalised(point.open_direction);
    if (point.ao >= bent_below || length(reference) == 0) continue;
    bent.push_back(degrees_between(outputs[i].bent_normal, reference));
    normal.push_back(degrees_between(point.normal, reference));
  }
  row.dark_bias /= std::max(dark, 1.0);
  row.bent_angle = median(std::move(bent));
  row.normal_angle = median(std::move(normal));
  return row;
}

double validation_mse(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                      std::size_t stride) {
  return mean_over(data, stride, [&](const DataPoint& point) {
    const View view = data.views[point.view].view();
    const nook::nnao::Sampling sampling{point.radius, Dataset::max_radius_px + 1, taps};
    const float ao = nook::nnao::evaluate_unclamped(network, view, point.normal, sampling, point.x, point.y,
                                                    nook::nnao::tap_noise(point.x, point.y));
    return squared(std::clamp(double(ao), 0.0, 1.0) - double(point.ao));
  });
}

double constant_mse(const Dataset& data) {
  double mean = 0;
  for (const DataPoint& point : data.training) mean += double(point.ao);
  mean /= double(std::max<std::size_t>(1, data.training.size()));
  return mean_over(data, 1, [&](const DataPoint& point) { return squared(mean - double(point.ao)); });
}

}  // namespace nook::bake::nnao
