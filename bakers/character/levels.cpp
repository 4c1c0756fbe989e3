#include "bakers/character/levels.h"

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/instruction_set.h"
#include "sdk/src/character/shadow_kernels_rest.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

struct Shadows {
  std::size_t poses = 0, points = 0;
  std::vector<float> value;  // one pose after another

  float at(std::size_t pose, std::size_t point) const { return value[pose * points + point]; }
};

// Returns the shadows that the given spheres cast on all key points of the model.
Shadows evaluate(const CharacterModel& model, const Vector<ProxySphere>& spheres,
                 std::span<const std::vector<Mat3x4>> poses) {
  CharacterModel part;
  part.bone_names = model.bone_names;
  part.spheres = spheres;
  part.key_points = model.key_points;
  const RestSpheres rest_spheres(part);
  const RestKeyPoints rest_points(part);
  const std::uint32_t padded = rest_points.padded_count(), count = rest_spheres.view().count;
  const ShadowKernels& kernels = *shadow_kernels(kernel_isa());
  std::vector<float> s(4 * count), p(6 * padded), sum(padded);
  const SphereTarget sphere_target{&s[0], &s[count], &s[2 * count], &s[3 * count]};
  const KeyPointTarget point_target{&p[0],          &p[padded],     &p[2 * padded],
                                    &p[3 * padded], &p[4 * padded], &p[5 * padded]};
  Shadows shadows{poses.size(), model.key_points.size(), {}};
  for (const std::vector<Mat3x4>& pose : poses) {
    kernels.pose_spheres(rest_spheres.view(), pose.data(), {}, sphere_target);
    kernels.pose_key_points(rest_points.view(), pose.data(), {}, point_target, nullptr);
    std::fill(sum.begin(), sum.end(), 0.0f);
    kernels.self_norm_sum(
        {&s[0], &s[count], &s[2 * count], &s[3 * count], rest_spheres.caster_weight(), count},
        {&p[0], &p[padded], &p[2 * padded], &p[3 * padded], &p[4 * padded], &p[5 * padded], padded},
        model.kernel, sum.data());
    kernels.norm_root(sum.data(), rest_points.view().saturation, padded, model.kernel.gamma, sum.data());
    shadows.value.insert(shadows.value.end(), sum.begin(),
                         sum.begin() + static_cast<std::ptrdiff_t>(shadows.points));
  }
  return shadows;
}

// Merges two spheres of one bone. The result has the sum of their volumes, their centroid, and the same
// darkening at a distance, which is proportional to weight * radius^2.
ProxySphere merge(const ProxySphere& a, const ProxySphere& b) {
  const float va = a.radius * a.radius * a.radius, vb = b.radius * b.radius * b.radius;
  ProxySphere both;
  both.bone = a.bone;
  both.centre = (a.centre * va + b.centre * vb) * (1 / (va + vb));
  both.radius = std::cbrt(va + vb);
  both.caster_weight = (a.caster_weight * a.radius * a.radius + b.caster_weight * b.radius * b.radius) /
                       (both.radius * both.radius);
  return both;
}

// Repeatedly merges the pair with the smallest cost, until `target` spheres remain. Near pairs cost less than
// distant pairs, and small spheres less than large ones. Spheres of different bones are never merged.
Vector<ProxySphere> merge_spheres(const CharacterModel& model, std::size_t target) {
  Vector<ProxySphere> spheres(model.spheres.begin(), model.spheres.end());
  while (spheres.size() > target) {
    float least = INFINITY;
    std::size_t first = 0, second = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i)
      for (std::size_t j = i + 1; j < spheres.size(); ++j) {
        if (spheres[i].bone != spheres[j].bone) continue;
        const Vec3 d = spheres[i].centre - spheres[j].centre;
        const float cost = dot(d, d) * std::min(spheres[i].radius, spheres[j].radius);
        if (cost < least) {
          least = cost;
          first = i;
          second = j;
        }
      }
    if (least == INFINITY) break;  // one sphere remains for each bone
    spheres[first] = merge(spheres[first], spheres[second]);
    spheres.erase(spheres.begin() + static_cast<std::ptrdiff_t>(second));
  }
  return spheres;
}

struct Line {
  float scale = 0, offset = 0, residual = 0;  // `residual` is a mean square
};

// Fits lines between the shadows of key points. Stores means and centred values over the even poses, so that
// the fit of one pair of key points is fast.
class Regression {
 public:
  Regression(const Shadows& fine, const Shadows& coarse) : points_(fine.points) {
    for (std::size_t pose = 0; pose < fine.poses; pose += 2) ++samples_;
    fine_ = centred(fine, fine_mean_);
    coarse_ = centred(coarse, coarse_mean_);
  }

  // Fits: shadow of fine point k = scale * shadow of coarse point r + offset. The scale is >= 0, because one
  // shadow should not fall when the other rises.
  Line fit(std::size_t k, std::size_t r) const {
    double kk = 0, kr = 0, rr = 0;
    const float *a = &fine_[k * samples_], *b = &coarse_[r * samples_];
    for (std::size_t i = 0; i < samples_; ++i) {
      kk += a[i] * a[i];
      kr += a[i] * b[i];
      rr += b[i] * b[i];
    }
    Line line;
    // A slope above 4 would amplify the error of the coarse point.
    line.scale = static_cast<float>(rr > 0 ? std::clamp(kr / rr, 0.0, 4.0) : 0.0);
    line.offset = fine_mean_[k] - line.scale * coarse_mean_[r];
    const double square = kk - 2 * line.scale * kr + line.scale * line.scale * rr;
    line.residual = static_cast<float>(std::max(square, 0.0) / static_cast<double>(samples_));
    return line;
  }

 private:
  // Each row is a key point, so that a fit reads only two rows.
  std::vector<float> centred(const Shadows& shadows, std::vector<float>& mean) const {
    mean.assign(points_, 0.0f);
    std::vector<float> rows(points_ * samples_);
    for (std::size_t k = 0; k < points_; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < samples_; ++i) sum += shadows.at(2 * i, k);
      mean[k] = static_cast<float>(sum / static_cast<double>(samples_));
      for (std::size_t i = 0; i < samples_; ++i) rows[k * samples_ + i] = shadows.at(2 * i, k) - mean[k];
    }
    return rows;
  }

  std::size_t points_, samples_ = 0;
  std::vector<float> fine_, coarse_, fine_mean_, coarse_mean_;
};

// For all pairs, returns the cost if key point k takes its shadow from key point r. The cost is the error at
// the vertices plus a penalty for the distance between both points and the angle between their normals. The
// poses contain no other casters, but k also takes the occlusion by other casters from r, so it must be near
// r. A distance of 0.1 m counts as 0.01 of shadow, and an angle of 60 degrees as 0.05.
std::vector<float> following_cost(const CharacterModel& model, const Regression& regression) {
  const std::size_t points = model.key_points.size();
  std::vector<float> weight(points, 0.0f);
  for (std::size_t e = 0; e < model.alpha.size(); ++e)
    weight[model.influence[e]] += model.alpha[e] * model.alpha[e];
  std::vector<float> cost(points * points);
  for (std::size_t k = 0; k < points; ++k)
    for (std::size_t r = 0; r < points; ++r) {
      const KeyPoint &a = model.key_points[k], &b = model.key_points[r];
      const Vec3 d = a.surface_position - b.surface_position;
      const float turn = 1 - dot(a.surface_normal, b.surface_normal);
      cost[k * points + r] =
          weight[k] * (regression.fit(k, r).residual + 0.01f * dot(d, d) + 0.01f * turn * turn);
    }
  return cost;
}

// Chooses key points greedily. Each step adds the key point that lowers the sum of costs most.
std::vector<std::uint16_t> choose_evaluated(std::span<const float> cost, std::size_t points,
                                            std::size_t target) {
  std::vector<float> best(points, 1e30f);
  std::vector<bool> chosen(points, false);
  while (target-- > 0) {
    double most = -1;
    std::size_t next = 0;
    for (std::size_t r = 0; r < points; ++r) {
      if (chosen[r]) continue;
      double gain = 0;
      for (std::size_t k = 0; k < points; ++k) gain += std::max(best[k] - cost[k * points + r], 0.0f);
      if (gain > most) {
        most = gain;
        next = r;
      }
    }
    chosen[next] = true;
    for (std::size_t k = 0; k < points; ++k) best[k] = std::min(best[k], cost[k * points + next]);
  }
  std::vector<std::uint16_t> evaluated;
  for (std::size_t r = 0; r < points; ++r)
    if (chosen[r]) evaluated.push_back(static_cast<std::uint16_t>(r));
  return evaluated;
}

float vertex_ao(const CharacterModel& model, std::size_t vertex, std::span<const float> shadow) {
  float sum = model.bias[vertex];
  for (std::size_t e = vertex * model.influences; e < (vertex + 1) * model.influences; ++e)
    sum += model.alpha[e] * shadow[model.influence[e]];
  return std::clamp(1 - sum, 0.0f, 1.0f);
}

// Returns the rms error of a level over the odd poses.
float measure_error(const CharacterModel& model, const CharacterLevel& level, const Shadows& fine,
                    const Shadows& coarse) {
  double sum = 0;
  std::size_t count = 0;
  std::vector<float> exact(fine.points), spread(fine.points);
  for (std::size_t pose = 1; pose < fine.poses; pose += 2) {
    for (std::size_t k = 0; k < fine.points; ++k) {
      exact[k] = fine.at(pose, k);
      spread[k] = std::max(
          level.scale[k] * coarse.at(pose, level.evaluated[level.source[k]]) + level.offset[k], 0.0f);
    }
    for (std::size_t v = 0; v < model.vertex_count(); ++v) {
      const double error = vertex_ao(model, v, exact) - vertex_ao(model, v, spread);
      sum += error * error;
    }
    count += model.vertex_count();
  }
  return static_cast<float>(std::sqrt(sum / static_cast<double>(count)));
}

std::size_t share_of(float share, std::size_t count) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(share * static_cast<float>(count)), 1, count);
}

}  // namespace

std::vector<CharacterLevel> make_levels(const CharacterModel& model,
                                        std::span<const std::vector<Mat3x4>> poses,
                                        std::span<const LevelShare> shares) {
  if (poses.size() < 4)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "too few poses for levels of detail (got %zu, need at least 4)", poses.size());
  for (const std::vector<Mat3x4>& pose : poses)
    if (pose.size() != model.bone_count())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "a pose has the wrong number of bones (got %zu, need %zu)",
                    pose.size(), model.bone_count());
  const std::size_t points = model.key_points.size();
  const Shadows fine = evaluate(model, model.spheres, poses);
  std::vector<CharacterLevel> levels;
  for (const LevelShare& share : shares) {
    CharacterLevel& level = levels.emplace_back();
    level.spheres = merge_spheres(model, share_of(share.spheres, model.spheres.size()));
    const Shadows coarse = evaluate(model, level.spheres, poses);
    const Regression regression(fine, coarse);
    const std::vector<float> cost = following_cost(model, regression);
    const std::vector<std::uint16_t> evaluated =
        choose_evaluated(cost, points, share_of(share.key_points, points));
    level.evaluated.assign(evaluated.begin(), evaluated.end());
    for (std::size_t k = 0; k < points; ++k) {
      const auto cheaper = [&](std::uint16_t a, std::uint16_t b) {
        return cost[k * points + a] < cost[k * points + b];
      };
      const auto source = std::min_element(evaluated.begin(), evaluated.end(), cheaper) - evaluated.begin();
      const Line line = regression.fit(k, evaluated[static_cast<std::size_t>(source)]);
      level.source.push_back(static_cast<std::uint16_t>(source));
      level.scale.push_back(line.scale);
      level.offset.push_back(line.offset);
    }
    level.error_rms = measure_error(model, level, fine, coarse);
  }
  return levels;
}

}  // namespace nook::bake
