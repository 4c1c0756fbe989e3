// Initialises fits from other fits, merges them, and resets them.
#include <algorithm>
#include <array>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/fit.h"

namespace nook::probe {
namespace {

void add_counts(SampleCounts& counts, const SampleCounts& more) {
  counts.used += more.used;
  counts.expected_weight += more.expected_weight;
  counts.bad_direction += more.bad_direction;
  counts.bad_radiance += more.bad_radiance;
  counts.bad_weight += more.bad_weight;
  counts.weight += more.weight;
  for (std::size_t c = 0; c < 3; ++c) counts.radiance[c] += more.radiance[c];
}

}  // namespace

void Fit::seed(Fit& short_run) {
  if (!(short_run.basis_ == basis_))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "short_run has another basis than the fit; create both with the same functions and domain");
  if (!is_running(settings_.method)) return;
  if (counts().used > 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the fit already has samples; seed it before you add samples, or reset it");
  std::array<Vec3, max_functions> start;
  short_run.read(std::span(start).first(basis_.count));
  const State state = state_at(state_.data());
  for (std::uint32_t i = 0; i < basis_.count; ++i) {
    const double rgb[3] = {double(start[i].x), double(start[i].y), double(start[i].z)};
    for (std::size_t c = 0; c < 3; ++c) state.coefficients[c * padded_ + i] = rgb[c];
  }
  prior_weight_ = short_run.counts().weight;
  if (state.bands) seed_bands(start.data());
}

// Sets the sums of the bands to the values that they would have if the samples came from the initial light.
void Fit::seed_bands(const Vec3* start) {
  std::array<double, band_functions * max_functions> function;
  project_functions(basis_, function.data());
  const double scale = prior_weight_ / domain_area(basis_.domain);
  double* const bands = state_at(state_.data()).bands;
  std::fill_n(bands, 3 * std::size_t(band_stride), 0.0);  // removes the sums of an earlier seed
  for (std::size_t j = 0; j < band_functions; ++j)
    for (std::uint32_t i = 0; i < basis_.count; ++i) {
      const double rgb[3] = {double(start[i].x), double(start[i].y), double(start[i].z)};
      for (std::size_t c = 0; c < 3; ++c)
        bands[c * band_stride + j] += scale * function[j * basis_.count + i] * rgb[c];
    }
}

void Fit::merge(Fit& other) {
  const auto same = [](const FitSettings& a, const FitSettings& b) {
    return a.method == b.method && a.step == b.step && a.constraint == b.constraint &&
           a.denominator == b.denominator && a.growing_samples == b.growing_samples;
  };
  if (!(other.basis_ == basis_) || !same(other.settings_, settings_))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the fits differ in basis or method; make both from equal descriptors");
  if (&other == this)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "a fit cannot be merged with itself; create a second fit");
  take_recent();
  const SampleCounts their_counts = other.counts();
  const double their_weight = their_counts.weight + other.prior_weight_;
  if (their_weight > 0) {
    flush();
    const State mine = state_at(state_.data());
    if (is_block()) close_block(mine, counts_, scratch_.data());
    const double my_weight = counts_.weight + prior_weight_;
    join(mine, other.present(room()).state, their_weight / (my_weight + their_weight));
  }
  prior_weight_ += other.prior_weight_;
  add_counts(counts_, their_counts);
  if (their_weight > 0) {
    closed_weight_ = counts_.weight;
    open_ = 0;
  }
}

// Merges `theirs` into `mine`. Where the result is a mean, `share` is the weight of `theirs`.
void Fit::join(State mine, State theirs, double share) const {
  if (is_running(settings_.method)) {
    for (std::size_t i = 0; i < 3 * std::size_t(padded_); ++i)
      mine.coefficients[i] += share * (theirs.coefficients[i] - mine.coefficients[i]);
    for (std::size_t i = 0; i < padded_; ++i) mine.square[i] += share * (theirs.square[i] - mine.square[i]);
  } else {
    for (std::size_t i = 0; i < std::size_t(3 + basis_.count) * padded_; ++i) mine.sums[i] += theirs.sums[i];
  }
  if (!mine.bands) return;
  for (std::size_t i = 0; i < 3 * std::size_t(band_stride) + std::size_t(band_functions) * padded_; ++i)
    mine.bands[i] += theirs.bands[i];
}

void Fit::reset() {
  recent_[0].count = 0;
  flush();
  std::fill(state_.begin(), state_.end(), 0.0);
  prior_weight_ = 0;
  closed_weight_ = 0;
  open_ = 0;
  counts_ = {};
}

}  // namespace nook::probe
