#include "samples/crowd/light.h"
#include <nook/experimental/nook_sg.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "platform/file_bytes.h"
#include "platform/platform.h"

namespace crowd {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

constexpr std::uint32_t kSkyHeight = 64, kProbeHeight = 128;  // texels

// The direction of a texel's centre in the layout of nook_bake_environment: the middle column looks along +x,
// and the column a quarter farther right looks along +z.
void texel_direction(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                     float* out) {
  const float polar = kPi * (float(y) + 0.5f) / float(height);
  const float azimuth = 2 * kPi * ((float(x) + 0.5f) / float(width) - 0.5f);
  out[0] = std::sin(polar) * std::cos(azimuth);
  out[1] = std::cos(polar);
  out[2] = std::sin(polar) * std::sin(azimuth);
}

// The share of the sphere that a texel covers.
float texel_share(std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  const float top = std::cos(kPi * float(y) / float(height)),
              bottom = std::cos(kPi * float(y + 1) / float(height));
  return (top - bottom) / (2 * float(width));
}

// A hazy sun 30 degrees high, about 15 degrees wide.
constexpr nook_lobe kSun{{0.62f, 0.5f, 0.605f}, 30, {40, 30, 18}, 0};

// The sky without its sun is blue above and white at the horizon, and dry ground reflects its light.
void sky_radiance(const float direction[3], float* rgb) {
  static constexpr float zenith[3] = {0.16f, 0.34f, 0.80f}, horizon[3] = {0.45f, 0.58f, 0.80f},
                         ground[3] = {0.30f, 0.25f, 0.19f};
  const float up = direction[1], share = std::pow(std::max(up, 0.0f), 0.6f);
  for (int c = 0; c < 3; ++c) rgb[c] = up < 0 ? ground[c] : std::lerp(horizon[c], zenith[c], share);
}

void add_sun(const float direction[3], float* rgb) {
  float cosine = 0;
  for (int i = 0; i < 3; ++i) cosine += direction[i] * kSun.axis[i];
  for (int c = 0; c < 3; ++c) rgb[c] += kSun.amplitude[c] * std::exp(kSun.sharpness * (cosine - 1));
}

}  // namespace

Light::Light(const nook::Context& context, const std::filesystem::path& path) : name_(path.stem().string()) {
  if (path.extension() == ".nook")
    read_probe(context, path);
  else {
    read_map(path);
    fit_lobes(context);
  }
  measure_mean();
  if (!(mean_radiance_ > 0))
    throw std::runtime_error("crowd: " + path.string() +
                             " holds no light (its mean radiance is 0); choose another");
}

Light Light::built_in_sky(const nook::Context& context) {
  Light sky("sky");
  sky.width_ = 2 * kSkyHeight;
  sky.height_ = kSkyHeight;
  sky.rgb_.resize(3 * std::size_t(sky.width_) * sky.height_);
  const auto each_texel = [&](void (*write)(const float*, float*)) {
    for (std::uint32_t y = 0; y < sky.height_; ++y)
      for (std::uint32_t x = 0; x < sky.width_; ++x) {
        float direction[3];
        texel_direction(x, y, sky.width_, sky.height_, direction);
        write(direction, &sky.rgb_[3 * (std::size_t(y) * sky.width_ + x)]);
      }
  };
  each_texel(sky_radiance);
  sky.fit_lobes(context);
  each_texel(add_sun);
  sky.lobes_.push_back(kSun);
  sky.has_sun_ = true;
  sky.measure_mean();
  return sky;
}

void Light::measure_mean() {
  double sum = 0;
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t i = 0; i < 3 * width_; ++i)
      sum += double(texel_share(y, width_, height_)) * double(rgb_[3 * std::size_t(y) * width_ + i]) / 3;
  mean_radiance_ = float(sum);
}

void Light::read_probe(const nook::Context& context, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = platform::read_file(path);
  lobes_ = nook::Probe(context, bytes.data(), bytes.size()).lobes();
  // The map is sharp enough for the narrowest lobes that a probe of a few dozen has.
  width_ = 2 * kProbeHeight;
  height_ = kProbeHeight;
  std::vector<float> directions(3 * std::size_t(width_) * height_);
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x)
      texel_direction(x, y, width_, height_, &directions[3 * (std::size_t(y) * width_ + x)]);
  rgb_.resize(directions.size());
  nook::check(nook_sg_radiance(lobes_.data(), std::uint32_t(lobes_.size()), directions.data(), rgb_.data(),
                               directions.size() / 3));
  for (float& channel : rgb_) channel = std::max(channel, 0.0f);
}

void Light::read_map(const std::filesystem::path& path) {
  platform::FloatImage map = platform::read_float_image(path);
  if (map.width != 2 * map.height)
    throw std::runtime_error("crowd: " + path.string() + " is not a latitude-longitude map (got " +
                             std::to_string(map.width) + " x " + std::to_string(map.height) +
                             ", need twice as wide as high)");
  width_ = std::uint32_t(map.width);
  height_ = std::uint32_t(map.height);
  rgb_ = std::move(map.rgb);
  for (float& channel : rgb_) channel = std::isfinite(channel) ? std::max(channel, 0.0f) : 0.0f;
}

void Light::fit_lobes(const nook::Context& context) {
  nook::ProbeFit fit(context);
  std::vector<float> directions(3 * std::size_t(width_)), weights(width_);
  for (std::uint32_t y = 0; y < height_; ++y) {
    for (std::uint32_t x = 0; x < width_; ++x) texel_direction(x, y, width_, height_, &directions[3 * x]);
    std::ranges::fill(weights, texel_share(y, width_, height_) * float(width_) * float(height_));
    fit.add_samples(directions.data(), &rgb_[3 * std::size_t(y) * width_], weights.data(), width_);
  }
  lobes_ = fit.solve().lobes();
}

std::vector<float> Light::irradiance(const std::vector<float>& normals) const {
  std::vector<float> e(normals.size());
  nook::check(nook_sg_irradiance(lobes_.data(), std::uint32_t(lobes_.size()), NOOK_PROBE_IRRADIANCE_BANDS,
                                 normals.data(), e.data(), normals.size() / 3));
  for (float& channel : e) channel = std::max(channel, 0.0f);
  return e;
}

SplitLight Light::split() const {
  SplitLight parts;
  parts.soft = lobes_;
  const float up[3] = {0, 1, 0};
  const auto irradiance_up = [&](const nook_lobe* of, std::size_t count, float* rgb) {
    nook::check(nook_sg_irradiance(of, std::uint32_t(count), NOOK_PROBE_IRRADIANCE_BANDS, up, rgb, 1));
    for (int c = 0; c < 3; ++c) rgb[c] = std::max(rgb[c], 0.0f);
  };
  if (has_sun_) {
    const nook_lobe& sun = parts.soft.back();
    std::copy_n(sun.axis, 3, parts.to_sun);
    // A cone whose directions are as far from its axis in the mean: 1 / sharpness = (1 - cos(half angle))
    // / 2.
    parts.sun_degrees = 2 * std::acos(1 - 2 / sun.sharpness) * 180 / kPi;
    irradiance_up(&sun, 1, parts.sun_up);
    parts.soft.pop_back();
  }
  irradiance_up(parts.soft.data(), parts.soft.size(), parts.soft_up);
  return parts;
}

std::vector<float> Light::radiance(const float direction[3]) const {
  std::vector<float> rgb(3);
  nook::check(nook_sg_radiance(lobes_.data(), std::uint32_t(lobes_.size()), direction, rgb.data(), 1));
  for (float& channel : rgb) channel = std::max(channel, 0.0f);
  return rgb;
}

}  // namespace crowd
