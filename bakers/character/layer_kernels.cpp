#include "bakers/character/layer_kernels.h"

#include <algorithm>
#include <cmath>

#include "bakers/character/mini_batch_fit.h"
#include "bakers/raytrace/clones.h"

namespace nook::bake {
namespace {

struct Value {
  float y, dy_ddelta2, dy_dxi;
};

// The kernel of slide 18. Its absolute distance has no derivative at the centre, so a small constant is added
// to keep the derivative finite.
struct PaperForm {
  static NOOK_INLINE Value value(float delta2, float xi) {
    const float delta = std::sqrt(delta2 + 1e-12f);
    const float e = delta - 1;
    const float q = 1 / (1 + 4 * std::fabs(e));
    const float omega = 0.75f - 3 * e * q;
    const float root = 1 / std::sqrt(1 + 4 * xi * xi);
    const float lambda = 0.5f + xi * root;
    return {omega * lambda, -1.5f * q * q / delta * lambda, omega * root * root * root};
  }
};

struct RationalForm {
  static NOOK_INLINE Value value(float delta2, float xi) {
    const float q = 1 / (1 + 2 * delta2);
    const float omega = 1.5f * q;
    const float root = 1 / std::sqrt(1 + 4 * xi * xi);
    const float lambda = 0.5f + xi * root;
    return {omega * lambda, -3 * q * q * lambda, omega * root * root * root};
  }
};

struct NookForm {
  static NOOK_INLINE Value value(float delta2, float xi) {
    const float t2 = 1 / (nook_kernel_core + delta2);
    const float t3 = t2 * std::sqrt(t2);
    const float inverse_root = 1 / std::sqrt(1 + xi * xi);
    const float s = 0.5f * (xi + (1 + xi * xi) * inverse_root);
    return {s * t3, -1.5f * s * t3 * t2, s * t3 * inverse_root};
  }
};

// Keeps powers and their derivatives finite where rounding gives 0 or less. Uses a plain comparison, because
// fmax also handles NaNs, which would prevent vectorisation.
NOOK_INLINE float at_least(float y) {
  return y > 1e-9f ? y : 1e-9f;
}

// y^gamma and its derivative with respect to y.
struct Power {
  float value, slope;
};
struct Gamma1 {
  NOOK_INLINE Power operator()(float y) const { return {y, 1}; }
};
struct Gamma15 {
  NOOK_INLINE Power operator()(float y) const {
    const float root = std::sqrt(y);
    return {y * root, 1.5f * root};
  }
};
struct Gamma2 {
  NOOK_INLINE Power operator()(float y) const { return {y * y, 2 * y}; }
};
struct GammaAny {
  float gamma;
  NOOK_INLINE Power operator()(float y) const {
    const float below = std::exp((gamma - 1) * std::log(y));
    return {below * y, gamma * below};
  }
};

template <class Form, class Gamma>
NOOK_INLINE void add_sphere_loop(Gamma gamma, const float centre[3], float inverse_radius,
                                 const KeyPointArrays& keys, float* __restrict sum) {
  const float ox = centre[0], oy = centre[1], oz = centre[2];
  const float *px = keys.px, *py = keys.py, *pz = keys.pz, *nx = keys.nx, *ny = keys.ny, *nz = keys.nz;
#pragma omp simd
  for (std::size_t k = 0; k < keys.count; ++k) {
    const float dx = (ox - px[k]) * inverse_radius, dy = (oy - py[k]) * inverse_radius,
                dz = (oz - pz[k]) * inverse_radius;
    const float delta2 = dx * dx + dy * dy + dz * dz;
    const float xi = dx * nx[k] + dy * ny[k] + dz * nz[k];
    const float y = at_least(Form::value(delta2, xi).y);
    sum[k] += gamma(y).value;
  }
}

template <class Form, class Gamma>
NOOK_INLINE SphereGradient sphere_gradient_loop(Gamma gamma, const float centre[3], float inverse_radius,
                                                const KeyPointArrays& keys, const float* gradient_sum,
                                                const KeyPointGradients& out) {
  const float ox = centre[0], oy = centre[1], oz = centre[2];
  const float *px = keys.px, *py = keys.py, *pz = keys.pz, *nx = keys.nx, *ny = keys.ny, *nz = keys.nz;
  float* __restrict gpx = out.px, * __restrict gpy = out.py, * __restrict gpz = out.pz;
  float* __restrict gnx = out.nx, * __restrict gny = out.ny, * __restrict gnz = out.nz;
  float gx = 0, gy = 0, gz = 0, gr = 0;
#pragma omp simd reduction(+ : gx, gy, gz, gr)
  for (std::size_t k = 0; k < keys.count; ++k) {
    const float dx = (ox - px[k]) * inverse_radius, dy = (oy - py[k]) * inverse_radius,
                dz = (oz - pz[k]) * inverse_radius;
    const float delta2 = dx * dx + dy * dy + dz * dz;
    const float xi = dx * nx[k] + dy * ny[k] + dz * nz[k];
    const Value v = Form::value(delta2, xi);
    const float g = gradient_sum[k] * gamma(at_least(v.y)).slope;
    const float g_delta2 = g * v.dy_ddelta2, g_xi = g * v.dy_dxi;
    const float ex = (2 * g_delta2 * dx + g_xi * nx[k]) * inverse_radius;
    const float ey = (2 * g_delta2 * dy + g_xi * ny[k]) * inverse_radius;
    const float ez = (2 * g_delta2 * dz + g_xi * nz[k]) * inverse_radius;
    gx += ex;
    gy += ey;
    gz += ez;
    gr -= 2 * g_delta2 * delta2 + g_xi * xi;
    gpx[k] -= ex;
    gpy[k] -= ey;
    gpz[k] -= ez;
    gnx[k] += g_xi * dx;
    gny[k] += g_xi * dy;
    gnz[k] += g_xi * dz;
  }
  return {gx, gy, gz, gr};
}

#define NOOK_PAIR_KERNEL(NAME, FORM, GAMMA_TYPE, GAMMA_VALUE)                                                \
  NOOK_INLINE void add_##NAME##_plain(float gamma, const float* centre, float inverse_radius,                \
                                      const KeyPointArrays& keys, float* sum) {                              \
    (void)gamma;                                                                                             \
    add_sphere_loop<FORM, GAMMA_TYPE>(GAMMA_VALUE, centre, inverse_radius, keys, sum);                       \
  }                                                                                                          \
  NOOK_CLONED(                                                                                               \
      void, add_##NAME,                                                                                      \
      (float gamma, const float* centre, float inverse_radius, const KeyPointArrays& keys, float* sum),      \
      (gamma, centre, inverse_radius, keys, sum))                                                            \
  NOOK_INLINE SphereGradient gradient_##NAME##_plain(float gamma, const float* centre, float inverse_radius, \
                                                     const KeyPointArrays& keys, const float* gradient_sum,  \
                                                     const KeyPointGradients& out) {                         \
    (void)gamma;                                                                                             \
    return sphere_gradient_loop<FORM, GAMMA_TYPE>(GAMMA_VALUE, centre, inverse_radius, keys, gradient_sum,   \
                                                  out);                                                      \
  }                                                                                                          \
  NOOK_CLONED(SphereGradient, gradient_##NAME,                                                               \
              (float gamma, const float* centre, float inverse_radius, const KeyPointArrays& keys,           \
               const float* gradient_sum, const KeyPointGradients& out),                                     \
              (gamma, centre, inverse_radius, keys, gradient_sum, out))

NOOK_PAIR_KERNEL(paper_1, PaperForm, Gamma1, Gamma1{})
NOOK_PAIR_KERNEL(paper_15, PaperForm, Gamma15, Gamma15{})
NOOK_PAIR_KERNEL(paper_2, PaperForm, Gamma2, Gamma2{})
NOOK_PAIR_KERNEL(paper_any, PaperForm, GammaAny, GammaAny{gamma})
NOOK_PAIR_KERNEL(nook_1, NookForm, Gamma1, Gamma1{})
NOOK_PAIR_KERNEL(nook_15, NookForm, Gamma15, Gamma15{})
NOOK_PAIR_KERNEL(nook_2, NookForm, Gamma2, Gamma2{})
NOOK_PAIR_KERNEL(nook_any, NookForm, GammaAny, GammaAny{gamma})
NOOK_PAIR_KERNEL(rational_1, RationalForm, Gamma1, Gamma1{})
NOOK_PAIR_KERNEL(rational_15, RationalForm, Gamma15, Gamma15{})
NOOK_PAIR_KERNEL(rational_2, RationalForm, Gamma2, Gamma2{})
NOOK_PAIR_KERNEL(rational_any, RationalForm, GammaAny, GammaAny{gamma})
#undef NOOK_PAIR_KERNEL

using AddFn = void (*)(float, const float*, float, const KeyPointArrays&, float*);
using GradientFn = SphereGradient (*)(float, const float*, float, const KeyPointArrays&, const float*,
                                      const KeyPointGradients&);
struct PairKernel {
  AddFn add;
  GradientFn gradient;
};

PairKernel select(const Kernel& kernel) {
  const int column = kernel.gamma == 1.0f ? 0 : kernel.gamma == 1.5f ? 1 : kernel.gamma == 2.0f ? 2 : 3;
  // The row depends on KernelForm, the column on gamma.
  static constexpr PairKernel table[kernel_form_count][4] = {
      {{add_paper_1, gradient_paper_1},
       {add_paper_15, gradient_paper_15},
       {add_paper_2, gradient_paper_2},
       {add_paper_any, gradient_paper_any}},
      {{add_nook_1, gradient_nook_1},
       {add_nook_15, gradient_nook_15},
       {add_nook_2, gradient_nook_2},
       {add_nook_any, gradient_nook_any}},
      {{add_rational_1, gradient_rational_1},
       {add_rational_15, gradient_rational_15},
       {add_rational_2, gradient_rational_2},
       {add_rational_any, gradient_rational_any}},
  };
  return table[int(kernel.form)][column];
}

}  // namespace

void add_sphere(const Kernel& kernel, const float centre[3], float inverse_radius, const KeyPointArrays& keys,
                float* sum) {
  select(kernel).add(kernel.gamma, centre, inverse_radius, keys, sum);
}

SphereGradient sphere_gradient(const Kernel& kernel, const float centre[3], float inverse_radius,
                               const KeyPointArrays& keys, const float* gradient_sum,
                               const KeyPointGradients& gradient) {
  return select(kernel).gradient(kernel.gamma, centre, inverse_radius, keys, gradient_sum, gradient);
}

static NOOK_INLINE void linear_layer_gradient_plain(const LinearLayerFit& linear,
                                                    std::span<const float> vertex_weight,
                                                    const std::uint16_t* const* target, const float* shadow,
                                                    std::size_t first, std::size_t last,
                                                    float* gradient_shadow, float* gradient_alpha,
                                                    float* gradient_bias) {
  constexpr std::size_t lanes = batch_poses;
  const std::size_t entries = linear.entries;
  for (std::size_t i = first; i < last; ++i) {
    float dark[lanes], slope[lanes];
    for (std::size_t l = 0; l < lanes; ++l) dark[l] = linear.bias[i];
    for (std::size_t s = i * entries; s < (i + 1) * entries; ++s) {
      const float a = linear.alpha[s];
      const float* row = shadow + std::size_t(linear.key_point[s]) * lanes;
#pragma omp simd
      for (std::size_t l = 0; l < lanes; ++l) dark[l] += a * row[l];
    }
    const float weight = vertex_weight[i] / float(lanes);
    for (std::size_t l = 0; l < lanes; ++l) slope[l] = 1 - float(target[l][i]) * AoTargets::scale;
    float bias = 0;
#pragma omp simd reduction(+ : bias)
    for (std::size_t l = 0; l < lanes; ++l) {
      slope[l] = weight * (std::clamp(dark[l], 0.0f, 1.0f) - slope[l]);
      bias += slope[l];
    }
    gradient_bias[i] = bias;
    for (std::size_t s = i * entries; s < (i + 1) * entries; ++s) {
      const float a = linear.alpha[s];
      const std::size_t offset = std::size_t(linear.key_point[s]) * lanes;
      const float* row = shadow + offset;
      float* out = gradient_shadow + offset;
      float sum = 0;
#pragma omp simd reduction(+ : sum)
      for (std::size_t l = 0; l < lanes; ++l) {
        sum += slope[l] * row[l];
        out[l] += a * slope[l];
      }
      gradient_alpha[s] = sum;
    }
  }
}

NOOK_CLONED(void, linear_layer_gradient,
            (const LinearLayerFit& linear, std::span<const float> vertex_weight,
             const std::uint16_t* const* target, const float* shadow, std::size_t first, std::size_t last,
             float* gradient_shadow, float* gradient_alpha, float* gradient_bias),
            (linear, vertex_weight, target, shadow, first, last, gradient_shadow, gradient_alpha,
             gradient_bias))

}  // namespace nook::bake
