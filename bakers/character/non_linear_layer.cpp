#include "bakers/character/non_linear_layer.h"

#include <cmath>

#include "bakers/character/layer_kernels.h"

namespace nook::bake {
namespace {

// Position of the key points that pad the SIMD vectors. They are so far away that they receive no shadow, but
// the square of the coordinate is still finite.
constexpr float far_away = 1e6f;

struct BlendedKeyPoint {
  float weight[KeyPoint::max_bones];
  float root_sum;                      // sum of squared roots
  Vec3 position[KeyPoint::max_bones];  // one per bone
  Vec3 normal[KeyPoint::max_bones];
  Vec3 blended_normal;  // before normalisation
};

BlendedKeyPoint blend(std::span<const Mat3x4> bones,
                      const std::array<std::uint16_t, KeyPoint::max_bones>& bone, const float* q) {
  BlendedKeyPoint b;
  b.root_sum = 0;
  for (int j = 0; j < KeyPoint::max_bones; ++j) b.root_sum += q[6 + j] * q[6 + j];
  b.blended_normal = {};
  for (int j = 0; j < KeyPoint::max_bones; ++j) {
    b.weight[j] = q[6 + j] * q[6 + j] / b.root_sum;
    if (b.weight[j] == 0) {
      b.position[j] = b.normal[j] = {};
      continue;
    }
    b.position[j] = transform_point(bones[bone[j]], {q[0], q[1], q[2]});
    b.normal[j] = transform_vector(bones[bone[j]], {q[3], q[4], q[5]});
    b.blended_normal += b.weight[j] * b.normal[j];
  }
  return b;
}

Vec3 transposed_vector(const Mat3x4& a, Vec3 v) {
  const float* m = a.m;
  return {m[0] * v.x + m[4] * v.y + m[8] * v.z, m[1] * v.x + m[5] * v.y + m[9] * v.z,
          m[2] * v.x + m[6] * v.y + m[10] * v.z};
}

float uniform_scale(const Mat3x4& a) {
  return length({a.m[0], a.m[4], a.m[8]});
}

// The derivatives of a key point's shadow with respect to the sum over all spheres, and with respect to the
// square root of the saturation.
struct ShadowSlope {
  float by_sum, by_root;
};

ShadowSlope shadow_slope(float sum, float power, float saturation_root) {
  const float norm = std::pow(sum, power), open = 1 / (1 + saturation_root * saturation_root * norm);
  return {open * open * power * std::pow(sum, power - 1), -2 * saturation_root * norm * norm * open * open};
}

}  // namespace

LayerWorkspace::LayerWorkspace(const LayerStructure& structure)
    : sphere_(5 * structure.sphere_count()),
      key_(6 * structure.padded_count(), 0.0f),
      sum_(structure.padded_count()),
      gradient_key_(6 * structure.padded_count()),
      gradient_sum_(structure.padded_count()) {}

void NonLinearLayer::forward(std::span<const Mat3x4> bones, std::span<const float> parameters,
                             LayerWorkspace& workspace, float* shadow, std::size_t stride) const {
  const std::size_t spheres = structure_.sphere_count(), keys = structure_.key_point_count();
  const std::size_t padded = structure_.padded_count();
  for (std::size_t h = 0; h < spheres; ++h) {
    const float* q = &parameters[structure_.sphere_offset(h)];
    const Mat3x4& bone = bones[structure_.sphere_bone[h]];
    const Vec3 centre = transform_point(bone, {q[0], q[1], q[2]});
    const float radius = std::exp(q[3]) * uniform_scale(bone);
    float* s = &workspace.sphere_[5 * h];
    s[0] = centre.x;
    s[1] = centre.y;
    s[2] = centre.z;
    s[3] = radius;
    s[4] = 1 / radius;
  }
  float* key = workspace.key_.data();
  for (std::size_t k = 0; k < padded; ++k) {
    Vec3 position{far_away, far_away, far_away}, normal{};
    if (k < keys) {
      const BlendedKeyPoint b =
          blend(bones, structure_.key_point_bone[k], &parameters[structure_.key_point_offset(k)]);
      position = {};
      for (int j = 0; j < KeyPoint::max_bones; ++j) position += b.weight[j] * b.position[j];
      normal = normalised(b.blended_normal);
    }
    key[k] = position.x;
    key[padded + k] = position.y;
    key[2 * padded + k] = position.z;
    key[3 * padded + k] = normal.x;
    key[4 * padded + k] = normal.y;
    key[5 * padded + k] = normal.z;
  }
  const KeyPointArrays arrays{
      key, key + padded, key + 2 * padded, key + 3 * padded, key + 4 * padded, key + 5 * padded, padded};
  float* sum = workspace.sum_.data();
  for (std::size_t k = 0; k < padded; ++k) sum[k] = 1e-20f;
  for (std::size_t h = 0; h < spheres; ++h)
    add_sphere(structure_.kernel, &workspace.sphere_[5 * h], workspace.sphere_[5 * h + 4], arrays, sum);
  const float power = 1 / structure_.kernel.gamma;
  for (std::size_t k = 0; k < keys; ++k) {
    const float root = parameters[structure_.saturation_offset(k)];
    shadow[k * stride] = saturated(std::pow(sum[k], power), root * root);
  }
  for (std::size_t k = keys; k < padded; ++k) shadow[k * stride] = 0;
}

void NonLinearLayer::backward_response(std::span<const float> parameters, LayerWorkspace& workspace,
                                       const float* gradient_shadow, std::size_t stride,
                                       std::span<float> gradient) const {
  const float power = 1 / structure_.kernel.gamma;
  std::fill(workspace.gradient_sum_.begin(), workspace.gradient_sum_.end(), 0.0f);
  for (std::size_t k = 0; k < structure_.key_point_count(); ++k) {
    const std::size_t root = structure_.saturation_offset(k);
    const ShadowSlope slope = shadow_slope(workspace.sum_[k], power, parameters[root]);
    workspace.gradient_sum_[k] = gradient_shadow[k * stride] * slope.by_sum;
    gradient[root] += gradient_shadow[k * stride] * slope.by_root;
  }
}

void NonLinearLayer::backward(std::span<const Mat3x4> bones, std::span<const float> parameters,
                              LayerWorkspace& workspace, const float* gradient_shadow, std::size_t stride,
                              std::span<float> gradient) const {
  const std::size_t spheres = structure_.sphere_count(), keys = structure_.key_point_count();
  const std::size_t padded = structure_.padded_count();
  float* key = workspace.key_.data();
  float* gradient_key = workspace.gradient_key_.data();
  backward_response(parameters, workspace, gradient_shadow, stride, gradient);
  std::fill(workspace.gradient_key_.begin(), workspace.gradient_key_.end(), 0.0f);
  const KeyPointArrays arrays{
      key, key + padded, key + 2 * padded, key + 3 * padded, key + 4 * padded, key + 5 * padded, padded};
  const KeyPointGradients gradients{gradient_key,
                                    gradient_key + padded,
                                    gradient_key + 2 * padded,
                                    gradient_key + 3 * padded,
                                    gradient_key + 4 * padded,
                                    gradient_key + 5 * padded};
  for (std::size_t h = 0; h < spheres; ++h) {
    const SphereGradient g =
        sphere_gradient(structure_.kernel, &workspace.sphere_[5 * h], workspace.sphere_[5 * h + 4], arrays,
                        workspace.gradient_sum_.data(), gradients);
    const Vec3 rest = transposed_vector(bones[structure_.sphere_bone[h]], {g.x, g.y, g.z});
    float* out = &gradient[structure_.sphere_offset(h)];
    out[0] += rest.x;
    out[1] += rest.y;
    out[2] += rest.z;
    out[3] += g.log_radius;
  }
  for (std::size_t k = 0; k < keys; ++k) {
    const auto& bone = structure_.key_point_bone[k];
    const float* q = &parameters[structure_.key_point_offset(k)];
    float* out = &gradient[structure_.key_point_offset(k)];
    const BlendedKeyPoint b = blend(bones, bone, q);
    const Vec3 g_position{gradient_key[k], gradient_key[padded + k], gradient_key[2 * padded + k]};
    const Vec3 g_unit{gradient_key[3 * padded + k], gradient_key[4 * padded + k],
                      gradient_key[5 * padded + k]};
    const float norm = length(b.blended_normal);
    const Vec3 unit = normalised(b.blended_normal);
    const Vec3 g_normal = norm > 0 ? (g_unit - dot(g_unit, unit) * unit) * (1 / norm) : Vec3{};
    Vec3 g_rest_position{}, g_rest_normal{};
    float g_weight[KeyPoint::max_bones];
    float mean = 0;
    for (int j = 0; j < KeyPoint::max_bones; ++j) {
      g_weight[j] = 0;
      if (b.weight[j] == 0) continue;
      g_rest_position += b.weight[j] * transposed_vector(bones[bone[j]], g_position);
      g_rest_normal += b.weight[j] * transposed_vector(bones[bone[j]], g_normal);
      g_weight[j] = dot(g_position, b.position[j]) + dot(g_normal, b.normal[j]);
      mean += b.weight[j] * g_weight[j];
    }
    out[0] += g_rest_position.x;
    out[1] += g_rest_position.y;
    out[2] += g_rest_position.z;
    out[3] += g_rest_normal.x;
    out[4] += g_rest_normal.y;
    out[5] += g_rest_normal.z;
    for (int j = 0; j < KeyPoint::max_bones; ++j)
      out[6 + j] += 2 * q[6 + j] / b.root_sum * (g_weight[j] - mean);
  }
}

}  // namespace nook::bake
