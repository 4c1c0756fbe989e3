#include "bakers/images/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {
namespace {

constexpr float mean_shade = 0.35f;  // where the map's mean luminance ends, linear

// Extended by a shoulder, so that a sun keeps its shape; then the sRGB curve.
float display(float value) {
  const float x = std::max(value, 0.0f);
  const float shown = x * (1 + x / 16) / (1 + x);
  const float c = std::min(shown, 1.0f);
  return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

std::uint8_t to_byte(float value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

void set_pixel(Picture& picture, std::size_t at, Colour colour) {
  for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * at + c] = to_byte(colour[c]);
}

Colour exposed(Vec3 rgb, float exposure) {
  return {display(rgb.x * exposure), display(rgb.y * exposure), display(rgb.z * exposure)};
}

}  // namespace

Picture map_picture(const Environment& map, const Basis& basis, std::span<const Vec3> coefficients,
                    std::uint32_t panel_width) {
  const Environment source = reduced(map, panel_width);
  const Region region = region_of(basis);
  const Channels light = integrate(map, {}).radiance;
  const float mean =
      luminance({float(light[0]), float(light[1]), float(light[2])}) / (4 * std::numbers::pi_v<float>);
  // A mean m ends at m e / (1 + m e) = mean_shade.
  const float exposure = mean > 0 ? mean_shade / ((1 - mean_shade) * mean) : 1.0f;
  std::array<Picture, 4> panels;
  const int width = int(panel_width), height = width / 2;
  for (Picture& panel : panels)
    panel = {width, height, std::vector<std::uint8_t>(3 * std::size_t(width) * std::size_t(height))};
  const Environment pixels(panel_width, std::uint32_t(height),
                           std::vector<float>(3 * std::size_t(width) * std::size_t(height)));
  for (std::size_t at = 0; at < pixels.texel_count(); ++at) {
    const Vec3 direction =
        pixels.direction(std::uint32_t(at % panel_width), std::uint32_t(at / panel_width), 0.5f, 0.5f);
    const Vec3 truth = source.radiance(direction);
    set_pixel(panels[0], at, exposed(truth, exposure));
    if (!region.holds(direction)) continue;
    const Vec3 fitted = nook::probe::radiance(basis, coefficients, direction);
    const Vec3 irradiance =
        nook::probe::irradiance(basis, coefficients, nook::probe::IrradianceForm::bands, direction);
    const float error = std::abs(luminance(fitted - truth));
    set_pixel(panels[1], at, exposed(fitted, exposure));
    set_pixel(panels[2], at, exposed(irradiance * (1 / std::numbers::pi_v<float>), exposure));
    set_pixel(panels[3], at, viridis(mean > 0 ? error / (error + mean) : 0.0f));
  }
  return side_by_side(panels);
}

}  // namespace nook::bake::probe
