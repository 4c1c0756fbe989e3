// Directional occlusion: the share of the light in a key point's hemisphere that comes from behind one
// sphere. The light is a sum of lobes (core/spherical_gaussian.h). If a sphere covers the fraction f of the
// cosine-weighted hemisphere, it removes the fraction f rho of the irradiance in each channel, with
//   rho = mean radiance behind the sphere / mean radiance of the hemisphere
// Under constant light rho is 1, and the result is plain occlusion.
//
// Both means are weighted by a density over directions that is proportional to exp(dot(b, s)). With b = h n,
// the density approximates the clamped cosine. With b = h n + k d, it approximates the clamped cosine
// restricted to the directions behind the sphere; d points to the part of the sphere above the horizon. The
// mean of a lobe with the vector a = sharpness * axis then has the closed form
//   e^(m - |a| - |b|) N(m) / N(|b|),  m = |a + b|,  N(v) = (1 - e^(-2 v)) / v.
//
// All functions are templates over a number type F, as in kernel.h.
#pragma once

#include <cstdint>

#include "sdk/src/core/light_bands.h"
#include "sdk/src/core/simd_scalar.h"
#include "sdk/src/core/vec.h"
#include "shaders/character/constants.h"
#include "shaders/core/constants.h"

namespace nook {

// One lobe of the light, with vector = sharpness * axis.
struct LightLobe {
  Vec3 vector;
  float sharpness = 0;
  Vec3 amplitude;   // linear RGB
  float above = 1;  // the fraction of the lobe's light that the ground does not hide
};

struct LightView {
  const LightLobe* lobes = nullptr;
  std::uint32_t count = 0;
  // Lower bound for the radiance of a hemisphere, > 0: a small fraction of the mean radiance of all
  // directions. On the dark side, the sum of fitted lobes can be near 0 or below. Without the bound, rho
  // would be extreme there.
  Vec3 darkest;
};

// The sharpness of the lobe that approximates the clamped cosine, as in core/spherical_gaussian.h.
inline constexpr float directional_cosine = float(NOOK_COSINE_LOBE_SHARPNESS);
// k = caster_concentration sqrt(height) (1 - f^2) / f. With this k, a far sphere becomes a lobe of the
// sphere's solid angle, and a sphere that fills the hemisphere becomes the hemisphere.
inline constexpr float caster_concentration = float(NOOK_CASTER_CONCENTRATION);
inline constexpr float smallest_share = float(NOOK_SMALLEST_SHARE);
// The upper limit of rho: a sphere that covers the fraction f of the hemisphere removes at most this factor
// times f of the light. This limits the effect of a single bright lobe.
inline constexpr float largest_ratio = float(NOOK_LARGEST_RATIO);

// Returns (1 - e^(-2 v)) / v as 1 / (v + v / (e^(2 v) - 1)) with the power series of the exponential. The
// relative error is below 0.006 for v from 0 to 1e6.
template <class F>
F lobe_norm(F v) {
  constexpr float c[] = {float(NOOK_LOBE_NORM_0), float(NOOK_LOBE_NORM_1), float(NOOK_LOBE_NORM_2),
                         float(NOOK_LOBE_NORM_3), float(NOOK_LOBE_NORM_4)};
  const F q = fma(fma(fma(fma(F(c[4]), v, F(c[3])), v, F(c[2])), v, F(c[1])), v, F(c[0]));
  return q / fma(v, q, F(1.0f));
}

// Returns the mean radiance of the lobes under the density with the vector b. Light that the ground hides is
// not included.
template <class F>
Colour<F> mean_radiance(const LightView& light, const Direction<F>& b) {
  const F length_b = sqrt(fma(b.x, b.x, fma(b.y, b.y, b.z * b.z)));
  Colour<F> sum{F(0.0f), F(0.0f), F(0.0f)};
  for (std::uint32_t i = 0; i < light.count; ++i) {
    const LightLobe& lobe = light.lobes[i];
    const F x = b.x + F(lobe.vector.x), y = b.y + F(lobe.vector.y), z = b.z + F(lobe.vector.z);
    const F m = sqrt(fma(x, x, fma(y, y, z * z)));
    const F weight =
        exponential(min(m - (length_b + F(lobe.sharpness)), F(0.0f))) * lobe_norm(m) * F(lobe.above);
    sum.r = fma(weight, F(lobe.amplitude.x), sum.r);
    sum.g = fma(weight, F(lobe.amplitude.y), sum.g);
    sum.b = fma(weight, F(lobe.amplitude.z), sum.b);
  }
  const F scale = F(1.0f) / lobe_norm(length_b);
  return {sum.r * scale, sum.g * scale, sum.b * scale};
}

// Returns 1 / the mean radiance of the hemisphere around n.
template <class F>
Colour<F> inverse_hemisphere(const LightView& light, const Direction<F>& n) {
  const F h(directional_cosine);
  const Colour<F> mean = mean_radiance(light, Direction<F>{n.x * h, n.y * h, n.z * h});
  const F one(1.0f);
  return {one / max(mean.r, F(light.darkest.x)), one / max(mean.g, F(light.darkest.y)),
          one / max(mean.b, F(light.darkest.z))};
}

// The direction from a key point to the part of a caster that is above the key point's horizon.
template <class F>
struct Sight {
  Direction<F> towards;  // unit
  F cosine;              // cosine of the angle to the normal
};

// Returns the Sight of a sphere from a key point. o is the sphere's centre relative to the key point, in
// units of its radius; xi = dot(o, n) is its height, and delta2 its squared distance. If the horizon cuts the
// sphere, the Sight points to the middle of the visible part.
template <class F>
Sight<F> sight_of(const Direction<F>& n, const Direction<F>& o, F xi, F delta2) {
  const F height = max(xi, fma(max(xi, F(-1.0f)), F(0.5f), F(0.5f)));
  const F lift = height - xi;
  const F inverse_distance = rsqrt(max(delta2 + height * height - xi * xi, F(1e-12f)));
  return {{fma(n.x, lift, o.x) * inverse_distance, fma(n.y, lift, o.y) * inverse_distance,
           fma(n.z, lift, o.z) * inverse_distance},
          height * inverse_distance};
}

// Returns k for a caster that covers the fraction f of the hemisphere. sqrt(height) / f is computed as height
// / sqrt(height f^2), because this needs only one estimated inverse root instead of a root and a division.
template <class F>
F concentration_of(const Sight<F>& sight, F f, float concentration) {
  const F height = max(sight.cosine, F(1e-12f)), f2 = f * f;
  return F(concentration) * max(F(1.0f) - f2, F(0.0f)) * (height * rsqrt(height * f2));
}

template <class F>
Colour<F> bounded_ratio(const Colour<F>& behind, const Colour<F>& inverse) {
  const auto ratio = [](F mean, F scale) { return min(max(mean * scale, F(0.0f)), F(largest_ratio)); };
  return {ratio(behind.r, inverse.r), ratio(behind.g, inverse.g), ratio(behind.b, inverse.b)};
}

// Returns rho of a caster that covers `share` of the hemisphere. The sharpness of the caster's lobe is
// limited to `sharpest`.
template <class F>
Colour<F> light_ratio(const LightView& light, const Colour<F>& inverse, const Direction<F>& n,
                      const Sight<F>& sight, F share, F sharpest) {
  const F f = max(share, F(smallest_share));
  const F k = min(concentration_of(sight, f, caster_concentration), sharpest), h(directional_cosine);
  const Direction<F>& d = sight.towards;
  return bounded_ratio(
      mean_radiance(light, Direction<F>{fma(d.x, k, n.x * h), fma(d.y, k, n.y * h), fma(d.z, k, n.z * h)}),
      inverse);
}

// Pass this as `sharpest` for a single sphere: it does not limit the sharpness.
inline constexpr float no_sharpest = float(NOOK_NO_SHARPEST);

// Combines the spheres of one caster. Holds the mean of their Sight directions, weighted by the fraction f
// that each sphere covers, and the sum of these fractions.
template <class F>
struct JointSight {
  Direction<F> sum{F(0.0f), F(0.0f), F(0.0f)};
  F taken = F(0.0f);

  void add(const Sight<F>& sight, F takes) {
    sum = {fma(sight.towards.x, takes, sum.x), fma(sight.towards.y, takes, sum.y),
           fma(sight.towards.z, takes, sum.z)};
    taken = taken + takes;
  }
  Sight<F> mean(const Direction<F>& n) const {
    const F scale = rsqrt(max(squared_length(), F(1e-30f)));
    const Direction<F> d{sum.x * scale, sum.y * scale, sum.z * scale};
    return {d, fma(d.x, n.x, fma(d.y, n.y, d.z * n.z))};
  }
  // Returns the sharpness of a lobe that is as wide as the spread of the directions: 1 / (1 - length of their
  // mean).
  F sharpest() const {
    const F length = sqrt(squared_length()) / max(taken, F(1e-15f));
    return F(1.0f) / max(F(1.0f) - length, F(1e-4f));
  }

 private:
  F squared_length() const { return fma(sum.x, sum.x, fma(sum.y, sum.y, sum.z * sum.z)); }
};

// Returns the fraction of a lobe's light that comes from below the horizon. m is the sharpness of the lobe,
// and `height`, from -m to m, is the height of the lobe's vector above the horizon. The fraction is (1 -
// erf(x)) / 2 with x = height / sqrt(5.09 + 2 m^2 / (m + 4)). The formula is exact for small m, tends to the
// exact share for large m, and has an error of at most 0.016 in between. erf uses the formula 7.1.27 of
// Abramowitz and Stegun, with an error of at most 5e-4.
template <class F>
F share_below(F height, F m) {
  const F x = height * rsqrt(fma(m, F(2.0f) * m / (m + F(4.0f)), F(float(NOOK_BELOW_WIDTH))));
  const F a = max(x, F(0.0f) - x);
  constexpr float c[] = {1, float(NOOK_BELOW_1), float(NOOK_BELOW_2), float(NOOK_BELOW_3),
                         float(NOOK_BELOW_4)};
  const F p = fma(fma(fma(fma(F(c[4]), a, F(c[3])), a, F(c[2])), a, F(c[1])), a, F(c[0]));
  const F p2 = min(p * p, F(1e9f));
  const F tail = F(0.5f) / (p2 * p2);
  return select(less(x, F(0.0f)), F(1.0f) - tail, tail);
}

// Returns rho of the ground, which hides the half-space below its plane, under the density b = h n. This
// function uses the light as it would be without the ground, so it does not read LightLobe::above.
template <class F>
Colour<F> ground_ratio(const LightView& light, const Direction<F>& n, const Direction<F>& up) {
  const F h(directional_cosine), zero(0.0f);
  const Direction<F> b{n.x * h, n.y * h, n.z * h};
  Colour<F> all{zero, zero, zero}, below{zero, zero, zero};
  for (std::uint32_t i = 0; i < light.count; ++i) {
    const LightLobe& lobe = light.lobes[i];
    const F x = b.x + F(lobe.vector.x), y = b.y + F(lobe.vector.y), z = b.z + F(lobe.vector.z);
    const F m = sqrt(fma(x, x, fma(y, y, z * z)));
    const F weight = exponential(min(m - F(directional_cosine + lobe.sharpness), zero)) * lobe_norm(m);
    const F hidden = weight * share_below(fma(x, up.x, fma(y, up.y, z * up.z)), m);
    all = {fma(weight, F(lobe.amplitude.x), all.r), fma(weight, F(lobe.amplitude.y), all.g),
           fma(weight, F(lobe.amplitude.z), all.b)};
    below = {fma(hidden, F(lobe.amplitude.x), below.r), fma(hidden, F(lobe.amplitude.y), below.g),
             fma(hidden, F(lobe.amplitude.z), below.b)};
  }
  const F norm = lobe_norm(h);
  const F covered = share_below(fma(b.x, up.x, fma(b.y, up.y, b.z * up.z)), h);
  const auto inverse = [&](F mean, float darkest) {
    return F(1.0f) / (max(mean, norm * F(darkest)) * covered);
  };
  return bounded_ratio(below, {inverse(all.r, light.darkest.x), inverse(all.g, light.darkest.y),
                               inverse(all.b, light.darkest.z)});
}

// Self-shadow uses only bands 0 to 2 of the lobes (core/light_bands.h). The fitted spheres darken a key point
// from all sides, so their shadow has little directional detail. Each key point first sums the weighted
// densities of its spheres, and then combines the sum with the light once.
//
// All functions are templates over a number type F, as in kernel.h.

// This share of the self-shadow depends on the direction of the light. The remaining share darkens all
// colours equally. Both this share and k (see caster_concentration) were tuned against ray tracing in a
// crowd.
inline constexpr float self_strength = float(NOOK_SELF_STRENGTH);
inline constexpr float self_concentration = float(NOOK_SELF_CONCENTRATION);

// Returns the density for a sphere of the body itself. `term` is y^gamma, the fraction of the light that the
// sphere removes.
template <class F>
void gather(GatheredBands<F>& gathered, const Direction<F>& n, const Sight<F>& sight, F y, F term) {
  const F k = concentration_of(sight, max(y, F(smallest_share)), self_concentration), h(directional_cosine);
  const Direction<F>& d = sight.towards;
  gathered.add(Direction<F>{fma(d.x, k, n.x * h), fma(d.y, k, n.y * h), fma(d.z, k, n.z * h)}, term);
}

// Sums the terms of the spheres. Each term is multiplied by the relative radiance of the light that the
// sphere removes.
template <class F>
Colour<F> coloured_sum(const GatheredBands<F>& gathered, const LightBands& bands, const Direction<F>& n) {
  GatheredBands<F> open = GatheredBands<F>::none();
  const F h(directional_cosine), one(1.0f);
  open.add(Direction<F>{n.x * h, n.y * h, n.z * h}, one);
  const auto channel = [&](float Vec3::*c) {
    const F ratio = gathered.light(bands, c) / max(open.light(bands, c), F(bands.darkest.*c));
    const F bounded = min(max(ratio, F(0.0f)), F(largest_ratio) * gathered.scalar);
    return fma(F(self_strength), bounded, F(1 - self_strength) * gathered.scalar);
  };
  return {channel(&Vec3::x), channel(&Vec3::y), channel(&Vec3::z)};
}

// Returns how much light the self-shadow of a vertex removes, relative to the same shadow under uniform
// light. The arguments are the sums of the coloured and of the plain shadow over the vertex's key points.
// Without shadow, the result is 1.
template <class F>
F vertex_light_ratio(F coloured, F shadow) {
  return (coloured + F(smallest_share)) / (max(shadow, F(0.0f)) + F(smallest_share));
}

}  // namespace nook
