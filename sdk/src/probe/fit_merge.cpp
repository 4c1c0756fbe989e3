// Fits that start from others, join them, or start anew.
#include <algorithm>
#include <array>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/fit.h"

namespace nook::probe {

void Fit::seed(Fit& short_run) {
  if (!(short_run.basis_ == basis_))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "short_run has another basis; make both with the same functions and domain");
  if (!is_running(settings_.method)) return;
  if (counts_.used > 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the fit has samples already; seed it before, or reset it");
  std::array<Vec3, max_functions> start;
  short_run.read(std::span(start).first(basis_.count));
  for (std::uint32_t i = 0; i < basis_.count; ++i) {
    const double rgb[3] = {double(start[i].x), double(start[i].y), double(start[i].z)};
    for (std::size_t c = 0; c < 3; ++c) sums_[c * padded_ + i] = rgb[c];
  }
  prior_weight_ = short_run.counts_.weight;
  if (bands_.size() > 0) seed_bands(start.data());
  settle();
}

// The bands that samples of the start itself would have left.
void Fit::seed_bands(const Vec3* start) {
  std::array<double, band_functions * max_functions> function;
  project_functions(basis_, function.data());
  const double scale = prior_weight_ / domain_area(basis_.domain);
  std::fill(bands_.begin(), bands_.end(), 0.0);
  for (std::size_t j = 0; j < band_functions; ++j)
    for (std::uint32_t i = 0; i < basis_.count; ++i) {
      const double rgb[3] = {double(start[i].x), double(start[i].y), double(start[i].z)};
      for (std::size_t c = 0; c < 3; ++c)
        bands_[c * band_stride + j] += scale * function[j * basis_.count + i] * rgb[c];
    }
}

void Fit::merge(const Fit& other) {
  const auto same = [](const FitSettings& a, const FitSettings& b) {
    return a.method == b.method && a.step == b.step && a.constraint == b.constraint &&
           a.denominator == b.denominator && a.growing_samples == b.growing_samples;
  };
  if (!(other.basis_ == basis_) || !same(other.settings_, settings_))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the fits differ in basis or method; make both from equal descriptors");
  if (&other == this)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "a fit cannot be merged with itself; make a second one");
  if (is_running(settings_.method)) {
    const double mine = counts_.weight + prior_weight_, theirs = other.counts_.weight + other.prior_weight_;
    const double share = mine + theirs > 0 ? theirs / (mine + theirs) : 0;
    settle();
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < padded_; ++i) {
        const double their = other.sums_[c * padded_ + i] + double(other.running_.change[c][i]);
        sums_[c * padded_ + i] += share * (their - sums_[c * padded_ + i]);
      }
    for (std::size_t i = 0; i < padded_; ++i)
      running_.square[i] += float(share) * (other.running_.square[i] - running_.square[i]);
    settle();
  } else {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  }
  for (std::size_t i = 0; i < bands_.size(); ++i) bands_[i] += other.bands_[i];
  prior_weight_ += other.prior_weight_;
  counts_.used += other.counts_.used;
  counts_.expected_weight += other.counts_.expected_weight;
  counts_.bad_direction += other.counts_.bad_direction;
  counts_.bad_radiance += other.counts_.bad_radiance;
  counts_.bad_weight += other.counts_.bad_weight;
  counts_.weight += other.counts_.weight;
  for (std::size_t c = 0; c < 3; ++c) counts_.radiance[c] += other.counts_.radiance[c];
}

void Fit::reset() {
  std::fill(sums_.begin(), sums_.end(), 0.0);
  std::fill(bands_.begin(), bands_.end(), 0.0);
  for (float* row : {running_.change[0], running_.change[1], running_.change[2], running_.square})
    std::fill_n(row, padded_, 0.0f);
  settle();
  prior_weight_ = 0;
  counts_ = {};
}

}  // namespace nook::probe
