// Adds samples to a fit. Samples are kept until a chunk is full. So the chunks do not depend on how the
// caller splits the samples into calls, and faulty samples, which are skipped, do not shift them.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

using Column = float (SampleColumns::*)[SampleColumns::capacity];
constexpr Column columns[] = {&SampleColumns::x,      &SampleColumns::y,     &SampleColumns::z,
                              &SampleColumns::red,    &SampleColumns::green, &SampleColumns::blue,
                              &SampleColumns::weight, &SampleColumns::growth};

void move_samples(SampleColumns& samples, std::uint32_t from, std::uint32_t count, std::uint32_t to) {
  for (const Column column : columns) std::copy_n(samples.*column + from, count, samples.*column + to);
}

// Overwrites unused samples, because faulty samples may have left infinite values there.
void clear_samples(SampleColumns& samples, std::uint32_t from, std::uint32_t to) {
  for (const Column column : columns)
    std::fill(samples.*column + from, samples.*column + to, column == &SampleColumns::growth ? 1.0f : 0.0f);
}

// A running average processes this many samples at once. It solves one system for all of them, so that the
// cost per sample is small.
constexpr std::uint32_t block_samples = 4 * sample_chunk;

}  // namespace

// A path tracer passes one sample per call, so the case of few samples comes first.
void Fit::add_samples(const float* directions, const float* radiance, const float* weights,
                      std::size_t count) {
  RecentSamples& recent = recent_[0];
  if (recent.count + count < sample_group)
    return append_recent(directions, radiance, weights, std::uint32_t(count));
  const auto advance_by = [&](std::uint32_t n) {
    directions += 3 * n;
    radiance += 3 * n;
    if (weights) weights += n;
    count -= n;
  };
  if (recent.count > 0) {
    const std::uint32_t missing = sample_group - recent.count;
    append_recent(directions, radiance, weights, missing);
    take_recent();
    advance_by(missing);
  }
  // The last group is copied, because read_group reads one float beyond its input.
  while (count > sample_group) {
    take_group(directions, radiance, weights, sample_group);
    advance_by(sample_group);
  }
  append_recent(directions, radiance, weights, std::uint32_t(count));
  if (recent.count == sample_group) take_recent();
}

void Fit::append_recent(const float* directions, const float* radiance, const float* weights,
                        std::uint32_t count) {
  RecentSamples& recent = recent_[0];
  std::copy_n(directions, 3 * count, recent.directions + 3 * recent.count);
  std::copy_n(radiance, 3 * count, recent.radiance + 3 * recent.count);
  if (weights)
    std::copy_n(weights, count, recent.weights + recent.count);
  else
    std::fill_n(recent.weights + recent.count, count, 1.0f);
  recent.count += count;
}

void Fit::take_recent() {
  RecentSamples& recent = recent_[0];
  const std::uint32_t count = std::exchange(recent.count, 0), whole = whole_vectors(count);
  std::fill(recent.directions + 3 * count, recent.directions + 3 * whole + 1, 0.0f);
  std::fill(recent.radiance + 3 * count, recent.radiance + 3 * whole + 1, 0.0f);
  std::fill(recent.weights + count, recent.weights + whole, 0.0f);
  take_group(recent.directions, recent.radiance, recent.weights, count);
}

void Fit::take_group(const float* directions, const float* radiance, const float* weights,
                     std::uint32_t count) {
  const float* const up = basis_.domain == Domain::hemisphere ? &basis_.up.x : nullptr;
  keep(kernels_->read_group(directions, radiance, weights, up, count, samples_[0], waiting_), count);
}

// Removes faulty samples from the last group by moving later samples forward.
void Fit::keep(const SampleFaults& faults, std::uint32_t count) {
  if (count == 0) return;
  const std::uint64_t group = ~std::uint64_t(0) >> (sample_group - count);
  const std::uint64_t directed = group & ~faults.direction, lit = directed & ~faults.radiance,
                      good = lit & ~faults.weight, used = good & ~faults.empty;
  SampleColumns& samples = samples_[0];
  const bool growing = settings_.growing_samples > 0;
  if (used == ~std::uint64_t(0) && !growing) {
    counts_.used += sample_group;
    waiting_ += sample_group;
  } else {
    counts_.bad_direction += std::uint64_t(std::popcount(group & ~directed));
    counts_.bad_radiance += std::uint64_t(std::popcount(directed & ~lit));
    counts_.bad_weight += std::uint64_t(std::popcount(lit & ~good));
    const std::uint32_t first = waiting_;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!(good >> k & 1)) continue;
      ++counts_.used;
      if (!(used >> k & 1)) continue;
      move_samples(samples, first + k, 1, waiting_);
      if (growing) {
        const float growth = float(-std::expm1(-double(counts_.used) / double(settings_.growing_samples)));
        samples.growth[waiting_] = growth;
        samples.weight[waiting_] *= growth;
      }
      if (samples.weight[waiting_] > 0) ++waiting_;
    }
    clear_samples(samples, waiting_, first + whole_vectors(count));
  }
  if (waiting_ < sample_chunk) return;
  const std::uint32_t rest = waiting_ - sample_chunk;
  waiting_ = sample_chunk;
  flush();
  if (is_block() && open_ >= block_samples) {
    close_block(state_at(state_.data()), counts_, scratch_.data());
    closed_weight_ = counts_.weight;
    open_ = 0;
  }
  move_samples(samples, sample_chunk, rest, 0);
  std::fill_n(samples.weight + sample_chunk, rest, 0.0f);
  waiting_ = rest;
}

void Fit::flush() {
  absorb(waiting_, values_.data(), state_at(state_.data()));
  advance(counts_, waiting_);
  std::fill_n(samples_[0].weight, waiting_, 0.0f);
  open_ += waiting_;
  waiting_ = 0;
}

Fit::Gathered Fit::present(const Room& room) const {
  double* const spare = room.state;
  std::copy(state_.begin(), state_.end(), spare);
  const Gathered gathered{state_at(spare), counts_with_waiting()};
  absorb(waiting_, room.values, gathered.state);
  if (is_block()) close_block(gathered.state, gathered.counts, room.solver);
  return gathered;
}

SampleCounts Fit::counts() {
  take_recent();
  return counts_with_waiting();
}

SampleCounts Fit::counts_with_waiting() const {
  SampleCounts counts = counts_;
  advance(counts, waiting_);
  return counts;
}

void Fit::advance(SampleCounts& counts, std::uint32_t count) const {
  const SampleColumns& samples = samples_[0];
  std::array<double, 4> light{};
  kernels_->sum_light(samples, count, light.data());
  counts.weight += light[0];
  for (std::size_t c = 0; c < 3; ++c) counts.radiance[c] += light[1 + c];
  for (std::uint32_t k = 0; k < count && counts.expected_weight < first_weight; ++k)
    counts.expected_weight = std::min(counts.expected_weight + double(samples.growth[k]), first_weight);
}

void Fit::total_weights(std::uint32_t count, float* total) const {
  const SampleColumns& samples = samples_[0];
  double weight = counts_.weight, expected = counts_.expected_weight;
  for (std::uint32_t k = 0; k < count; ++k) {
    weight += double(samples.weight[k]);
    if (expected < first_weight) expected = std::min(expected + double(samples.growth[k]), first_weight);
    total[k] = float(std::max(weight, expected) + prior_weight_);
  }
  std::fill(total + count, total + sample_chunk, 1.0f);
}

// Adds the waiting samples to a state. The caller updates the counts.
void Fit::absorb(std::uint32_t count, float* values, State into) const {
  if (count == 0) return;
  const SampleColumns& samples = samples_[0];
  alignas(64) std::array<float, std::size_t(sample_chunk) * band_functions> harmonics;
  alignas(64) std::array<float, std::size_t(sample_chunk) * 3> light;
  alignas(64) std::array<float, sample_chunk> scale;
  kernels_->light_rows(samples, count, scale.data(), light.data());
  if (into.bands) {
    kernels_->harmonic_rows(samples, scale.data(), count, harmonics.data());
    kernels_->sum_products(harmonics.data(), band_functions, light.data(), 3, count, false, into.bands,
                           band_stride);
  }
  if (is_running(settings_.method) && !is_block())
    step_plainly(count, values, into);
  else
    sum_samples(count, scale.data(), light.data(), harmonics.data(), values, into);
}

void Fit::values_of(std::uint32_t count, std::uint32_t sample_stride, std::uint32_t function_stride,
                    float* values) const {
  const SampleColumns& samples = samples_[0];
  std::array<float, max_functions> at;
  const std::uint32_t end = whole_pairs(count);
  for (std::uint32_t k = 0; k < end; ++k) {
    evaluate_basis(basis_, Vec3{samples.x[k], samples.y[k], samples.z[k]}, at.data());
    for (std::uint32_t i = 0; i < basis_.count; ++i) values[k * sample_stride + i * function_stride] = at[i];
  }
}

// If least squares uses the Gram matrix of its samples, it also sums the products of each function with each
// harmonic. Then the bands have no noise for a light that the lobes can represent exactly.
void Fit::sum_samples(std::uint32_t count, const float* scale, const float* light, const float* harmonics,
                      float* values, State into) const {
  const std::uint32_t n = basis_.count;
  if (basis_.kind == BasisKind::gaussians) {
    kernels_->gaussian_rows(lobes_, n, samples_[0], scale, count, values);
  } else {
    values_of(count, 1, sample_chunk, values);
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = 0; k < whole_pairs(count); ++k) values[i * sample_chunk + k] *= scale[k];
  }
  if (whitens_) kernels_->whiten_rows(whitening_, n, count, values);
  kernels_->sum_products(values, n, light, 3, count, false, into.sums, padded_);
  const bool solves = settings_.method == FitMethod::least_squares ||
                      settings_.method == FitMethod::non_negative_least_squares;
  if (solves || is_block())
    kernels_->sum_products(values, n, values, n, count, true, into.sums + 3 * std::size_t(padded_), padded_);
  if (has_sampled_bands(basis_, settings_))
    kernels_->sum_products(values, n, harmonics, band_functions, count, false,
                           into.bands + 3 * std::size_t(band_stride), padded_);
}

void Fit::step_plainly(std::uint32_t count, float* values, State into) const {
  alignas(64) std::array<float, sample_chunk> total;
  total_weights(count, total.data());
  if (basis_.kind == BasisKind::gaussians) {
    kernels_->gaussian_values(lobes_, samples_[0], count, values);
  } else {
    std::fill_n(values, std::size_t(sample_chunk) * padded_, 0.0f);
    values_of(count, padded_, 1, values);
  }
  alignas(64) std::array<float, std::size_t(7) * max_functions> rows{};
  RunningView view = running_;
  for (std::size_t c = 0; c < 3; ++c) {
    view.value[c] = rows.data() + c * max_functions;
    view.change[c] = rows.data() + (3 + c) * max_functions;
    std::transform(into.coefficients + c * padded_, into.coefficients + (c + 1) * padded_, view.value[c],
                   [](double settled) { return float(settled); });
  }
  view.square = rows.data() + std::size_t(6) * max_functions;
  std::transform(into.square, into.square + padded_, view.square, [](double mean) { return float(mean); });
  if (settings_.method == FitMethod::running_average_original)
    kernels_->step_original(view, samples_[0], total.data(), count, values);
  else
    kernels_->step_plain(view, samples_[0], total.data(), count, values,
                         settings_.denominator == Denominator::lockstep,
                         settings_.method == FitMethod::running_average_non_negative);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < padded_; ++i) into.coefficients[c * padded_ + i] += double(view.change[c][i]);
  std::copy_n(view.square, padded_, into.square);
}

}  // namespace nook::probe
