#include "bakers/lab/nnao/view_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::lab {

using namespace nook::nnao;

namespace {

constexpr int sheet_columns = 3, gap_px = 4;

std::vector<float> lit(const bake::nnao::TracedView& view) {
  std::vector<float> grey(view.depth.size(), 1.0f);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Vec3 n = view.normal[i];
    if (std::isfinite(view.depth[i])) grey[i] = 0.25f + 0.5f * std::max(n.z, 0.0f) + 0.2f * n.y * n.y;
  }
  return grey;
}

void paste(platform::Image& sheet, const std::vector<float>& grey, int width, int height, int cell) {
  const int left = cell % sheet_columns * (width + gap_px), top = cell / sheet_columns * (height + gap_px);
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
  const int rows = (2 + int(images.size()) + sheet_columns - 1) / sheet_columns;
  platform::Image sheet{sheet_columns * (width + gap_px) - gap_px, rows * (height + gap_px) - gap_px, 3, {}};
  sheet.pixels.assign(3 * std::size_t(sheet.width) * std::size_t(sheet.height), 40);
  paste(sheet, lit(measured.view), width, height, 0);
  paste(sheet, measured.truth, width, height, 1);
  for (std::size_t i = 0; i < images.size(); ++i) paste(sheet, images[i], width, height, 2 + int(i));
  return sheet;
}

namespace {

constexpr int tile_px = 124;

// Returns the value at a pixel of a tile, where (0, 0) is the lower left corner. The value 0 is drawn as
// middle grey. The values are scaled so that the largest magnitude becomes black or white.
using Tile = std::function<float(int x_px, int y_px)>;

void paste_tile(platform::Image& sheet, int left, int top, const Tile& tile) {
  float most = 1e-12f;
  for (int y = 0; y < tile_px; ++y)
    for (int x = 0; x < tile_px; ++x) most = std::max(most, std::abs(tile(x, y)));
  for (int y = 0; y < tile_px; ++y)
    for (int x = 0; x < tile_px; ++x) {
      const auto byte = std::uint8_t(std::lround(127.5f + 127.5f * tile(x, tile_px - 1 - y) / most));
      const std::size_t at = std::size_t(top + y) * std::size_t(sheet.width) + std::size_t(left + x);
      std::fill_n(sheet.pixels.begin() + std::ptrdiff_t(3 * at), 3, byte);
    }
}

platform::Image tiles_picture(int columns, int rows, const std::function<Tile(int column, int row)>& tile) {
  platform::Image sheet{columns * (tile_px + gap_px) - gap_px, rows * (tile_px + gap_px) - gap_px, 3, {}};
  sheet.pixels.assign(3 * std::size_t(sheet.width) * std::size_t(sheet.height), 40);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      paste_tile(sheet, column * (tile_px + gap_px), row * (tile_px + gap_px), tile(column, row));
  return sheet;
}

platform::Image paper_filters(const PaperNetwork& network) {
  constexpr int size = PaperNetwork::grid_size, inputs = PaperNetwork::tap_inputs,
                units = PaperNetwork::units;
  static_assert(tile_px % size == 0);
  return tiles_picture(units, inputs, [&](int unit, int input) -> Tile {
    return [&network, unit, input](int x, int y) {
      const int cell = y * size / tile_px * size + x * size / tile_px;
      return network.filters[std::size_t((cell * inputs + input) * units + unit)];
    };
  });
}

platform::Image horizon_units(const HorizonNetwork& network) {
  constexpr int units = HorizonNetwork::units, columns = 4;
  return tiles_picture(columns, units / columns, [&](int column, int row) -> Tile {
    const auto u = std::size_t(row * columns + column);
    return [&network, u](int x, int y) {
      const auto share = [](int at) { return (float(at) + 0.5f) / tile_px; };
      const auto& tap = network.tap;
      const float elevation = 2 * share(y) - 1, nearness = 1 - share(x);
      const float sum = elevation * (tap.weights[u] + tap.weights[2 * units + u] * nearness);
      return std::max(sum, 0.0f);
    };
  });
}

}  // namespace

platform::Image filter_picture(const Network& network) {
  return network.form == NetworkForm::paper ? paper_filters(network.paper) : horizon_units(network.horizon);
}

platform::Image unit_picture(const Network& network, const MeasuredView& measured) {
  const View view = measured.view.view();
  const Sampling sampling{measured.radius, 0.5f * float(view.height), 64};
  const std::size_t pixels = std::size_t(view.width) * view.height;
  std::vector<std::array<float, 3>> units(pixels);
  std::array<std::vector<float>, 3> sorted;
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      if (!view.has_surface(x, y)) continue;
      units[view.at(x, y)] = first_units(network, view, sampling, x, y);
      for (std::size_t u = 0; u < 3; ++u) sorted[u].push_back(units[view.at(x, y)][u]);
    }
  for (std::vector<float>& values : sorted) std::ranges::sort(values);
  platform::Image image{int(view.width), int(view.height), 3, {}};
  image.pixels.assign(3 * pixels, 255);
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      if (!view.has_surface(x, y)) continue;
      for (std::size_t u = 0; u < 3; ++u) {
        const float low = sorted[u][sorted[u].size() / 100], high = sorted[u][sorted[u].size() * 99 / 100];
        const float share =
            std::clamp((units[view.at(x, y)][u] - low) / std::max(high - low, 1e-12f), 0.0f, 1.0f);
        // Channel `u` of the pixel gets darker with the share of unit `u`, because cyan absorbs red, magenta
        // absorbs green, and yellow absorbs blue.
        image.pixels[3 * view.at(x, view.height - 1 - y) + u] = std::uint8_t(std::lround(255 * (1 - share)));
      }
    }
  return image;
}

}  // namespace nook::lab
