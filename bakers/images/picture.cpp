#include "bakers/images/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/ray_scene.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr Colour background{0.32f, 0.34f, 0.38f};
constexpr float margin = 1.04f;

struct Box {
  Vec3 low, high;
};

Box bounds_of(std::span<const Vec3> points) {
  Box box{points.front(), points.front()};
  for (Vec3 p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

std::uint8_t to_byte(float value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

Colour grey(float value) {
  const float v = std::clamp(value, 0.0f, 1.0f);
  return {v, v, v};
}

// A polynomial of degree six through matplotlib's table (M. Zucker, public domain), within 0.01 of it.
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
  const Box box = bounds_of(positions_ws);
  const Vec3 size = box.high - box.low;
  const float metres_per_pixel =
      // A single point also has a scale.
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
  const Box box = bounds_of(positions_ws);
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
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create("png");
  const OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  if (!out || !out->set_ioproxy(&memory) || !out->open("picture.png", spec) ||
      !out->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) || !out->close())
    throw Failure(NOOK_ERROR_INTERNAL, "a picture cannot be encoded: %s",
                  (out ? out->geterror() : OIIO::geterror()).c_str());
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + bytes.size()};
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  platform::OutputFile(path).commit(png_bytes(picture));
}

}  // namespace nook::bake
