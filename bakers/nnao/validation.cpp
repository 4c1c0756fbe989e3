#include "bakers/nnao/validation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "sdk/src/nnao/evaluate.h"

namespace nook::bake::nnao {
namespace {

// Returns the sum of term(point) in a fixed order.
template <class Term>
std::array<double, 2> mean_over(const Dataset& data, std::size_t stride, const Term& term) {
  std::vector<std::array<double, 2>> terms((data.validation.size() + stride - 1) / stride);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, terms.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) terms[i] = term(data.validation[i * stride]);
  });
  std::array<double, 2> sum{};
  for (const auto& t : terms) {
    sum[0] += t[0];
    sum[1] += t[1];
  }
  for (double& s : sum) s /= double(std::max<std::size_t>(1, terms.size()));
  return sum;
}

double squared(double x) {
  return x * x;
}

}  // namespace

ValidationRow validate(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                       std::size_t stride) {
  const auto mean = mean_over(data, stride, [&](const DataPoint& point) -> std::array<double, 2> {
    const View view = data.views[point.view].view();
    const nook::nnao::Sampling sampling{point.radius, Dataset::max_radius_px + 1, taps};
    double sum = 0, own = 0;
    for (std::uint32_t y = 0; y < NOOK_NOISE_SIZE; ++y)
      for (std::uint32_t x = 0; x < NOOK_NOISE_SIZE; ++x) {
        const float ao =
            nook::nnao::evaluate_unclamped(network, view, point.normal, sampling, point.x, point.y,
                                           nook::nnao::tap_noise(point.x + x, point.y + y));
        const double clamped = std::clamp(double(ao), 0.0, 1.0);
        sum += clamped;
        if (x == 0 && y == 0) own = clamped;
      }
    return {squared(own - double(point.ao)), squared(sum / NOOK_NOISE_COUNT - double(point.ao))};
  });
  return {taps, mean[0], mean[1]};
}

double validation_mse(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                      std::size_t stride) {
  return mean_over(data, stride, [&](const DataPoint& point) -> std::array<double, 2> {
    const View view = data.views[point.view].view();
    const nook::nnao::Sampling sampling{point.radius, Dataset::max_radius_px + 1, taps};
    const float ao = nook::nnao::evaluate_unclamped(network, view, point.normal, sampling, point.x, point.y,
                                                    nook::nnao::tap_noise(point.x, point.y));
    return {squared(std::clamp(double(ao), 0.0, 1.0) - double(point.ao)), 0};
  })[0];
}

double constant_mse(const Dataset& data) {
  double mean = 0;
  for (const DataPoint& point : data.training) mean += double(point.ao);
  mean /= double(std::max<std::size_t>(1, data.training.size()));
  return mean_over(data, 1, [&](const DataPoint& point) -> std::array<double, 2> {
    return {squared(mean - double(point.ao)), 0};
  })[0];
}

}  // namespace nook::bake::nnao
