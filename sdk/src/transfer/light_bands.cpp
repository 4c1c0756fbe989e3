#include "sdk/src/transfer/light_bands.h"

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::transfer {

std::array<Vec3, band_count> bands_of_lobes(std::span<const Vec3> axes, float sharpness,
                                            std::span<const float> amplitudes) {
  std::array<Vec3, band_count> sums{};
  for (std::size_t j = 0; j < axes.size(); ++j) {
    const Vec3 amplitude{amplitudes[3 * j], amplitudes[3 * j + 1], amplitudes[3 * j + 2]};
    const std::array<float, band_count> at = bands_at(axes[j]);
    for (std::uint32_t k = 0; k < band_count; ++k) sums[k] += amplitude * at[k];
  }
  // A lobe is a zonal filter: it scales each band of a point light along its axis.
  const std::array<float, 5> band = gaussian_bands(sharpness);
  const float whole = gaussian_integral(sharpness);
  for (std::uint32_t k = 0; k < band_count; ++k)
    sums[k] = sums[k] * (whole * band[k == 0 ? 0 : k < 4 ? 1 : 2]);
  return sums;
}

}  // namespace nook::transfer
