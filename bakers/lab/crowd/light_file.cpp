#include "bakers/lab/crowd/light_file.h"

#include <nook/experimental/nook_sg.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "platform/file_bytes.h"
#include "platform/platform.h"

namespace crowd::lab {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
// Height in texels of the environment that is computed from a probe. It is high enough for the narrowest
// lobes of a probe with a few dozen lobes.
constexpr std::uint32_t probe_height = 128;

struct Map {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

// Returns the direction of a texel's centre in the layout of nook_bake_environment. The middle column looks
// along +x. The column that is a quarter of the width farther right looks along +z.
void texel_direction(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                     float* out) {
  const float polar = pi * (float(y) + 0.5f) / float(height);
  const float azimuth = 2 * pi * ((float(x) + 0.5f) / float(width) - 0.5f);
  out[0] = std::sin(polar) * std::cos(azimuth);
  out[1] = std::cos(polar);
  out[2] = std::sin(polar) * std::sin(azimuth);
}

// Returns the share of the sphere that a texel in row `y` covers.
float texel_share(std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  const float top = std::cos(pi * float(y) / float(height)),
              bottom = std::cos(pi * float(y + 1) / float(height));
  return (top - bottom) / (2 * float(width));
}

float mean_of(const Map& map) {
  double sum = 0;
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t i = 0; i < 3 * map.width; ++i)
      sum += double(texel_share(y, map.width, map.height)) *
             double(map.rgb[3 * std::size_t(y) * map.width + i]) / 3;
  return float(sum);
}

std::vector<nook_lobe> read_probe(const nook::Context& context, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = platform::read_file(path);
  return nook::Probe(context, bytes.data(), bytes.size()).lobes();
}

Map map_of(const std::vector<nook_lobe>& lobes) {
  Map map{2 * probe_height, probe_height, {}};
  std::vector<float> directions(3 * std::size_t(map.width) * map.height);
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x)
      texel_direction(x, y, map.width, map.height, &directions[3 * (std::size_t(y) * map.width + x)]);
  map.rgb.resize(directions.size());
  nook::check(nook_sg_radiance(lobes.data(), std::uint32_t(lobes.size()), directions.data(), map.rgb.data(),
                               directions.size() / 3));
  for (float& channel : map.rgb) channel = std::max(channel, 0.0f);
  return map;
}

Map read_map(const std::filesystem::path& path) {
  platform::FloatImage image = platform::read_float_image(path);
  if (image.width != 2 * image.height)
    throw std::runtime_error("crowd: " + path.string() + " is not a latitude-longitude map (got " +
                             std::to_string(image.width) + " x " + std::to_string(image.height) +
                             ", need twice as wide as high)");
  for (float& channel : image.rgb) channel = std::isfinite(channel) ? std::max(channel, 0.0f) : 0.0f;
  return {std::uint32_t(image.width), std::uint32_t(image.height), std::move(image.rgb)};
}

std::vector<nook_lobe> fit_lobes(const nook::Context& context, const Map& map) {
  nook::ProbeFit fit(context);
  std::vector<float> directions(3 * std::size_t(map.width)), weights(map.width);
  for (std::uint32_t y = 0; y < map.height; ++y) {
    for (std::uint32_t x = 0; x < map.width; ++x)
      texel_direction(x, y, map.width, map.height, &directions[3 * x]);
    std::ranges::fill(weights, texel_share(y, map.width, map.height) * float(map.width) * float(map.height));
    fit.add_samples(directions.data(), &map.rgb[3 * std::size_t(y) * map.width], weights.data(), map.width);
  }
  return fit.solve().lobes();
}

}  // namespace

MapLight read_light(const nook::Context& context, const std::filesystem::path& path) {
  Map map;
  std::vector<nook_lobe> lobes;
  if (path.extension() == ".nook") {
    lobes = read_probe(context, path);
    map = map_of(lobes);
  } else {
    map = read_map(path);
    lobes = fit_lobes(context, map);
  }
  const float mean_radiance = mean_of(map);
  if (!(mean_radiance > 0))
    throw std::runtime_error("crowd: " + path.string() +
                             " holds no light (its mean radiance is 0); choose another");
  return {path.stem().string(), Light(std::move(lobes)), std::move(map.rgb), map.width, map.height,
          mean_radiance};
}

MapLight light_of_lobes(std::string name, Light light) {
  Map map = map_of(light.lobes);
  const float mean_radiance = mean_of(map);
  return {std::move(name), std::move(light), std::move(map.rgb), map.width, map.height, mean_radiance};
}

}  // namespace crowd::lab
