// The error of an AO image.
#pragma once

#include <cstdint>
#include <span>

namespace nook::measure {

// A running mean.
struct Mean {
  double sum = 0, count = 0;

  void add(double value) {
    sum += value;
    count += 1;
  }
  void add(const Mean& other) {
    sum += other.sum;
    count += other.count;
  }
  // Returns 0 before the first value.
  double value() const { return count > 0 ? sum / count : 0; }
};

// Sums over pixels with a surface, over any number of images.
class ImageError {
 public:
  // Adds an image with one value for each pixel, row by row. Only pixels with finite depth count.
  void add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
           std::uint32_t width);
  void add(const ImageError& other);

  double mse() const;
  // Returns the structural similarity (Wang et al. 2004) for values in [0, 1]. Windows have 11 x 11 pixels
  // and Gaussian weights with a standard deviation of 1.5 pixels. The result is the mean over the windows
  // whose central pixel has finite depth.
  double ssim() const;
  // Returns Pearson's correlation, or 0 if either image is constant.
  double correlation() const;

 private:
  double count_ = 0, squared_error_ = 0, ssim_ = 0;
  double a_ = 0, b_ = 0, aa_ = 0, bb_ = 0, ab_ = 0;
};

}  // namespace nook::measure
