#include "bakers/images/picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/raytrace/ray_scene.h"
#include "platform/image_codec.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake {
namespace {

constexpr Colour background{0.32f, 0.34f, 0.38f};
constexpr float margin = 1.04f;

std::uint8_t to_byte(float value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

Colour grey(float value) {
  const float v = std::clamp(value, 0.0f, 1.0f);
  return {v, v, v};
}

// A polynomial of degree six that approximates matplotlib's table to within 0.01 (M. Zucker, public domain).
Colour viridis(float value) {
  static constexpr float c[7][3] = {{0.27773f, 0.00541f, 0.33410f},   {0.10509f, 1.40461f, 1.38459f},
                                    {-0.33086f, 0.21485f, 0.09510f},  {-4.63423f, -5.79910f, -19.33244f},
                                    {6.22827f, 14.17993f, 56.69055f}, {4.77638f, -13.74515f, -65.35303f},
                                    {-5.43546f, 4.64585f, 26.31244f}};
  const float t = std::clamp(value, 0.0f, 1.0f);
  Colour colour{c[6][0], c[6][1], c[6][2]};
  for (int degree = 5; degree >= 0; --degree)
    for (std::size_t i = 0; i < 3; ++i) colour[i] = colour[i] * t + c[degree][i];
  return colour;
}

BodyView::BodyView(std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::span<const Vec3> positions_ws, BodySide side, int width, int height)
    : width_(width), height_(height), triangles_(triangles.begin(), triangles.end()) {
  const Bounds box = bounds_of(positions_ws);
  const Vec3 size = box.high - box.low;
  const float metres_per_pixel =
      // 1e-6 is for a body whose vertices all lie at one point.
      margin * std::max({size.x / float(width), size.y / float(height), 1e-6f});
  cast(positions_ws,
       {0.5f * (box.low + box.high), {0, 0, side == BodySide::front ? 1.0f : -1.0f}, metres_per_pixel});
}

BodyView::BodyView(std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::span<const Vec3> positions_ws, const BodyCamera& camera, int width, int height)
    : width_(width), height_(height), triangles_(triangles.begin(), triangles.end()) {
  cast(positions_ws, camera);
}

void BodyView::cast(std::span<const Vec3> positions_ws, const BodyCamera& camera) {
  const Bounds box = bounds_of(positions_ws);
  const Vec3 above = std::fabs(camera.towards.y) > 0.99f ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
  const Vec3 right = normalised(cross(above, camera.towards)), up = cross(camera.towards, right);
  const float beyond =
      length(box.high - box.low) + length(0.5f * (box.low + box.high) - camera.centre_ws) + 1;
  const RayScene scene(RayDevice(), positions_ws, triangles_);
  const int columns = width_ * samples, rows = height_ * samples;
  hits_.resize(std::size_t(columns) * std::size_t(rows));
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x) {
      const float to_right = ((float(x) + 0.5f) / samples - 0.5f * float(width_)) * camera.metres_per_pixel;
      const float to_top = (0.5f * float(height_) - (float(y) + 0.5f) / samples) * camera.metres_per_pixel;
      const RayHit hit = scene.nearest(
          camera.centre_ws + to_right * right + to_top * up + beyond * camera.towards, -camera.towards);
      hits_[std::size_t(y) * std::size_t(columns) + std::size_t(x)] = {
          hit.triangle, hit.u, hit.v, std::fabs(dot(hit.normal, camera.towards))};
    }
  });
}

Picture BodyView::draw(std::span<const float> vertex_value, Colour (*colour)(float), float relief) const {
  Picture picture{width_, height_, std::vector<std::uint8_t>(3 * std::size_t(width_) * std::size_t(height_))};
  const std::size_t columns = std::size_t(width_) * samples;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      Colour sum{};
      for (int s = 0; s < samples * samples; ++s) {
        const Hit& hit =
            hits_[std::size_t(y * samples + s / samples) * columns + std::size_t(x * samples + s % samples)];
        Colour c = background;
        if (hit.triangle != nothing) {
          const auto& t = triangles_[hit.triangle];
          c = colour((1 - hit.u - hit.v) * vertex_value[t[0]] + hit.u * vertex_value[t[1]] +
                     hit.v * vertex_value[t[2]]);
          for (float& channel : c) channel *= 1 - relief * (1 - hit.cosine);
        }
        for (std::size_t i = 0; i < 3; ++i) sum[i] += c[i] / (samples * samples);
      }
      std::uint8_t* pixel = &picture.rgb[3 * (std::size_t(y) * std::size_t(width_) + std::size_t(x))];
      for (std::size_t i = 0; i < 3; ++i) pixel[i] = to_byte(sum[i]);
    }
  return picture;
}

Picture side_by_side(std::span<const Picture> pictures) {
  Picture all;
  all.height = pictures.front().height;
  for (const Picture& p : pictures) all.width += p.width;
  for (int y = 0; y < all.height; ++y)
    for (const Picture& p : pictures) {
      const auto row = p.rgb.begin() + 3 * std::ptrdiff_t(y) * p.width;
      all.rgb.insert(all.rgb.end(), row, row + 3 * std::ptrdiff_t(p.width));
    }
  return all;
}

std::vector<std::byte> png_bytes(const Picture& picture) {
  std::string why;
  std::vector<std::byte> bytes =
      platform::image_codec().encode("picture.png", picture.width, picture.height, 3, picture.rgb, why);
  if (bytes.empty()) throw Failure(NOOK_ERROR_INTERNAL, "a picture cannot be encoded: %s", why.c_str());
  return bytes;
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  platform::OutputFile(path).commit(png_bytes(picture));
}

}  // namespace nook::bake

namespace nook::bake::probe {
namespace {

constexpr float mean_shade = 0.35f;  // the map's mean luminance is drawn with this linear value

// Compresses bright values, so that a sun keeps its shape, and applies the sRGB curve.
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
  // With an exposure e, a mean m becomes about m e / (1 + m e). This should equal mean_shade.
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
