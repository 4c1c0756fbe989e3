#include "bakers/measure/nnao/sheet.h"

#include <algorithm>
#include <cmath>

namespace nook::measure {
namespace {

constexpr int columns = 3, gap_px = 4;

std::vector<float> lit(const bake::nnao::TracedView& view) {
  std::vector<float> grey(view.depth.size(), 1.0f);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Vec3 n = view.normal[i];
    if (std::isfinite(view.depth[i])) grey[i] = 0.25f + 0.5f * std::max(n.z, 0.0f) + 0.2f * n.y * n.y;
  }
  return grey;
}

void paste(platform::Image& sheet, const std::vector<float>& grey, int width, int height, int cell) {
  const int left = cell % columns * (width + gap_px), top = cell / columns * (height + gap_px);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = grey[std::size_t(height - 1 - y) * std::size_t(width) + std::size_t(x)];
      const auto byte = std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
      const std::size_t at = std::size_t(top + y) * std::size_t(sheet.width) + std::size_t(left + x);
      std::fill_n(sheet.pixels.begin() + std::ptrdiff_t(3 * at), 3, byte);
    }
}

}  // namespace

platform::Image make_sheet(const MeasuredView& measured, std::span<const std::vector<float>> images) {
  const int width = int(measured.view.camera.width), height = int(measured.view.camera.height);
  const int rows = (2 + int(images.size()) + columns - 1) / columns;
  platform::Image sheet{columns * (width + gap_px) - gap_px, rows * (height + gap_px) - gap_px, 3, {}};
  sheet.pixels.assign(3 * std::size_t(sheet.width) * std::size_t(sheet.height), 40);
  paste(sheet, lit(measured.view), width, height, 0);
  paste(sheet, measured.truth, width, height, 1);
  for (std::size_t i = 0; i < images.size(); ++i) paste(sheet, images[i], width, height, 2 + int(i));
  return sheet;
}

}  // namespace nook::measure
