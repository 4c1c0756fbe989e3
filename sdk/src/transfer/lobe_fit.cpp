#include "sdk/src/transfer/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::transfer {
namespace {

// A lobe is ignored where it is below exp(-reach) times its maximum; exp(-reach) is about 3e-7.
constexpr float reach = 15;

double dot_of(const double* a, const double* b, std::size_t count) {
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (int k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  for (; i < count; ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

std::size_t row_start(std::size_t row) {
  return row * (row + 1) / 2;
}

// Computes the Cholesky factor of `a`, row by row and in place.
void factor(Vector<double>& a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = &a[row_start(i)];
    for (std::size_t j = 0; j < i; ++j) {
      const double* const above = &a[row_start(j)];
      row[j] = (row[j] - dot_of(row, above, j)) / above[j];
    }
    row[i] = std::sqrt(row[i] - dot_of(row, row, i));
  }
}

// Calls body(lobe, value) for the lobes that reach a direction. Axes lie on a spiral with steadily decreasing
// heights, so only lobes in a contiguous range of indices can reach it.
template <class Body>
void lobes_at(std::span<const Vec3> axes, float sharpness, Vec3 direction, Body&& body) {
  const float cap = std::max(1 - reach / sharpness, -1.0f);
  const double polar = std::acos(std::clamp(double(direction.z), -1.0, 1.0)), wide = std::acos(double(cap));
  const double count = double(axes.size());
  const double high = std::cos(std::max(polar - wide, 0.0)),
               low = std::cos(std::min(polar + wide, 3.14159265358979));
  const auto first = std::size_t(std::clamp((1 - high) * 0.5 * count - 1, 0.0, count));
  const auto last = std::size_t(std::clamp((1 - low) * 0.5 * count + 1, 0.0, count));
  for (std::size_t j = first; j < last; ++j)
    if (dot(axes[j], direction) >= cap) body(j, gaussian_value(axes[j], sharpness, direction));
}

}  // namespace

LobeFit::LobeFit(std::uint32_t lobes, Memory* memory)
    : sharpness_(sharpness_of(lobes)), axes_(lobes, Vec3{}, memory), factor_(memory) {
  lobe_axes(axes_);
  factor_.resize(row_start(lobes));
  for (std::size_t i = 0; i < lobes; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      factor_[row_start(i) + j] = gaussian_product_integral(double(sharpness_), double(sharpness_),
                                                            double(one_minus_cosine(axes_[i], axes_[j])));
  factor(factor_, lobes);
}

void LobeFit::solve(std::span<double> moments, std::span<float> amplitudes) const {
  const std::size_t n = axes_.size();
  for (std::size_t c = 0; c < 3; ++c) {
    double* const x = &moments[c * n];
    for (std::size_t i = 0; i < n; ++i) {
      const double* const row = &factor_[row_start(i)];
      x[i] = (x[i] - dot_of(row, x, i)) / row[i];
    }
    for (std::size_t i = n; i-- > 0;) {
      const double* const row = &factor_[row_start(i)];
      x[i] /= row[i];
      for (std::size_t j = 0; j < i; ++j) x[j] -= row[j] * x[i];
    }
    for (std::size_t i = 0; i < n; ++i) amplitudes[3 * i + c] = float(x[i]);
  }
}

void LobeFit::fit(const CubeCells& cells, std::span<const Vec3> radiance, const Mat3x4& light_from_shape,
                  std::span<float> amplitudes) const {
  const std::size_t n = axes_.size();
  Vector<double> moments(3 * n, 0.0, axes_.get_allocator().memory());
  const float* const m = light_from_shape.m;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // Rotates the direction by the transpose of the matrix, which is the inverse of the rotation.
    const Vec3 d = cells.direction[i];
    const Vec3 in_shape{m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                        m[2] * d.x + m[6] * d.y + m[10] * d.z};
    const Vec3 light = radiance[i] * cells.solid_angle[i];
    lobes_at(axes_, sharpness_, in_shape, [&](std::size_t j, float value) {
      moments[j] += double(value * light.x);
      moments[n + j] += double(value * light.y);
      moments[2 * n + j] += double(value * light.z);
    });
  }
  solve(moments, amplitudes);
}

void LobeFit::fit_direction(Vec3 direction, Vec3 irradiance, std::span<float> amplitudes) const {
  const std::size_t n = axes_.size();
  Vector<double> moments(3 * n, 0.0, axes_.get_allocator().memory());
  lobes_at(axes_, sharpness_, direction, [&](std::size_t j, float value) {
    moments[j] = double(value * irradiance.x);
    moments[n + j] = double(value * irradiance.y);
    moments[2 * n + j] = double(value * irradiance.z);
  });
  solve(moments, amplitudes);
}

FitQuality fit_quality(const LobeFit& fit, std::span<const float> amplitudes, const CubeCells& cells,
                       std::span<const Vec3> radiance, const Mat3x4& light_from_shape) {
  const float* const m = light_from_shape.m;
  double error = 0, signal = 0, negative = 0, all = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 d = cells.direction[i];
    const Vec3 in_shape{m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                        m[2] * d.x + m[6] * d.y + m[10] * d.z};
    Vec3 sum;
    lobes_at(fit.axes(), fit.sharpness(), in_shape, [&](std::size_t j, float value) {
      sum += Vec3{amplitudes[3 * j], amplitudes[3 * j + 1], amplitudes[3 * j + 2]} * value;
    });
    const double weight = double(cells.solid_angle[i]);
    const Vec3 apart = sum - radiance[i];
    error += weight * double(dot(apart, apart));
    signal += weight * double(dot(radiance[i], radiance[i]));
    const float channels[3] = {sum.x, sum.y, sum.z}, luminance[3] = {0.2126f, 0.7152f, 0.0722f};
    for (int c = 0; c < 3; ++c) {
      negative += weight * double(luminance[c] * std::max(-channels[c], 0.0f));
      all += weight * double(luminance[c] * std::abs(channels[c]));
    }
  }
  return {signal > 0 ? std::sqrt(error / signal) : 0.0, all > 0 ? negative / all : 0.0};
}

struct FitCache::Entry {
  Entry(std::uint32_t lobes, Memory* memory) : fit(lobes, memory) {}

  const LobeFit fit;
  Entry* next = nullptr;
};

FitCache::~FitCache() {
  for (Entry* entry = first_.load(); entry;) {
    Entry* const next = entry->next;
    drop(entry);
    entry = next;
  }
}

void FitCache::drop(Entry* entry) noexcept {
  entry->~Entry();
  memory_->deallocate(entry, sizeof(Entry), alignof(Entry));
}

const LobeFit* FitCache::find(const Entry* from, const Entry* end, std::uint32_t lobes) const {
  for (const Entry* entry = from; entry != end; entry = entry->next)
    if (entry->fit.lobes() == lobes) return &entry->fit;
  return nullptr;
}

const LobeFit& FitCache::of(std::uint32_t lobes) {
  Entry* first = first_.load(std::memory_order_acquire);
  if (const LobeFit* const known = find(first, nullptr, lobes)) return *known;
  void* const place = memory_->allocate(sizeof(Entry), alignof(Entry));
  Entry* made = nullptr;
  try {
    made = new (place) Entry(lobes, memory_);
  } catch (...) {
    memory_->deallocate(place, sizeof(Entry), alignof(Entry));
    throw;
  }
  made->next = first;
  while (!first_.compare_exchange_weak(made->next, made, std::memory_order_acq_rel)) {
    // Meanwhile, other threads may have added entries at the front of the list. Only these are searched.
    if (const LobeFit* const known = find(made->next, first, lobes)) {
      drop(made);
      return *known;
    }
    first = made->next;
  }
  return made->fit;
}

}  // namespace nook::transfer
