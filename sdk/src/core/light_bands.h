// Computes means of light over directions, from bands 0 to 2. The light is a sum of lobes. A density gives
// the weight of each direction. All densities are summed before the sum is combined with the light. So the
// cost of a density does not depend on the number of lobes. The mean of the light, weighted by a density
// around d, is
//   scalar + A1 dot(vector, d) + A2 dot(d, tensor d),
// where A1 and A2 are bands 1 and 2 of the density: the means of c and of (3 c^2 - 1) / 2, where c is the
// cosine to d.
//
// Functions with a template parameter F work for every number type that kernels use.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "sdk/src/core/simd_scalar.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"

namespace nook {

template <class F>
struct Direction {
  F x, y, z;
};

template <class F>
struct Colour {
  F r, g, b;
};

// The components x, y, z are the channels red, green, blue.
struct LightBands {
  Vec3 scalar;     // mean radiance of all directions
  Vec3 vector[3];  // x, y, z
  Vec3 tensor[6];  // xx, yy, zz, and twice xy, yz, zx; its trace is 0
  // Lower bound for the radiance of a hemisphere, > 0: a small fraction of the mean radiance of all
  // directions. On the dark side, the sum of fitted lobes can be near 0 or below. Without the bound, a ratio
  // to this sum would be extreme.
  Vec3 darkest;
};

// The bands of a lobe of amplitude 1.
struct LobeBands {
  float scalar = 0, vector = 0, tensor = 0;
};

// Returns the mean radiance over the sphere of a lobe with amplitude 1, and its bands 1 and 2 relative to
// this mean.
inline LobeBands bands_of(float sharpness) {
  const std::array<float, 5> band = gaussian_bands(sharpness);
  return {gaussian_integral(sharpness) / gaussian_integral(0.0f), 3 * band[1], 7.5f * band[2]};
}

// `axis` must be a unit vector, or zero if the lobe is constant.
inline void add_lobe(LightBands& bands, Vec3 axis, Vec3 amplitude, const LobeBands& own) {
  const Vec3 mean = amplitude * own.scalar;
  const float d[3] = {axis.x, axis.y, axis.z};
  for (int i = 0; i < 3; ++i) {
    bands.vector[i] += mean * (own.vector * d[i]);
    bands.tensor[i] += mean * (own.tensor * (d[i] * d[i] - 1.0f / 3));
    bands.tensor[3 + i] += mean * (own.tensor * 2 * d[i] * d[(i + 1) % 3]);
  }
  bands.scalar += mean;
}

inline Vec3 darkest_of(std::span<const SphericalGaussian> lobes) {
  // A hemisphere is never treated as darker than this fraction of the mean radiance of all directions.
  constexpr float darkest_share = 0.02f;
  Vec3 mean;
  for (const SphericalGaussian& lobe : lobes)
    mean += integral(lobe) * (darkest_share / gaussian_integral(0.0f));
  constexpr float tiny = 1e-20f;
  return {std::max(mean.x, tiny), std::max(mean.y, tiny), std::max(mean.z, tiny)};
}

template <class F>
struct GatheredBands {
  F scalar, x, y, z, xx, yy, zz, xy, yz, zx;

  static GatheredBands none() {
    const F o(0.0f);
    return {o, o, o, o, o, o, o, o, o, o};
  }
  // Adds the density exp(dot(b, s)). Its bands are A1 = 1 - 1 / |b| and A2 = 1 - 3 A1 / |b|. A term e^(-2
  // |b|) is left out. It is below 0.015 here, because |b| >= directional_cosine. The only exception is a
  // normal that bone blending has made zero.
  void add(const Direction<F>& b, F weight) {
    const F t = rsqrt(max(fma(b.x, b.x, fma(b.y, b.y, b.z * b.z)), F(1.0f)));
    const F a1 = F(1.0f) - t, a2 = fma(F(-3.0f) * t, a1, F(1.0f));
    const Direction<F> d{b.x * t, b.y * t, b.z * t};
    add(d, weight, weight * a1, weight * a2);
  }
  // Adds a density around the unit vector d. `first` and `second` are the density's bands A1 and A2,
  // multiplied by `weight`.
  void add(const Direction<F>& d, F weight, F first, F second) {
    scalar = scalar + weight;
    x = fma(first, d.x, x);
    y = fma(first, d.y, y);
    z = fma(first, d.z, z);
    const F sx = second * d.x, sy = second * d.y, sz = second * d.z;
    xx = fma(sx, d.x, xx);
    yy = fma(sy, d.y, yy);
    zz = fma(sz, d.z, zz);
    xy = fma(sx, d.y, xy);
    yz = fma(sy, d.z, yz);
    zx = fma(sz, d.x, zx);
  }
  // Returns one channel of the mean light under the summed densities, multiplied by the sum of the weights.
  F light(const LightBands& bands, float Vec3::*channel) const {
    const auto c = [&](const Vec3& v) { return F(v.*channel); };
    const F one = fma(x, c(bands.vector[0]), fma(y, c(bands.vector[1]), z * c(bands.vector[2])));
    const F straight = fma(xx, c(bands.tensor[0]), fma(yy, c(bands.tensor[1]), zz * c(bands.tensor[2])));
    const F mixed = fma(xy, c(bands.tensor[3]), fma(yz, c(bands.tensor[4]), zx * c(bands.tensor[5])));
    return fma(scalar, c(bands.scalar), one) + (straight + mixed);
  }
};

}  // namespace nook
