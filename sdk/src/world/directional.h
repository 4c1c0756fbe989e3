// Light by colour channel: casters that cover the share f of a point's hemisphere take f rho of its light,
// with rho the mean radiance behind them over that of the hemisphere, both weighted by the cosine. The light
// and what stands in it are taken in bands 0 to 4 (light_terms.h).
//
// A caster counts as the disc of its vector Phi (coverage.h), s = |Phi| the squared sine of its radius. Round
// its middle a disc of a cosine's weight has the bands A1 = 2 (1 - (1 - s)^(3/2)) / (3 s), here within 0.002
// as 1 - s / 4 - s^2 / 12, A2 = 1 - 3 s / 4, A3 = (1 - s)^(3/2) and A4 = 1 - 5 s / 2 + 35 s^2 / 24. They are
// those of the hemisphere, 2 / 3, 1 / 4, 0 and -1 / 24, where the caster fills it, so that rho is then 1. The
// disc that the horizon cuts has its middle halfway up what is left.
//
// Overlap: with AO the product over the casters, the light's open share is 1 - (1 - AO) R, R the mean of rho
// over the casters by their shares. Under constant light it is AO.
#pragma once

#include "sdk/src/world/coverage.h"
#include "sdk/src/world/light_terms.h"

namespace nook::world {

// Adds a caster that covers `share` of the hemisphere round n.
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

// Returns the light's open share in each channel, in [0, 1]. ao: what the gathered casters leave open.
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
