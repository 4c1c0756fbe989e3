// Whether an AO image has a dark or a bright rim: its mean error by the distance to each border of the
// screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace nook::bake::nnao {

inline constexpr std::array<const char*, 4> border_names{"left", "right", "bottom", "top"};
// Bands along a border: from the end of the one before to so many pixels away.
inline constexpr std::array<std::uint32_t, 3> border_bands_px{5, 20, 60};

// Sums over pixels with a surface, of any number of images.
class BorderBias {
 public:
  // Row by row from the bottom, as many values as pixels; a pixel counts where its depth is finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
           std::uint32_t width);

  // The mean of AO - truth in a band of a border; a pixel in a corner counts at both. 0 where none counts.
  double at(std::size_t border, std::size_t band) const;
  // Beyond the bands of all borders.
  double inside() const;
  // The mean over the pixels within 20 px of any border, less that inside: below 0 a dark rim, above 0 a
  // bright one.
  double rim() const;

 private:
  struct Mean {
    double sum = 0, count = 0;
    double value() const { return count > 0 ? sum / count : 0; }
  };
  std::array<std::array<Mean, border_bands_px.size()>, border_names.size()> band_;
  Mean rim_, inside_;
};

}  // namespace nook::bake::nnao
