// Measures the mean error in parts of an AO image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/measure/nnao/image_error.h"

namespace nook::lab {

inline constexpr std::array<const char*, 4> border_names{"left", "right", "bottom", "top"};
// Bands run along each border of the image. These are the distances from the border at which the bands end,
// in pixels. Each band begins where the previous band ends.
inline constexpr std::array<std::uint32_t, 3> border_bands_px{5, 20, 60};

// Measures whether AO images have a dark or bright rim. It computes the mean error as a function of the
// distance to each border of the screen. You can add any number of images. Only pixels with a surface count.
class BorderBias {
 public:
  // Adds an image, row by row from the bottom, with one value for each pixel. A pixel counts if its depth is
  // finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
           std::uint32_t width);
  void add(const BorderBias& other);

  // Returns the mean of AO - truth in one band of one border, or 0 if the band has no pixels. A pixel in a
  // corner counts for both borders.
  double at(std::size_t border, std::size_t band) const;
  // Returns the mean of AO - truth over the pixels that are in no band.
  double inside() const;
  // Returns the mean of AO - truth within 20 px of any border, minus inside(). A negative result means a dark
  // rim, and a positive result a bright rim.
  double rim() const;

 private:
  std::array<std::array<measure::Mean, border_bands_px.size()>, border_names.size()> band_;
  measure::Mean rim_, inside_;
};

// Measures the mean error where the reference is dark, and the mean error as a function of the AO in the
// image. You can add any number of images. Only pixels with a surface count.
class Calibration {
 public:
  // Adds an image with one value for each pixel. A pixel counts if its depth is finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth);
  void add(const Calibration& other);

  // Returns the mean of AO - truth over the pixels whose true AO is below 0.35, or 0 if there are none. A
  // positive result means that dark areas are too bright.
  double dark_bias() const;
  // Divides the range of AO into ten equal bins and computes the mean of AO - truth in each bin. Returns the
  // largest absolute value of these means. Bins with fewer than 0.5 % of the pixels are ignored.
  double largest_bias() const;

 private:
  static constexpr std::size_t tenths = 10;
  std::array<measure::Mean, tenths> tenth_;
  measure::Mean dark_;
};

}  // namespace nook::lab
