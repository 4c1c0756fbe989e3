// The dark or bright rim of an AO image: its mean error by the distance to each border of the screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bakers/measure/nnao/mean.h"

namespace nook::bake::nnao {

inline constexpr std::array<const char*, 4> border_names{"left", "right", "bottom", "top"};
// Bands along a border, in pixels: each goes from the end of the previous one to this distance.
inline constexpr std::array<std::uint32_t, 3> border_bands_px{5, 20, 60};

// Sums over pixels with a surface of any number of images.
class BorderBias {
 public:
  // Adds an image, row by row from the bottom, with one value for each pixel. A pixel counts if its depth is
  // finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
           std::uint32_t width);
  void add(const BorderBias& other);

  // Returns the mean of AO - truth in a band of a border, or 0 if no pixel counts. A pixel in a corner counts
  // at both borders.
  double at(std::size_t border, std::size_t band) const;
  // Returns the mean beyond the bands of all borders.
  double inside() const;
  // Returns the mean over the pixels within 20 px of any border, minus the mean inside: below 0 the rim is
  // dark, above 0 it is bright.
  double rim() const;

 private:
  std::array<std::array<Mean, border_bands_px.size()>, border_names.size()> band_;
  Mean rim_, inside_;
};

}  // namespace nook::bake::nnao
