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

}  // namespace

Light::Light(const nook::Context& context, const std::filesystem::path& path) : name_(path.stem().string()) {
  if (path.extension() == ".nook")
    read_probe(context, path);
  else
    fit_map(context, path);
  double sum = 0;
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t i = 0; i < 3 * width_; ++i)
      sum += double(texel_share(y, width_, height_)) * double(rgb_[3 * std::size_t(y) * width_ + i]) / 3;
  mean_radiance_ = float(sum);
  if (!(mean_radiance_ > 0)) throw std::runtime_error("crowd: " + path.string() + " holds no light");
}

void Light::read_probe(const nook::Context& context, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = read_file(path);
  nook_probe handle = nullptr;
  nook::check(nook_probe_load(context.get(), bytes.data(), bytes.size(), &handle));
  const Probe probe(handle);
  nook_probe_info info{};
  info.struct_size = sizeof info;
  nook::check(nook_probe_get_info(handle, &info));
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

void Light::fit_map(const nook::Context& context, const std::filesystem::path& path) {
  platform::FloatImage map = platform::read_float_image(path);
  if (map.width != 2 * map.height)
    throw std::runtime_error("crowd: " + path.string() + " is no latitude-longitude map (got " +
                             std::to_string(map.width) + " x " + std::to_string(map.height) +
                             ", need twice as wide as high)");
  width_ = std::uint32_t(map.width);
  height_ = std::uint32_t(map.height);
  rgb_ = std::move(map.rgb);
  for (float& channel : rgb_) channel = std::isfinite(channel) ? std::max(channel, 0.0f) : 0.0f;

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
                                          NOOK_PROBE_IRRADIANCE_FITTED, normals.data(), e.data(),
                                          normals.size() / 3));
  for (float& channel : e) channel = std::max(channel, 0.0f);
  return e;
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
