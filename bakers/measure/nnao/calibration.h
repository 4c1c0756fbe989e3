// The mean error of an AO image: where the truth is dark, and for each value that the image gives.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bakers/measure/nnao/mean.h"

namespace nook::bake::nnao {

// Sums over pixels with a surface of any number of images.
class Calibration {
 public:
  // Adds an image with one value for each pixel. A pixel counts if its depth is finite.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth);
  void add(const Calibration& other);

  // Returns the mean of AO - truth where the truth is below 0.35, or 0 if it is nowhere: above 0 dark parts
  // are too bright.
  double dark_bias() const;
  // Returns the largest |mean of AO - truth| over those tenths of AO that hold 0.5 % of the pixels or more.
  double largest_bias() const;

 private:
  static constexpr std::size_t tenths = 10;
  std::array<Mean, tenths> tenth_;
  Mean dark_;
};

}  // namespace nook::bake::nnao
