#include "light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "file_bytes.h"
#include "platform/platform.h"

namespace crowd {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

using Probe = nook::Unique<nook_probe, nook_probe_destroy>;
using ProbeFit = nook::Unique<nook_probe_fit, nook_probe_fit_destroy>;

// Centre of a texel as nook_bake_environment has them: the middle column looks along +x, a quarter further
// right along +z.
void texel_direction(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                     float* out) {
  const float polar = kPi * (float(y) + 0.5f) / float(height);
  const float azimuth = 2 * kPi * ((float(x) + 0.5f) / float(width) - 0.5f);
  out[0] = std::sin(polar) * std::cos(azimuth);
  out[1] = std::cos(polar);
  out[2] = std::sin(polar) * std::sin(azimuth);
}

// A texel's share of the sphere.
float texel_share(std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  const float top = std::cos(kPi * float(y) / float(height)),
              bottom = std::cos(kPi * float(y + 1) / float(height));
  return (top - bottom) / (2 * float(width));
}

// Blue above, white at the horizon, a warm sun 30 degrees high and 15 wide, and what dry ground sends back.
void sky_radiance(const float direction[3], float* rgb) {
  static constexpr float zenith[3] = {0.16f, 0.34f, 0.80f}, horizon[3] = {0.45f, 0.58f, 0.80f},
                         sun[3] = {40.0f, 30.0f, 18.0f}, ground[3] = {0.30f, 0.25f, 0.19f};
  static constexpr float to_sun[3] = {0.62f, 0.5f, 0.605f};
  const float up = direction[1];
  float to_sun_cosine = 0;
  for (int i = 0; i < 3; ++i) to_sun_cosine += direction[i] * to_sun[i];
  const float glow = std::exp(30 * (to_sun_cosine - 1)), share = std::pow(std::max(up, 0.0f), 0.6f);
  for (int c = 0; c < 3; ++c)
    rgb[c] = up < 0 ? ground[c] : std::lerp(horizon[c], zenith[c], share) + sun[c] * glow;
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
  if (!(mean_radiance_ > 0)) throw std::runtime_error("crowd: " + path.string() + " holds no light");
}

Light Light::built_in_sky(const nook::Context& context) {
  Light sky("sky");
  sky.width_ = 128;
  sky.height_ = 64;
  sky.rgb_.resize(3 * std::size_t(sky.width_) * sky.height_);
  for (std::uint32_t y = 0; y < sky.height_; ++y)
    for (std::uint32_t x = 0; x < sky.width_; ++x) {
      float direction[3];
      texel_direction(x, y, sky.width_, sky.height_, direction);
      sky_radiance(direction, &sky.rgb_[3 * (std::size_t(y) * sky.width_ + x)]);
    }
  sky.fit_lobes(context);
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
  const std::vector<unsigned char> bytes = read_file(path);
  nook_probe handle = nullptr;
  nook::check(nook_probe_load(context.get(), bytes.data(), bytes.size(), &handle));
  const Probe probe(handle);
  nook_probe_info info{};
  info.struct_size = sizeof info;
  nook::check(nook_probe_describe(handle, &info));
  lobes_.resize(info.function_count);
  nook::check(nook_probe_read_lobes(handle, nullptr, lobes_.data(), info.function_count));
  // Sharp enough for the narrowest lobes that a probe of a few dozen has.
  width_ = 256;
  height_ = 128;
  std::vector<float> directions(3 * std::size_t(width_) * height_);
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x)
      texel_direction(x, y, width_, height_, &directions[3 * (std::size_t(y) * width_ + x)]);
  rgb_.resize(directions.size());
  nook::check(nook_probe_lobes_radiance(lobes_.data(), info.function_count, directions.data(), rgb_.data(),
                                        directions.size() / 3));
  for (float& channel : rgb_) channel = std::max(channel, 0.0f);
}

void Light::read_map(const std::filesystem::path& path) {
  platform::FloatImage map = platform::read_float_image(path);
  if (map.width != 2 * map.height)
    throw std::runtime_error("crowd: " + path.string() + " is no latitude-longitude map (got " +
                             std::to_string(map.width) + " x " + std::to_string(map.height) +
                             ", need twice as wide as high)");
  width_ = std::uint32_t(map.width);
  height_ = std::uint32_t(map.height);
  rgb_ = std::move(map.rgb);
  for (float& channel : rgb_) channel = std::isfinite(channel) ? std::max(channel, 0.0f) : 0.0f;
}

void Light::fit_lobes(const nook::Context& context) {
  nook_probe_fit_desc desc;
  nook::check(nook_probe_fit_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.method = NOOK_PROBE_LEAST_SQUARES;
  nook_probe_fit handle = nullptr;
  nook::check(nook_probe_fit_create(context.get(), &desc, &handle));
  const ProbeFit fit(handle);
  std::vector<float> directions(3 * std::size_t(width_)), weights(width_);
  for (std::uint32_t y = 0; y < height_; ++y) {
    for (std::uint32_t x = 0; x < width_; ++x) texel_direction(x, y, width_, height_, &directions[3 * x]);
    std::ranges::fill(weights, texel_share(y, width_, height_) * float(width_) * float(height_));
    nook::check(nook_probe_fit_add_samples(handle, directions.data(), &rgb_[3 * std::size_t(y) * width_],
                                           weights.data(), width_));
  }
  nook_probe solved = nullptr;
  nook::check(nook_probe_fit_solve(handle, &solved));
  const Probe probe(solved);
  lobes_.resize(desc.lobe_count);
  nook::check(nook_probe_read_lobes(solved, nullptr, lobes_.data(), desc.lobe_count));
}

std::vector<float> Light::irradiance(const std::vector<float>& normals) const {
  std::vector<float> e(normals.size());
  nook::check(nook_probe_lobes_irradiance(lobes_.data(), std::uint32_t(lobes_.size()),
                                          NOOK_PROBE_IRRADIANCE_BANDS, normals.data(), e.data(),
                                          normals.size() / 3));
  for (float& channel : e) channel = std::max(channel, 0.0f);
  return e;
}

std::vector<float> Light::radiance(const float direction[3]) const {
  std::vector<float> rgb(3);
  nook::check(
      nook_probe_lobes_radiance(lobes_.data(), std::uint32_t(lobes_.size()), direction, rgb.data(), 1));
  for (float& channel : rgb) channel = std::max(channel, 0.0f);
  return rgb;
}

std::vector<float> Light::mean_irradiance() const {
  std::vector<float> mean(3, 0.0f);
  for (const nook_probe_lobe& lobe : lobes_) {
    float integral[3];
    nook::check(nook_probe_lobe_integral(&lobe, integral));
    for (int c = 0; c < 3; ++c) mean[c] += integral[c] / 4;  // pi / (4 pi)
  }
  return mean;
}

}  // namespace crowd
