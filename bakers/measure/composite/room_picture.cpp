#include "bakers/measure/composite/room_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "platform/platform.h"

namespace nook::measure {
namespace {

using Rgb = std::array<float, 3>;

// The mean of two by two pixels.
Rgb shown(const RoomView& view, const std::vector<float>& ao, std::size_t x, std::size_t y) {
  constexpr Rgb blue{0.30f, 0.36f, 0.46f};
  Rgb sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t i = (2 * y + k / 2) * view.view.camera.width + 2 * x + k % 2;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += 0.25f * (view.is_figure[i] ? blue[c] : ao[i]);
  }
  return sum;
}

}  // namespace

void write_room_picture(const std::filesystem::path& file, const RoomView& view,
                        std::span<const std::vector<float>> panels) {
  const std::size_t width = view.view.camera.width / 2, height = view.view.camera.height / 2;
  platform::Image image;
  image.width = int(width * panels.size());
  image.height = int(height);
  image.channels = 3;
  for (std::size_t y = 0; y < height; ++y)
    for (const std::vector<float>& ao : panels)
      for (std::size_t x = 0; x < width; ++x)
        for (const float channel : shown(view, ao, x, height - 1 - y))
          image.pixels.push_back(std::uint8_t(std::lround(255 * std::clamp(channel, 0.0f, 1.0f))));
  platform::write_image(file, image);
}

}  // namespace nook::measure
