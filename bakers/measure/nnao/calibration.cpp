#include "bakers/measure/nnao/calibration.h"

#include <algorithm>
#include <cmath>

namespace nook::bake::nnao {
namespace {

constexpr float dark_below = 0.35f;
constexpr double counting_share = 0.005;  // of the pixels; means of fewer pixels are noise

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

}  // namespace nook::bake::nnao
