#include "bakers/raytrace/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double darkest = 1e-30;  // integral of luminance

}  // namespace

Environment::Environment(std::uint32_t width, std::uint32_t height, std::vector<float> rgb)
    : width_(width), height_(height), rgb_(std::move(rgb)) {
  if (texel_count() == 0 || rgb_.size() != 3 * texel_count())
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the environment has %u x %u texels and %zu numbers (need one texel or more, and 3 numbers for each)",
        width, height, rgb_.size());
  for (std::size_t i = 0; i < rgb_.size(); ++i)
    if (!(rgb_[i] >= 0 && double(rgb_[i]) <= max_radiance))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "a texel of the environment is out of range (got %g in row %zu, column %zu, need 0 to "
                    "%g); repair the map or scale its light down",
                    double(rgb_[i]), i / 3 / width, i / 3 % width, max_radiance);
}

std::size_t Environment::texel_at(Vec3 d) const {
  const float u = 0.5f + std::atan2(d.z, d.x) * float(0.5 / pi);
  // acos(y) would lose half of its digits near the poles.
  const float v = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y) * float(1 / pi);
  const auto column = std::min(std::uint32_t(std::max(u, 0.0f) * float(width_)), width_ - 1);
  const auto row = std::min(std::uint32_t(std::max(v, 0.0f) * float(height_)), height_ - 1);
  return std::size_t(row) * width_ + column;
}

double Environment::solid_angle(std::uint32_t row) const {
  const double top = pi * row / height_, bottom = pi * (row + 1.0) / height_;
  return 2 * pi / width_ * (std::cos(top) - std::cos(bottom));
}

Vec3 Environment::direction(std::uint32_t column, std::uint32_t row, float u, float v) const {
  const double top = std::cos(pi * row / height_), bottom = std::cos(pi * (row + 1.0) / height_);
  const double y = top + (bottom - top) * double(v);
  const double angle = 2 * pi * ((double(column) + double(u)) / width_ - 0.5);
  const double radius = std::sqrt(std::max(0.0, 1 - y * y));
  return {float(radius * std::cos(angle)), float(y), float(radius * std::sin(angle))};
}

LightSampler::LightSampler(const Environment& environment, float uniform_share) : environment_(&environment) {
  const std::size_t count = environment.texel_count();
  std::vector<double> share(count);
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    total += double(luminance(environment.texel(i))) *
             environment.solid_angle(std::uint32_t(i / environment.width()));
  const double uniform = total > darkest ? double(uniform_share) : 1.0;
  uniform_ = float(uniform / (4 * pi));
  per_luminance_ = total > darkest ? float((1 - uniform) / total) : 0.0f;
  for (std::size_t i = 0; i < count; ++i)
    share[i] = double(texel_density(i)) * environment.solid_angle(std::uint32_t(i / environment.width()));
  total = 0;
  for (double s : share) total += s;
  for (double& s : share) s *= double(count) / total;

  keep_.assign(count, 1.0f);
  other_.resize(count);
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < count; ++i) {
    other_[i] = i;
    (share[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    keep_[s] = float(share[s]);
    other_[s] = l;
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
}

float LightSampler::texel_density(std::size_t texel) const {
  return uniform_ + per_luminance_ * luminance(environment_->texel(texel));
}

LightSample LightSampler::sample(double choice, float alias, float u, float v) const {
  std::size_t texel = std::min(std::size_t(choice * double(keep_.size())), keep_.size() - 1);
  if (alias >= keep_[texel]) texel = other_[texel];
  const auto row = std::uint32_t(texel / environment_->width());
  const auto column = std::uint32_t(texel % environment_->width());
  return {environment_->direction(column, row, u, v), environment_->texel(texel), texel_density(texel)};
}

namespace {

MapView view_of(const Environment& environment) {
  return {MapLayout::latlong, environment.width(), environment.height(), environment.rgb()};
}

struct Split {
  Vector<float> sky;
  Vector<Sun> suns;
};

Split split(const Environment& environment, std::size_t max_count) {
  Split out{Vector<float>(environment.rgb().begin(), environment.rgb().end()), Vector<Sun>()};
  out.suns = take_suns(view_of(environment), out.sky, default_memory(), max_count);
  return out;
}

}  // namespace

double sun_limit(const Environment& environment) {
  return nook::sun_limit(view_of(environment), default_memory());
}

Environment without_suns(const Environment& environment, std::size_t max_count) {
  const Split parts = split(environment, max_count);
  return Environment(environment.width(), environment.height(), {parts.sky.begin(), parts.sky.end()});
}

std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count) {
  const Split parts = split(environment, max_count);
  return {parts.suns.begin(), parts.suns.end()};
}

}  // namespace nook::bake
