// Averages of an image over the points of another grid on a tile that repeats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// Takes rows one by one, so that no second image is held. A point of the grid, ((x + 0.5) / side, (y + 0.5) /
// side), receives the mean of the image under a tent as wide as two points or, where the image is the coarser
// one, two texels: there it is the bilinear interpolation.
class TileFilter {
 public:
  TileFilter(std::uint32_t width, std::uint32_t height, std::uint32_t side, std::uint32_t channels);

  // row: width x channels, of the texels whose centres lie at y = (index + 0.5) / height.
  void add_row(std::uint32_t index, std::span<const float> row);

  // Returns y * side + x, channels, after all rows were added.
  std::vector<float> result() const;

 private:
  struct Share {
    std::uint32_t point;
    double weight;
  };
  // For each texel along an axis the points that it counts for.
  static std::vector<std::vector<Share>> shares_of(std::uint32_t size, std::uint32_t side);

  std::uint32_t channels_;
  std::vector<std::vector<Share>> along_x_, along_y_;
  std::vector<double> sum_, row_;
};

}  // namespace nook::bake::material
