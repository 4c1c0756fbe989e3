#include "bakers/measure/nnao/image_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nook::measure {
namespace {

constexpr int reach = 5;
constexpr double sigma = 1.5;

// Returns for each pixel the Gaussian-weighted mean over the window around it. Windows are cut off at the
// borders.
std::vector<double> window_means(const std::vector<double>& image, int width, int height) {
  double weight[reach + 1];
  for (int i = 0; i <= reach; ++i) weight[i] = std::exp(-0.5 * i * i / (sigma * sigma));
  std::vector<double> from = image, to(image.size());
  for (const bool vertical : {false, true}) {
    const int length = vertical ? height : width;
    const std::ptrdiff_t stride = vertical ? width : 1;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int place = vertical ? y : x;
        const std::ptrdiff_t at = std::ptrdiff_t(y) * width + x;
        double sum = 0, total = 0;
        for (int i = std::max(-reach, -place); i <= std::min(reach, length - 1 - place); ++i) {
          sum += weight[std::abs(i)] * from[std::size_t(at + i * stride)];
          total += weight[std::abs(i)];
        }
        to[std::size_t(at)] = sum / total;
      }
    from = to;
  }
  return from;
}

std::vector<double> product(std::span<const float> a, std::span<const float> b) {
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = double(a[i]) * double(b[i]);
  return out;
}

}  // namespace

void ImageError::add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
                     std::uint32_t width) {
  const int w = int(width), h = int(ao.size() / width);
  const std::vector<double> mean_a = window_means({ao.begin(), ao.end()}, w, h);
  const std::vector<double> mean_b = window_means({truth.begin(), truth.end()}, w, h);
  const std::vector<double> mean_aa = window_means(product(ao, ao), w, h);
  const std::vector<double> mean_bb = window_means(product(truth, truth), w, h);
  const std::vector<double> mean_ab = window_means(product(ao, truth), w, h);
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (!std::isfinite(depth[i])) continue;
    const double a = double(ao[i]), b = double(truth[i]);
    count_ += 1;
    squared_error_ += (a - b) * (a - b);
    a_ += a;
    b_ += b;
    aa_ += a * a;
    bb_ += b * b;
    ab_ += a * b;
    const double ma = mean_a[i], mb = mean_b[i];
    const double va = mean_aa[i] - ma * ma, vb = mean_bb[i] - mb * mb, vab = mean_ab[i] - ma * mb;
    ssim_ += (2 * ma * mb + c1) * (2 * vab + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  }
}

void ImageError::add(const ImageError& other) {
  count_ += other.count_;
  squared_error_ += other.squared_error_;
  ssim_ += other.ssim_;
  a_ += other.a_;
  b_ += other.b_;
  aa_ += other.aa_;
  bb_ += other.bb_;
  ab_ += other.ab_;
}

double ImageError::mse() const {
  return count_ > 0 ? squared_error_ / count_ : 0;
}

double ImageError::ssim() const {
  return count_ > 0 ? ssim_ / count_ : 1;
}

double ImageError::correlation() const {
  const double va = count_ * aa_ - a_ * a_, vb = count_ * bb_ - b_ * b_;
  // Treats an image with less variance as constant. The threshold is far below the variance of an image in
  // which only one pixel in a million differs, by two grey levels.
  if (!(va > 1e-9 * count_) || !(vb > 1e-9 * count_)) return 0;
  return (count_ * ab_ - a_ * b_) / std::sqrt(va * vb);
}

}  // namespace nook::measure
