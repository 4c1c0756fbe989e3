#include "bakers/lab/nnao/image_bias.h"

#include <algorithm>
#include <cmath>

namespace nook::lab {

using namespace measure;

namespace {

constexpr std::uint32_t rim_px = border_bands_px[1];

std::size_t band_of(std::uint32_t distance_px) {
  return std::size_t(std::ranges::upper_bound(border_bands_px, distance_px) - border_bands_px.begin());
}

}  // namespace

void BorderBias::add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth,
                     std::uint32_t width) {
  const std::uint32_t height = std::uint32_t(ao.size() / width);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (!std::isfinite(depth[i])) continue;
    const auto x = std::uint32_t(i % width), y = std::uint32_t(i / width);
    const std::array<std::uint32_t, 4> distance_px{x, width - 1 - x, y, height - 1 - y};
    const double error = double(ao[i]) - double(truth[i]);
    const std::uint32_t nearest_px = std::ranges::min(distance_px);
    if (nearest_px < rim_px) rim_.add(error);
    if (nearest_px >= border_bands_px.back()) inside_.add(error);
    for (std::size_t border = 0; border < distance_px.size(); ++border)
      if (distance_px[border] < border_bands_px.back())
        band_[border][band_of(distance_px[border])].add(error);
  }
}

void BorderBias::add(const BorderBias& other) {
  for (std::size_t border = 0; border < band_.size(); ++border)
    for (std::size_t band = 0; band < band_[border].size(); ++band)
      band_[border][band].add(other.band_[border][band]);
  rim_.add(other.rim_);
  inside_.add(other.inside_);
}

double BorderBias::at(std::size_t border, std::size_t band) const {
  return band_[border][band].value();
}

double BorderBias::inside() const {
  return inside_.value();
}

double BorderBias::rim() const {
  return rim_.count > 0 && inside_.count > 0 ? rim_.value() - inside_.value() : 0;
}

namespace {

constexpr float dark_below = 0.35f;
// Smallest fraction of the pixels that a bin needs; the mean of fewer pixels is mostly noise.
constexpr double counting_share = 0.005;

}  // namespace

void Calibration::add(std::span<const float> ao, std::span<const float> truth, std::span<const float> depth) {
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (!std::isfinite(depth[i])) continue;
    const double error = double(ao[i]) - double(truth[i]);
    const float place = float(tenths) * std::clamp(ao[i], 0.0f, 1.0f);
    tenth_[std::min(std::size_t(place), tenths - 1)].add(error);
    if (truth[i] < dark_below) dark_.add(error);
  }
}

void Calibration::add(const Calibration& other) {
  for (std::size_t i = 0; i < tenths; ++i) tenth_[i].add(other.tenth_[i]);
  dark_.add(other.dark_);
}

double Calibration::dark_bias() const {
  return dark_.value();
}

double Calibration::largest_bias() const {
  double all = 0, largest = 0;
  for (const Mean& tenth : tenth_) all += tenth.count;
  for (const Mean& tenth : tenth_)
    if (tenth.count > 0 && tenth.count >= counting_share * all)
      largest = std::max(largest, std::abs(tenth.value()));
  return largest;
}

}  // namespace nook::lab
