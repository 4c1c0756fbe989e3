// One random body and one random light probe as the arrays that the kernels work on, and every step of their
// frame. The numbers are the same on every platform: the standard's generator, without its distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/probe/fit_kernels.h"

namespace nook::portability {

// Rows of floats, each aligned as the library aligns its own.
class Rows {
 public:
  Rows(std::size_t rows, std::size_t length) : lines_((length + 15) / 16), numbers_(rows * lines_) {}
  float* row(std::size_t r) { return numbers_[r * lines_].value; }
  const float* row(std::size_t r) const { return numbers_[r * lines_].value; }
  // Three rows from r on, as the kernels take colours.
  void colour(std::size_t r, float* (&rows)[3]) {
    for (std::size_t c = 0; c < 3; ++c) rows[c] = row(r + c);
  }

 private:
  struct alignas(64) Line {
    float value[16] = {};
  };
  std::size_t lines_;
  std::vector<Line> numbers_;
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : bits_(seed) {}
  float from(float low, float high) { return low + (high - low) * float(bits_() >> 8) * (1.0f / 16777216); }
  std::uint32_t below(std::uint32_t end) { return std::uint32_t(bits_() % end); }
  Vec3 direction() {
    for (;;) {
      const float x = from(-1, 1), y = from(-1, 1), z = from(-1, 1);
      const Vec3 v{x, y, z};
      if (dot(v, v) > 0.01f && dot(v, v) < 1) return normalised(v);
    }
  }

 private:
  std::mt19937 bits_;
};

// A body of about two metres, with neighbours, a ground, a light and a linear layer.
class Body {
 public:
  static constexpr std::uint32_t bones = 40, spheres = 130, key_points = 512, blocks = 375, columns = 12;
  static constexpr std::uint32_t vertices = blocks * linear_block_vertices;

  explicit Body(std::uint32_t seed);

  void pose(const ShadowKernels& kernels) {
    const KeyPointTarget surface = target(posed_points_, 6);
    kernels.pose_spheres(rest_spheres(), pose_.data(), offset, sphere_target());
    kernels.pose_key_points(rest_points(), pose_.data(), offset, target(posed_points_, 0), &surface);
  }
  void shadow(const ShadowKernels& kernels, const Kernel& kernel) {
    clear(sum_, key_points, 0);
    kernels.self_norm_sum(posed_spheres(), posed_points(0), kernel, sum_.row(0));
    kernels.norm_root(sum_.row(0), saturation_.row(0), key_points, kernel.gamma, shadow_.row(0));
  }
  // The body itself, moved aside, is its neighbour.
  void casters(const ShadowKernels& kernels) {
    clear(depth_, key_points, 0);
    clear(open_, key_points, 1);
    kernels.composed_depth(neighbour(), posed_points(6), depth_.row(0));
    kernels.exact_open(ground(), posed_points(6), open_.row(0));
    kernels.composed_occlusion(depth_.row(0), open_.row(0), key_points, occlusion_.row(0));
  }
  void blend(const ShadowKernels& kernels) {
    PointCodes shadow = codes(0), occlusion = codes(2);
    kernels.encode_points(shadow_.row(0), key_points, code_limit, shadow);
    kernels.encode_points(occlusion_.row(0), key_points, code_limit, occlusion);
    kernels.linear_layer(layer(), shadow, &occlusion, ao_.row(0));
  }
  void light(const ShadowKernels& kernels, const Kernel& kernel);

  const Rows& posed_spheres_rows() const { return posed_spheres_; }
  const Rows& posed_points_rows() const { return posed_points_; }
  const float* shadow() const { return shadow_.row(0); }
  const float* depth() const { return depth_.row(0); }
  const float* open() const { return open_.row(0); }
  const float* occlusion() const { return occlusion_.row(0); }
  const float* ao() const { return ao_.row(0); }
  const Rows& coloured() const { return coloured_; }  // norm, depth, open, ground: three rows each

 private:
  static constexpr Vec3 offset{0.5f, -0.25f, 1};
  static constexpr float alpha_step = 1e-5f, blend_step = 1.0f / 16384;
  // Twelve weights of up to 20,000 and 2,731 steps, times codes of this size, stay below 2^31.
  static constexpr float code_limit = 8192;

  static void clear(Rows& rows, std::uint32_t count, float value, std::size_t row = 0) {
    for (std::uint32_t i = 0; i < count; ++i) rows.row(row)[i] = value;
  }
  static KeyPointTarget target(Rows& rows, std::size_t r) {
    return {rows.row(r), rows.row(r + 1), rows.row(r + 2), rows.row(r + 3), rows.row(r + 4), rows.row(r + 5)};
  }
  SphereTarget sphere_target() {
    return {posed_spheres_.row(0), posed_spheres_.row(1), posed_spheres_.row(2), posed_spheres_.row(3)};
  }
  RestSphereView rest_spheres() const {
    return {rest_spheres_.row(0), rest_spheres_.row(1), rest_spheres_.row(2),
            rest_spheres_.row(3), sphere_bone_.data(),  spheres};
  }
  static KeyPointSoa points(const Rows& rows, std::size_t r) {
    return {rows.row(r),     rows.row(r + 1), rows.row(r + 2), rows.row(r + 3),
            rows.row(r + 4), rows.row(r + 5), key_points};
  }
  RestKeyPointView rest_points() const {
    return {points(rest_points_, 0), points(rest_points_, 6), point_bone_.data(),
            point_weight_.data(),    saturation_.row(0),      key_points};
  }
  KeyPointSoa posed_points(std::size_t r) const { return points(posed_points_, r); }
  SphereSoa posed_spheres() const {
    return {posed_spheres_.row(0), posed_spheres_.row(1), posed_spheres_.row(2),
            posed_spheres_.row(3), rest_spheres_.row(4),  spheres};
  }
  SphereSoa neighbour() const {
    SphereSoa view = posed_spheres();
    view.x = neighbour_x_.row(0);
    return view;
  }
  SphereSoa ground() const {
    return {ground_.row(0), ground_.row(1), ground_.row(2), ground_.row(3), nullptr, 1};
  }
  LinearView layer() const {
    return {blocks_.data(), blocks,     layer_point_.data(), alpha_.data(), blend_.data(),
            alpha_step,     blend_step, open_bias_.row(0),   code_limit,    code_limit};
  }
  PointCodes codes(std::size_t part) {
    return {codes_.data() + part * key_points, codes_.data() + (part + 1) * key_points, 0};
  }

  std::vector<Mat3x4> pose_;
  Rows rest_spheres_{5, spheres}, rest_points_{12, key_points}, saturation_{1, key_points};
  std::vector<std::uint16_t> sphere_bone_, point_bone_;
  std::vector<std::uint32_t> layer_point_;  // two for each
  std::vector<float> point_weight_;
  Rows posed_spheres_{4, spheres}, posed_points_{12, key_points}, neighbour_x_{1, spheres}, ground_{4, 1};
  Rows sum_{1, key_points}, shadow_{1, key_points}, depth_{1, key_points}, open_{1, key_points},
      occlusion_{1, key_points};
  std::vector<LinearBlock> blocks_;
  std::vector<std::int16_t> alpha_, blend_;
  std::vector<std::int32_t> codes_;
  Rows open_bias_{1, vertices}, ao_{1, vertices};
  std::vector<LightLobe> lobes_;
  LightBands bands_;
  Rows inverse_{3, key_points}, coloured_{12, key_points};
};

inline Body::Body(std::uint32_t seed)
    : pose_(bones),
      sphere_bone_(spheres),
      point_bone_(4 * key_points),
      layer_point_(blocks * columns / 2),
      point_weight_(4 * key_points),
      blocks_(blocks),
      alpha_(vertices * columns),
      blend_(vertices * columns),
      codes_(std::size_t{4} * key_points) {
  Random random(seed);
  for (Mat3x4& bone : pose_) {
    const Vec3 x = random.direction(), z = normalised(cross(x, random.direction())), y = cross(z, x);
    const float scale = random.from(0.9f, 1.1f);
    bone = {{x.x * scale, y.x * scale, z.x * scale, random.from(-0.3f, 0.3f), x.y * scale, y.y * scale,
             z.y * scale, random.from(-0.3f, 0.3f), x.z * scale, y.z * scale, z.z * scale,
             random.from(-0.3f, 0.3f)}};
  }
  for (std::uint32_t i = 0; i < spheres; ++i) {
    for (int a = 0; a < 3; ++a) rest_spheres_.row(a)[i] = random.from(-1, 1);
    rest_spheres_.row(3)[i] = random.from(0.01f, 0.2f);
    rest_spheres_.row(4)[i] = random.from(0, 1.5f);  // as a caster
    sphere_bone_[i] = std::uint16_t(random.below(bones));
    neighbour_x_.row(0)[i] = random.from(0.8f, 2.2f);
  }
  for (std::uint32_t k = 0; k < key_points; ++k) {
    for (int r = 0; r < 12; r += 6) {
      for (int a = 0; a < 3; ++a) rest_points_.row(r + a)[k] = random.from(-1, 1);
      const Vec3 normal = random.direction();
      rest_points_.row(r + 3)[k] = normal.x;
      rest_points_.row(r + 4)[k] = normal.y;
      rest_points_.row(r + 5)[k] = normal.z;
    }
    // Bones side by side, so that normals do not blend away: a weight of 0.7 on the first.
    for (int b = 0; b < 4; ++b) point_bone_[4 * k + b] = std::uint16_t(random.below(bones));
    for (int b = 0; b < 4; ++b) point_weight_[4 * k + b] = b ? 0.1f : 0.7f;
    saturation_.row(0)[k] = float(k % 5);
  }
  constexpr float ground_radius = 10'000;
  ground_.row(1)[0] = -2 - ground_radius;
  ground_.row(3)[0] = inverse_sphere_radius(ground_radius);
  for (std::uint32_t b = 0; b < blocks; ++b) {
    blocks_[b] = {b * columns / 2, columns / 2};
    for (std::uint32_t c = 0; c < columns; ++c) {
      layer_point_[(b * columns + c) / 2] |= random.below(key_points) << 16 * (c % 2);
      for (std::uint32_t v = 0; v < linear_block_vertices; ++v) {
        const std::size_t at = (b * columns + c) * linear_block_vertices + v;
        alpha_[at] = std::int16_t(random.from(-0.1f, 0.2f) / alpha_step);
        blend_[at] = std::int16_t(random.from(0, 2.0f / columns) / blend_step);
      }
    }
    for (std::uint32_t v = 0; v < linear_block_vertices; ++v)
      open_bias_.row(0)[b * linear_block_vertices + v] = random.from(0.6f, 1.2f);
  }
  for (int i = 0; i < 12; ++i) {
    const float sharpness = random.from(2, 8);
    const auto bright = [&] { return random.from(0.05f, 1.5f); };
    const Vec3 amplitude{bright(), bright(), bright()};
    lobes_.push_back({random.direction() * sharpness, sharpness, amplitude, random.from(0.5f, 1)});
  }
  bands_.scalar = {0.8f, 0.7f, 0.6f};
  for (Vec3& v : bands_.vector)
    v = {random.from(-0.5f, 0.5f), random.from(-0.5f, 0.5f), random.from(-0.5f, 0.5f)};
  for (Vec3& v : bands_.tensor)
    v = {random.from(-0.2f, 0.2f), random.from(-0.2f, 0.2f), random.from(-0.2f, 0.2f)};
  bands_.darkest = {0.05f, 0.05f, 0.05f};
}

inline void Body::light(const ShadowKernels& kernels, const Kernel& kernel) {
  const LightView view{lobes_.data(), std::uint32_t(lobes_.size()), bands_.darkest};
  float *inverse[3], *rgb[3];
  inverse_.colour(0, inverse);
  kernels.directional_hemisphere(posed_points(6), view, inverse);
  const auto start = [&](std::size_t row, float value) {
    for (std::size_t c = 0; c < 3; ++c) clear(coloured_, key_points, value, row + c);
    coloured_.colour(row, rgb);
  };
  start(0, 0);
  kernels.directional_norm_sum(posed_spheres(), posed_points(0), kernel, bands_, rgb);
  start(3, 0);
  kernels.directional_depth(neighbour(), posed_points(6), view, inverse, rgb);
  SphereSoa few = neighbour();
  few.count = 5;
  start(6, 1);
  kernels.directional_open(few, posed_points(6), view, inverse, rgb);
  start(9, 1);
  kernels.directional_ground(ground(), posed_points(6), view, {0, 1, 0}, rgb);
}

// Lobes and a chunk of samples of a fit, twelve lobes in rows of sixteen.
class ProbeFit {
 public:
  static constexpr std::uint32_t lobes = 12, padded = 16, samples = probe::sample_chunk;

  explicit ProbeFit(std::uint32_t seed) {
    Random random(seed);
    for (std::uint32_t i = 0; i < padded; ++i) {
      const Vec3 axis = i < lobes ? random.direction() : Vec3{};
      axes_.row(0)[i] = axis.x;
      axes_.row(1)[i] = axis.y;
      axes_.row(2)[i] = axis.z;
      axes_.row(3)[i] = i < lobes ? 6 : 1e4f;
    }
    for (std::uint32_t k = 0; k < samples; ++k) {
      const Vec3 d = random.direction();
      samples_->x[k] = d.x;
      samples_->y[k] = d.y;
      samples_->z[k] = d.z;
      samples_->red[k] = random.from(0, 2);
      samples_->green[k] = random.from(0, 2);
      samples_->blue[k] = random.from(0, 2);
      samples_->weight[k] = 1;
      samples_->growth[k] = 1;
      // As the owner of a fit does: the sum of weights counts at least 256 at first.
      total_.row(0)[k] = 256.0f + float(k);
    }
    for (std::uint32_t i = 0; i < padded; ++i) {
      weights_.row(0)[i] = i < lobes ? 1.0f / 12 : 1;  // the mean square of such a lobe over the sphere
      weights_.row(1)[i] = i < lobes ? 6 : 0;          // 1 / its mean
    }
  }

  enum class Step { plain, original };

  void values(const probe::FitKernels& kernels) {
    kernels.gaussian_values(view(), *samples_, samples, values_.row(0));
  }
  void fit(const probe::FitKernels& kernels, Step step) {
    for (std::uint32_t r = 0; r < 7; ++r)
      for (std::uint32_t i = 0; i < padded; ++i) running_.row(r)[i] = 0;
    probe::RunningView running;
    running.count = lobes;
    running.padded = padded;
    for (std::uint32_t c = 0; c < 3; ++c) {
      running.value[c] = running_.row(c);
      running.change[c] = running_.row(3 + c);
    }
    running.square = running_.row(6);
    running.true_square = weights_.row(0);
    running.inverse_mean = weights_.row(1);
    if (step == Step::plain)
      kernels.step_plain(running, *samples_, total_.row(0), samples, values_.row(0), true, true);
    else
      kernels.step_original(running, *samples_, total_.row(0), samples, values_.row(0));
  }
  // The means over the samples of lobes times colour and of products of lobes.
  void sums(const probe::FitKernels& kernels) {
    kernels.light_rows(*samples_, samples, scale_.row(0), light_.row(0));
    kernels.gaussian_rows(view(), lobes, *samples_, scale_.row(0), samples, rows_.row(0));
    moments_.assign(3 * padded, 0);
    gram_.assign(padded * padded, 0);
    kernels.sum_products(rows_.row(0), lobes, light_.row(0), 3, samples, false, moments_.data(), padded);
    kernels.sum_products(rows_.row(0), lobes, rows_.row(0), lobes, samples, true, gram_.data(), padded);
    for (double& m : moments_) m /= samples;
    for (double& g : gram_) g /= samples;
  }

  const float* values() const { return values_.row(0); }
  const float* coefficients(std::uint32_t channel) const { return running_.row(channel); }
  const std::vector<double>& moments() const { return moments_; }
  const std::vector<double>& gram() const { return gram_; }  // the lower triangle

 private:
  probe::LobeSoa view() const { return {axes_.row(0), axes_.row(1), axes_.row(2), axes_.row(3), padded}; }

  std::unique_ptr<probe::SampleColumns> samples_ = std::make_unique<probe::SampleColumns>();
  Rows axes_{4, padded}, values_{1, std::size_t(padded) * samples}, running_{7, padded}, weights_{2, padded},
      total_{1, samples}, scale_{1, samples}, light_{1, 3 * std::size_t(samples)},
      rows_{1, std::size_t(padded) * samples};
  std::vector<double> moments_, gram_;
};

}  // namespace nook::portability
