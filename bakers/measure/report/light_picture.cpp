#include "bakers/measure/report/light_picture.h"

#include <algorithm>
#include <cmath>

namespace nook::report {
namespace {

float encoded(float linear) {
  const float value = std::clamp(linear, 0.0f, 1.0f);
  return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

}  // namespace

bake::Colour display(Vec3 linear) {
  return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

void set_pixel(bake::Picture& picture, int x, int y, bake::Colour colour) {
  std::uint8_t* pixel = &picture.rgb[3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = std::uint8_t(std::lround(255 * std::clamp(colour[c], 0.0f, 1.0f)));
}

bake::Picture plain_picture(int width, int height, bake::Colour colour) {
  bake::Picture picture{width, height,
                        std::vector<std::uint8_t>(3 * std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(picture, x, y, colour);
  return picture;
}

}  // namespace nook::report
