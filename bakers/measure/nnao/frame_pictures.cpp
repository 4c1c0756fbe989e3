#include "bakers/measure/nnao/frame_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nook::measure {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour no_surface{0.05f, 0.1f, 0.35f};
constexpr int columns = 3, gap_px = 4;

// `colour(i)` must return the colour of pixel i. Pixels are numbered row by row, starting with the lowest
// row.
template <class ColourOf>
platform::Image picture_of(int width, int height, ColourOf&& colour) {
  platform::Image image{width, height, 3, {}};
  image.pixels.reserve(3 * std::size_t(width) * std::size_t(height));
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (const float value : colour(std::size_t(y) * std::size_t(width) + std::size_t(x)))
        image.pixels.push_back(std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f))));
  return image;
}

const FrameRow* find_row(std::span<const FrameRow> rows, const std::string& method) {
  const auto found = std::ranges::find(rows, method, &FrameRow::method);
  return found == rows.end() ? nullptr : &*found;
}

std::string picture_name(const FrameRow& row) {
  if (row.is_library || row.pass.taps == oracle_taps) return row.method;
  return row.method + "_" + std::to_string(row.pass.taps);
}

}  // namespace

platform::Image depth_picture(const bake::nnao::TracedView& view) {
  const bool orthographic = view.camera.rays.orthographic;
  std::vector<float> nearness, sorted;
  for (const float depth : view.depth) {
    nearness.push_back(orthographic ? -depth : 1 / depth);
    if (std::isfinite(depth)) sorted.push_back(nearness.back());
  }
  std::ranges::sort(sorted);
  const float low = sorted.empty() ? 0 : sorted[sorted.size() / 100];
  const float high = sorted.empty() ? 1 : sorted[sorted.size() * 99 / 100];
  const float range = std::max(high - low, 1e-12f);
  return picture_of(int(view.camera.width), int(view.camera.height), [&](std::size_t i) -> Colour {
    if (!std::isfinite(view.depth[i])) return no_surface;
    const float grey = 0.05f + 0.95f * (nearness[i] - low) / range;
    return {grey, grey, grey};
  });
}

platform::Image normal_picture(const bake::nnao::TracedView& view) {
  return picture_of(int(view.camera.width), int(view.camera.height), [&](std::size_t i) -> Colour {
    const Vec3 n = view.normal[i];
    if (!std::isfinite(view.depth[i])) return {};
    return {0.5f * n.x + 0.5f, 0.5f * n.y + 0.5f, 0.5f * n.z + 0.5f};
  });
}

platform::Image ao_picture(std::span<const float> ao, int width, int height) {
  return picture_of(width, height, [&](std::size_t i) -> Colour { return {ao[i], ao[i], ao[i]}; });
}

platform::Image difference_picture(std::span<const float> a, std::span<const float> b, int width,
                                   int height) {
  return picture_of(width, height, [&](std::size_t i) -> Colour {
    // Both values are first rounded to 8 bits, as in difference_of.
    const float more = 16 * (std::round(255 * b[i]) - std::round(255 * a[i])) / 255,
                grey = 0.5f - 0.5f * std::min(std::abs(more), 1.0f);
    return {grey + std::max(-more, 0.0f), grey, grey + std::max(more, 0.0f)};
  });
}

std::vector<NamedPicture> frame_pictures(const bake::nnao::TracedView& view, std::span<const FrameRow> rows) {
  const int width = int(view.camera.width), height = int(view.camera.height);
  std::vector<NamedPicture> pictures;
  pictures.push_back({"depth", depth_picture(view)});
  pictures.push_back({"normals", normal_picture(view)});
  const FrameRow* const recorded = find_row(rows, recorded_name);
  const FrameRow* const replayed = find_row(rows, replayed_name);
  for (const FrameRow& row : rows) {
    pictures.push_back({picture_name(row), ao_picture(row.ao, width, height)});
    if (&row == replayed && recorded)
      pictures.push_back({"difference", difference_picture(recorded->ao, row.ao, width, height)});
  }
  return pictures;
}

platform::Image picture_sheet(std::span<const NamedPicture> pictures) {
  const int width = pictures.front().image.width, height = pictures.front().image.height;
  const int rows = (int(pictures.size()) + columns - 1) / columns;
  platform::Image sheet{columns * (width + gap_px) - gap_px, rows * (height + gap_px) - gap_px, 3, {}};
  sheet.pixels.assign(3 * std::size_t(sheet.width) * std::size_t(sheet.height), 40);
  for (std::size_t cell = 0; cell < pictures.size(); ++cell) {
    const int left = int(cell) % columns * (width + gap_px), top = int(cell) / columns * (height + gap_px);
    const std::vector<std::uint8_t>& pixels = pictures[cell].image.pixels;
    for (int y = 0; y < height; ++y)
      std::copy_n(pixels.begin() + 3 * std::ptrdiff_t(y) * width, 3 * width,
                  sheet.pixels.begin() + 3 * (std::ptrdiff_t(top + y) * sheet.width + left));
  }
  return sheet;
}

}  // namespace nook::measure
