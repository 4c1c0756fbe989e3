// Bands 0 to 4 of light that is a sum of lobes, and bands 0 to 4 of densities over directions. The bands of
// light and of densities are stored as factors of 25 harmonic polynomials. All densities are summed before
// the sum is combined with the light. The mean of the light under a density around d is the sum over the
// bands l of A_l times the light's band l in the direction d. A_l is the mean, under the density, of the
// Legendre polynomial of degree l.
//
// The polynomials are spherical harmonics without their normalisation factors. The factors are included in
// the terms of the light. Bands 3 and 4 are only used if the light has enough lobes. With few lobes, these
// bands would contain the shape of the lobes, and not the light. Band 3 is weighted by 0.8 and band 4 by 0.6,
// to reduce ringing.
#pragma once

#include <span>

#include "sdk/src/core/light_bands.h"
#include "sdk/src/world/coverage.h"
#include "shaders/world/constants.h"

namespace nook::world {

inline constexpr int light_band_count = 5, light_term_count = NOOK_LIGHT_TERMS;
inline constexpr std::size_t lobes_for_all_bands = 24;

// The components x, y, z are the channels red, green, blue.
struct LightTerms {
  Vec3 term[light_term_count];
  Vec3 darkest;  // see LightBands::darkest
};

// Evaluates each polynomial at the unit vector d, and calls visit(index, band, value).
template <class F, class Visit>
void visit_terms(const Direction<F>& d, Visit&& visit) {
  const F one(1.0f), three(3.0f);
  const F xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
  const F xy = d.x * d.y, yz = d.y * d.z, zx = d.z * d.x, squares = xx - yy;
  visit(0, 0, one);
  visit(1, 1, d.x);
  visit(2, 1, d.y);
  visit(3, 1, d.z);
  visit(4, 2, fma(three, zz, F(-1.0f)));
  visit(5, 2, xy);
  visit(6, 2, yz);
  visit(7, 2, zx);
  visit(8, 2, squares);
  const F five = fma(F(5.0f), zz, F(-1.0f)), along_x = xx - three * yy, along_y = three * xx - yy;
  visit(9, 3, d.y * along_y);
  visit(10, 3, xy * d.z);
  visit(11, 3, d.y * five);
  visit(12, 3, d.z * (five - F(2.0f)));
  visit(13, 3, d.x * five);
  visit(14, 3, d.z * squares);
  visit(15, 3, d.x * along_x);
  const F seven = fma(F(7.0f), zz, F(-1.0f));
  visit(16, 4, fma(zz, fma(F(35.0f), zz, F(-30.0f)), three));
  visit(17, 4, xy * squares);
  visit(18, 4, yz * along_y);
  visit(19, 4, xy * seven);
  visit(20, 4, yz * (seven - F(2.0f)));
  visit(21, 4, zx * (seven - F(2.0f)));
  visit(22, 4, squares * seven);
  visit(23, 4, zx * along_x);
  visit(24, 4, xx * along_x - yy * along_y);
}

// Sums of densities.
template <class F>
struct GatheredTerms {
  F sum[light_term_count];

  static GatheredTerms none() {
    GatheredTerms terms;
    for (F& s : terms.sum) s = F(0.0f);
    return terms;
  }
  // Adds a density around the unit vector d, multiplied by `weight`.
  void add(const Direction<F>& d, F weight, const F (&band)[light_band_count]) {
    F scaled[light_band_count];
    for (int l = 0; l < light_band_count; ++l) scaled[l] = weight * band[l];
    visit_terms(d, [&](int i, int l, F value) { sum[i] = fma(scaled[l], value, sum[i]); });
  }
  // Returns one channel of the mean light under the summed densities, multiplied by the sum of the weights.
  F light(const LightTerms& light, float Vec3::*channel) const {
    F all(0.0f);
    for (int i = 0; i < light_term_count; ++i) all = fma(sum[i], F(light.term[i].*channel), all);
    return all;
  }
};

// Returns the terms of the lobes. The axis of a lobe must be a unit vector, or zero if the lobe is constant.
inline LightTerms terms_of(std::span<const SphericalGaussian> lobes) {
  // 4 pi times the squared factors of the harmonics.
  constexpr float square[light_term_count] = {1,      3,       3,         3,          1.25f,   15,     15,
                                              15,     3.75f,   4.375f,    105,        2.625f,  1.75f,  2.625f,
                                              26.25f, 4.375f,  9.0f / 64, 78.75f,     39.375f, 11.25f, 5.625f,
                                              5.625f, 2.8125f, 39.375f,   315.0f / 64};
  const bool all = lobes.size() >= lobes_for_all_bands;
  const float taper[light_band_count] = {1, 1, 1, all ? 0.8f : 0.0f, all ? 0.6f : 0.0f};
  LightTerms light;
  for (const SphericalGaussian& lobe : lobes) {
    const Vec3 mean = integral(lobe) * (1 / gaussian_integral(0.0f));
    const std::array<float, light_band_count> band = gaussian_bands(lobe.sharpness);
    const Vec3 d = lobe.axis;
    visit_terms(Direction<float>{d.x, d.y, d.z}, [&](int i, int l, float value) {
      light.term[i] += mean * (taper[l] * band[std::size_t(l)] * square[i] * value);
    });
  }
  light.darkest = darkest_of(lobes);
  return light;
}

// Occlusion of light for each colour channel. If casters cover the share f of a point's hemisphere, they
// remove the share f rho of the light that it receives. rho is the mean radiance behind the casters, divided
// by the mean radiance of the hemisphere, both weighted by the cosine. The light and the casters are reduced
// to bands 0 to 4.
//
// A caster is treated as the disc that has the caster's vector Phi (coverage.h). s = |Phi| is the squared
// sine of the disc's angular radius. Relative to the direction of its centre, a cosine-weighted disc has the
// bands A1 = 2 (1 - (1 - s)^(3/2)) / (3 s), approximated within 0.002 by 1 - s / 4 - s^2 / 12, A2 = 1 - 3 s /
// 4, A3 = (1 - s)^(3/2) and A4 = 1 - 5 s / 2 + 35 s^2 / 24. If the caster fills the hemisphere, these bands
// equal the bands of the hemisphere, which are 2 / 3, 1 / 4, 0 and -1 / 24. Then rho is 1. If the horizon
// cuts the disc, the middle of the part above the horizon is used as its centre.
//
// If several casters darken a point, AO is the product of their open shares, and the open share of the light
// is 1 - (1 - AO) R. R is the mean of rho over the casters, weighted by their shares. Under constant light
// the result is AO.

// Adds a caster that covers `share` of the hemisphere around n.
template <class F>
void gather(GatheredTerms<F>& gathered, const Direction<F>& n, const Direction<F>& phi, F share) {
  const F one(1.0f), half(0.5f);
  const F size2 = fma(phi.x, phi.x, fma(phi.y, phi.y, phi.z * phi.z));
  const F inverse_size = rsqrt(max(size2, F(1e-20f)));
  const F size = min(size2 * inverse_size, one), sine = sqrt(size);
  const F cosine = fma(phi.x, n.x, fma(phi.y, n.y, phi.z * n.z)) * inverse_size;
  const F lift = max(half * (max(cosine, F(0.0f) - sine) + sine) - cosine, F(0.0f));
  const Direction<F> d{fma(phi.x, inverse_size, n.x * lift), fma(phi.y, inverse_size, n.y * lift),
                       fma(phi.z, inverse_size, n.z * lift)};
  const F t = rsqrt(max(fma(d.x, d.x, fma(d.y, d.y, d.z * d.z)), F(1e-12f)));
  const F left = one - size;
  const F band[light_band_count] = {
      one, one - size * fma(size, F(float(NOOK_DISC_BAND_12)), F(float(NOOK_DISC_BAND_11))),
      one - size * F(float(NOOK_DISC_BAND_21)), left * sqrt(left),
      one - size * fma(size, F(float(-NOOK_DISC_BAND_42)), F(float(NOOK_DISC_BAND_41)))};
  gathered.add(Direction<F>{d.x * t, d.y * t, d.z * t}, share, band);
}

// Returns the open share of the light in each channel, in [0, 1]. `ao` is the AO of the gathered casters.
template <class F>
Colour<F> open_light(const GatheredTerms<F>& gathered, const LightTerms& light, const Direction<F>& n, F ao) {
  const F one(1.0f), zero(0.0f);
  GatheredTerms<F> hemisphere = GatheredTerms<F>::none();
  hemisphere.add(n, one, {one, F(2.0f / 3), F(0.25f), zero, F(-1.0f / 24)});
  const F scale = (one - ao) / max(gathered.sum[0], F(1e-12f));
  const auto channel = [&](float Vec3::*c) {
    const F ratio = gathered.light(light, c) / max(hemisphere.light(light, c), F(light.darkest.*c));
    return min(max(one - scale * ratio, zero), one);
  };
  return {channel(&Vec3::x), channel(&Vec3::y), channel(&Vec3::z)};
}

}  // namespace nook::world
