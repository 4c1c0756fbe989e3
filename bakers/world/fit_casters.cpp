#include "bakers/world/fit_casters.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/import/skinned_mesh.h"
#include "bakers/world/body_metres.h"
#include "bakers/world/dual.h"
#include "bakers/world/initial_casters.h"
#include "bakers/world/posed_casters.h"
#include "bakers/world/training_points.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// The number of parameters of a caster: the coordinates of two ends, the logarithms of both radii, and the
// logarithm of ao_scale.
constexpr std::size_t width = Dual::count + 1;
// The number of partial sums. They are added in a fixed order, so that the result does not depend on the
// threads.
constexpr std::size_t chunks = 16;
constexpr std::size_t block_rows = 128;  // points whose derivatives are multiplied at once

using Parameters = Eigen::VectorXd;

float covered_share(const Capsule& c, const TrainingPoint& point) {
  if (!point.of_light()) return coverage_at(c, point.position, point.normal);
  // The formula approximates a capsule by a rectangle that reaches a little beyond its round ends. So we test
  // with twice the cone's angle.
  if (!may_hide(c, point.position, point.normal, 2 * std::atan(point.slope))) return 0;
  return part_coverage_at(c, point.position, point.normal, point.slope);
}

Parameters parameters_of(std::span<const WorldCaster> casters) {
  Parameters p(Eigen::Index(casters.size() * width));
  for (std::size_t k = 0; k < casters.size(); ++k) {
    const Capsule& c = casters[k].capsule;
    const double values[width] = {double(c.a.x),
                                  double(c.a.y),
                                  double(c.a.z),
                                  double(c.b.x),
                                  double(c.b.y),
                                  double(c.b.z),
                                  std::log(double(c.radius_a)),
                                  std::log(double(c.radius_b)),
                                  std::log(double(casters[k].ao_scale))};
    for (std::size_t i = 0; i < width; ++i) p[Eigen::Index(k * width + i)] = values[i];
  }
  return p;
}

void set_parameters(std::span<WorldCaster> casters, const Parameters& p) {
  for (std::size_t k = 0; k < casters.size(); ++k) {
    const auto at = [&](std::size_t i) { return p[Eigen::Index(k * width + i)]; };
    casters[k].capsule = {{float(at(0)), float(at(1)), float(at(2))},
                          {float(at(3)), float(at(4)), float(at(5))},
                          float(std::exp(at(6))),
                          float(std::exp(at(7)))};
    casters[k].ao_scale = float(std::exp(at(8)));
  }
}

struct Slopes {
  float value = 0;
  std::array<float, width> slope{};
};

// Returns the coverage of one point and its derivatives with respect to the caster's parameters in rest
// space.
Slopes coverage_with_slopes(const Capsule& c, const Mat3x4& bone, const TrainingPoint& point) {
  const Vec3 a = c.a - point.position, b = c.b - point.position;
  const float values[Dual::count] = {a.x, a.y, a.z, b.x, b.y, b.z, c.radius_a, c.radius_b};
  Dual lane[Dual::count];
  for (int i = 0; i < Dual::count; ++i) lane[i] = Dual::parameter(values[i], i);
  const Vec3 n = point.normal;
  const world::CapsuleLanes<Dual> lanes{lane[0], lane[1], lane[2], lane[3],
                                        lane[4], lane[5], lane[6], lane[7]};
  const Dual f = point.of_light()
                     ? world::part_coverage<Dual>(lanes, Dual(n.x), Dual(n.y), Dual(n.z), Dual(point.slope))
                     : world::coverage<Dual>(lanes, Dual(n.x), Dual(n.y), Dual(n.z));
  Slopes r;
  r.value = f.value;
  const float* m = bone.m;
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t i = 0; i < 3; ++i)
      r.slope[3 * end + i] =
          m[i] * f.slope[3 * end] + m[4 + i] * f.slope[3 * end + 1] + m[8 + i] * f.slope[3 * end + 2];
  r.slope[6] = c.radius_a * f.slope[6];
  r.slope[7] = c.radius_b * f.slope[7];
  r.slope[8] = point.of_light() ? 0 : r.slope[6] + r.slope[7];
  return r;
}

struct Sums {
  double error = 0;
  Eigen::MatrixXd gram;  // lower triangle
  Eigen::VectorXd right;
};

// The weighted squared error of a range of points, and the normal equations of its linear approximation.
class Objective {
 public:
  explicit Objective(const TrainingPoints& set) : set_(set) {}

  double error(std::span<const WorldCaster> casters) const {
    std::vector<double> part(chunks, 0.0);
    const PosedSets capsules = posed_all(casters);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
      for (std::size_t i = first(chunk); i < first(chunk + 1); ++i) {
        const TrainingPoint& point = set_.point[i];
        float open = 1;
        for (const Capsule& c : capsules.of(point)) open *= 1 - covered_share(c, point);
        const double e = double(open) - double(point.ao);
        part[chunk] += double(point.weight) * e * e;
      }
    });
    double sum = 0;
    for (const double p : part) sum += p;
    return sum;
  }

  Sums linearise(std::span<const WorldCaster> casters) const {
    std::vector<Sums> part(chunks);
    const PosedSets capsules = posed_all(casters);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
      linearise(casters, capsules, first(chunk), first(chunk + 1), part[chunk]);
    });
    Sums sums = std::move(part[0]);
    for (std::size_t c = 1; c < chunks; ++c) {
      sums.error += part[c].error;
      sums.gram += part[c].gram;
      sums.right += part[c].right;
    }
    return sums;
  }

 private:
  std::size_t first(std::size_t chunk) const { return chunk * set_.point.size() / chunks; }

  // The capsules of every pose.
  struct PosedSets {
    std::vector<std::vector<Capsule>> for_ao, for_light;
    const std::vector<Capsule>& of(const TrainingPoint& point) const {
      return (point.of_light() ? for_light : for_ao)[point.pose];
    }
  };

  PosedSets posed_all(std::span<const WorldCaster> casters) const {
    PosedSets all;
    for (const Pose& pose : set_.poses) {
      all.for_ao.push_back(posed(casters, pose, CasterUse::ao));
      all.for_light.push_back(posed(casters, pose, CasterUse::light));
    }
    return all;
  }

  void linearise(std::span<const WorldCaster> casters, const PosedSets& capsules, std::size_t begin,
                 std::size_t end, Sums& sums) const {
    const auto columns = Eigen::Index(casters.size() * width);
    sums.gram = Eigen::MatrixXd::Zero(columns, columns);
    sums.right = Eigen::VectorXd::Zero(columns);
    Eigen::MatrixXf rows(block_rows, columns), gram(columns, columns);
    Eigen::VectorXf residual(block_rows);
    std::vector<Slopes> covered(casters.size());
    // Nearly every caster affects the AO points, so their rows are full and we multiply them as one block.
    std::size_t count = 0;
    const auto multiply = [&] {
      if (count == 0) return;  // Eigen divides by the number of rows
      gram.setZero();
      gram.selfadjointView<Eigen::Lower>().rankUpdate(rows.topRows(Eigen::Index(count)).transpose());
      sums.gram.triangularView<Eigen::Lower>() += gram.cast<double>();
      sums.right -=
          (rows.topRows(Eigen::Index(count)).transpose() * residual.head(Eigen::Index(count))).cast<double>();
      count = 0;
    };
    for (std::size_t i = begin; i < end; ++i) {
      const TrainingPoint& point = set_.point[i];
      if (point.of_light()) {
        add_light(casters, capsules.of(point), point, sums);
        continue;
      }
      const Pose& pose = set_.poses[point.pose];
      float open = 1;
      for (std::size_t k = 0; k < casters.size(); ++k) {
        covered[k] = coverage_with_slopes(capsules.of(point)[k], pose[casters[k].bone], point);
        open *= 1 - covered[k].value;
      }
      const float weight = std::sqrt(point.weight), e = open - point.ao;
      sums.error += double(point.weight) * double(e) * double(e);
      residual[Eigen::Index(count)] = weight * e;
      for (std::size_t k = 0; k < casters.size(); ++k) {
        const float others = -weight * open / std::max(1 - covered[k].value, 1e-3f);
        for (std::size_t s = 0; s < width; ++s)
          rows(Eigen::Index(count), Eigen::Index(k * width + s)) = others * covered[k].slope[s];
      }
      if (++count == block_rows) multiply();
    }
    multiply();
  }

  // Only a few casters hide each light, so we change only their rows and columns.
  void add_light(std::span<const WorldCaster> casters, const std::vector<Capsule>& capsules,
                 const TrainingPoint& point, Sums& sums) const {
    struct Hiding {
      std::size_t caster;
      Slopes share;
    };
    const Pose& pose = set_.poses[point.pose];
    std::vector<Hiding> hiding;
    float open = 1;
    for (std::size_t k = 0; k < casters.size(); ++k) {
      if (!may_hide(capsules[k], point.position, point.normal, 2 * std::atan(point.slope))) continue;
      Slopes share = coverage_with_slopes(capsules[k], pose[casters[k].bone], point);
      open *= 1 - share.value;
      // The slopes are not finite if both ends of a capsule are at the same point.
      const bool finite = std::all_of(share.slope.begin(), share.slope.end(),
                                      [](float slope) { return std::isfinite(slope); });
      if (!finite) share.slope.fill(0);
      hiding.push_back({k, share});
    }
    const float e = open - point.ao;
    sums.error += double(point.weight) * double(e) * double(e);
    for (Hiding& one : hiding)
      for (float& slope : one.share.slope) slope *= -open / std::max(1 - one.share.value, 1e-3f);
    for (const Hiding& one : hiding)
      for (std::size_t i = 0; i < Dual::count; ++i) {
        const auto row = Eigen::Index(one.caster * width + i);
        const double weighted = double(point.weight) * double(one.share.slope[i]);
        if (weighted == 0) continue;
        sums.right[row] -= weighted * double(e);
        for (const Hiding& other : hiding) {
          if (other.caster > one.caster) break;
          const std::size_t last = other.caster == one.caster ? i + 1 : Dual::count;
          for (std::size_t j = 0; j < last; ++j)
            sums.gram(row, Eigen::Index(other.caster * width + j)) += weighted * double(other.share.slope[j]);
        }
      }
  }

  const TrainingPoints& set_;
};

// A capsule without length has no direction, and its derivatives are infinite. So every capsule starts with a
// length of at least a tenth of its radius.
void lengthen(std::vector<WorldCaster>& casters) {
  for (WorldCaster& caster : casters) {
    Capsule& c = caster.capsule;
    const float least = 0.1f * std::max(c.radius_a, c.radius_b);
    const Vec3 along = c.b - c.a;
    if (length(along) >= least) continue;
    const Vec3 direction = length(along) > 0 ? normalised(along) : Vec3{0, 1, 0}, middle = 0.5f * (c.a + c.b);
    c.a = middle - 0.5f * least * direction;
    c.b = middle + 0.5f * least * direction;
  }
}

// Capsules overlap, so they darken too much at their full radius. The fit starts with one scale for all
// radii, and with another scale for the radii in AO.
void scale_radii(std::vector<WorldCaster>& casters, const Objective& objective) {
  const auto scaled = [&](float radius, float ao) {
    std::vector<WorldCaster> out = casters;
    for (WorldCaster& c : out) {
      c.capsule.radius_a *= radius;
      c.capsule.radius_b *= radius;
      c.ao_scale = ao;
    }
    return out;
  };
  // The errors of AO depend only on the radii in AO, so we can find one scale after the other.
  const auto best_of = [&](auto&& candidate) {
    std::vector<WorldCaster> best;
    double least = INFINITY;
    for (int i = 0; i < 9; ++i) {
      const std::vector<WorldCaster> tried = candidate(0.64f + 0.06f * float(i));
      const double error = objective.error(tried);
      if (best.empty() || error < least) {
        least = error;
        best = tried;
      }
    }
    return best;
  };
  casters = best_of([&](float ao) { return scaled(1, ao); });
  const float in_ao = casters.front().ao_scale;
  casters = best_of([&](float radius) { return scaled(radius, in_ao / radius); });
}

// Returns the inverse variances of the prior that pulls parameters towards their initial values.
Eigen::VectorXd pull_of(std::size_t casters, const WorldCasterSettings& s) {
  Eigen::VectorXd pull(Eigen::Index(casters * width));
  for (std::size_t i = 0; i < casters * width; ++i) {
    const double deviation = i % width < 6 ? s.deviation_m : s.deviation_radius;
    pull[Eigen::Index(i)] = s.pull / (deviation * deviation * double(casters * width));
  }
  return pull;
}

// Fewer casters have fewer parameters, so fewer points are enough. We keep at least a quarter of the points,
// because with fewer points their random positions would visibly affect the result.
WorldCasterSettings with_points_for(std::size_t casters, WorldCasterSettings settings) {
  const double share = std::clamp(double(casters) / double(settings.casters), 0.25, 1.0);
  for (std::size_t* const points :
       {&settings.floor_points, &settings.wall_points, &settings.contact_points, &settings.neighbour_points,
        &settings.cone_points, &settings.outline_points})
    *points = std::size_t(std::ceil(share * double(*points)));
  return settings;
}

}  // namespace

std::vector<WorldCaster> fit_world_casters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                           const WorldCasterSettings& settings, WorldCasterReport* report,
                                           const CasterProgress& progress) {
  const float scale = scale_to_metres(mesh);
  if (scale != 1)
    return casters_in_metres(fit_world_casters(mesh_in_metres(mesh, scale), poses_in_metres(poses, scale),
                                               settings, report, progress),
                             1 / scale);
  const platform::Stopwatch watch;
  // A mesh with one bone is an object, such as a table. Its triangles may be large.
  const SkinnedMesh fine = mesh.bones.size() == 1 ? refined(mesh) : SkinnedMesh{};
  const SkinnedMesh& begin = mesh.bones.size() == 1 ? fine : mesh;
  std::vector<WorldCaster> casters =
      initial_casters(begin, vertex_areas(begin, begin.position), settings.casters);
  lengthen(casters);
  const std::size_t total = std::min(settings.poses, poses.size()) + settings.steps;
  const WorldCasterSettings points = with_points_for(casters.size(), settings);
  const TrainingPoints set = trace_training_points(
      mesh, poses, points, [&](std::size_t done, std::size_t) { return !progress || progress(done, total); });
  const Objective objective(set);
  scale_radii(casters, objective);
  const Parameters start = parameters_of(casters);
  const Eigen::VectorXd pull = pull_of(casters.size(), settings);
  const auto pulled = [&](const Parameters& p) {
    return ((p - start).array().square() * pull.array()).sum();
  };

  Parameters best = start;
  double best_error = objective.error(casters);
  if (report) report->error_initial = best_error;
  double damping = 1e-2;
  int stalled = 0;  // consecutive steps with almost no gain
  for (std::size_t step = 0; step < settings.steps && stalled < 2; ++step) {
    if (progress && !progress(total - settings.steps + step, total))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while fitting casters");
    set_parameters(casters, best);
    Sums sums = objective.linearise(casters);
    sums.gram.diagonal() += pull;
    sums.right -= ((best - start).array() * pull.array()).matrix();
    const double before = best_error;
    for (int attempt = 0; attempt < 6 && best_error == before; ++attempt) {
      Eigen::MatrixXd damped = sums.gram;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-12;
      const Eigen::VectorXd change = damped.selfadjointView<Eigen::Lower>().ldlt().solve(sums.right);
      set_parameters(casters, best + change);
      const double error = objective.error(casters) + pulled(best + change);
      // The gain that the linear approximation predicts for this step.
      const double promised =
          2 * change.dot(sums.right) - change.dot(sums.gram.selfadjointView<Eigen::Lower>() * change);
      const double kept = (before - error) / std::max(promised, 1e-12);
      if (error < before) {
        best += change;
        best_error = error;
      }
      if (!(kept > 0.25))
        damping *= 4;
      else if (kept > 0.7)
        damping = std::max(damping * 0.3, 1e-6);
    }
    stalled = before - best_error < 2e-3 * before ? stalled + 1 : 0;
  }
  set_parameters(casters, best);
  if (report) {
    report->error_fitted = objective.error(casters);
    report->seconds = watch.seconds();
  }
  return casters;
}

}  // namespace nook::bake
