// The mean error of parts of an AO image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/measure/nnao/image_error.h"

namespace nook::lab {

inline constexpr std::array<const char*, 4> border_names{"left", "right", "bottom", "top"};
// Bands along a border, in pixels: each goes from the end of the previous one to this distance.
inline constexpr std::array<std::uint32_t, 3> border_bands_px{5, 20, 60};

// Measures the dark or bright rim of an AO image: its mean error by the distance to each border of the
// screen. Sums over pixels with a surface, over any number of images.
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
  std::array<std::array<measure::Mean, border_bands_px.size()>, border_names.size()> band_;
  measure::Mean rim_, inside_;
};

// The mean error where the truth is dark, and for each value of the image. Sums over pixels with a surface,
// over any number of images.
class Calibration {
 public:
  // Adds an image with one value for each pixel. A pixel counts if its depth is finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth);
  void add(const Calibration& other);

  // Returns the mean of AO - truth where the truth is below 0.35; 0 without such pixels. Above 0, dark parts
  // are too bright.
  double dark_bias() const;
  // Returns the largest magnitude of the mean of AO - truth, over the tenths of AO that hold at least 0.5 %
  // of the pixels.
  double largest_bias() const;

 private:
  static constexpr std::size_t tenths = 10;
  std::array<measure::Mean, tenths> tenth_;
  measure::Mean dark_;
};

}  // namespace nook::lab
