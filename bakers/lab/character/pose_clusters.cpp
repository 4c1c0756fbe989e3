#include "bakers/lab/character/character_peers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/lab/character/cross_validation.h"
#include "bakers/lab/character/pose_space.h"

namespace nook::lab {
namespace {

using namespace bake;
using namespace measure;

using Eigen::Index;

constexpr std::array<Index, 6> cluster_counts{1, 2, 4, 8, 16, 32};
constexpr std::array<Index, 8> ranks{2, 4, 8, 16, 32, 64, 128, 192};
constexpr std::array ridges{1e-4, 1e-3, 1e-2, 3e-2,
                            1e-1, 3e-1, 1.0};  // in units of the mean variance of a basis direction
// Candidates for the width of the blend: the variance of its Gaussian divided by the mean squared distance of
// the poses to their nearest centre.
constexpr std::array widths{0.1, 0.3, 1.0, 3.0};
constexpr double first_width = 0.3;
constexpr std::size_t voting_vertices = 256;
constexpr double size_slack = 0.005;
constexpr float least_weight = 1e-3f;  // the fit of a cluster ignores poses with a smaller weight

struct Settings {
  FeatureKind kind = FeatureKind::axis_angle;
  bool by_moved_share = false;  // selects the distance metric for poses; see PoseSpace
  Index clusters = 1, rank = ranks.back();
  double ridge = ridges.back(), width = first_width;
};

// Returns the blend weights as a matrix of poses x clusters. They are normalised Gaussians of the distances
// to the centres.
BaselineMatrix blend_weights(const BaselineMatrix& features, const BaselineMatrix& centres, double variance) {
  BaselineMatrix w = squared_distances(features, centres);
  for (Index t = 0; t < w.rows(); ++t) {
    w.row(t) = ((w.row(t).minCoeff() - w.row(t).array()) / float(2 * std::max(variance, 1e-12))).exp();
    w.row(t) /= w.row(t).sum();
    w.row(t) = (w.row(t).array() < least_weight).select(0.0f, w.row(t).array()).matrix().eval();
    w.row(t) /= w.row(t).sum();
  }
  return w;
}

std::vector<Index> seen_by(const BaselineMatrix& weights, Index cluster) {
  std::vector<Index> rows;
  for (Index t = 0; t < weights.rows(); ++t)
    if (weights(t, cluster) > 0) rows.push_back(t);
  return rows;
}

// The weighted least-squares problem of one cluster, before a ridge and a rank are applied. It is expressed
// in the cluster's own principal components, so that the normal equations are diagonal.
struct ClusterFit {
  Eigen::RowVectorXf feature_mean, target_mean;
  BaselineMatrix basis;        // features x maximum components, strongest first
  Eigen::VectorXf variance;    // variance of the poses along each component
  BaselineMatrix correlation;  // components x targets
};

ClusterFit principal_components(const BaselineMatrix& features, const Eigen::VectorXf& weight, Index most) {
  ClusterFit fit;
  const float sum = weight.sum();
  fit.feature_mean = weight.transpose() * features / sum;
  const BaselineMatrix centred = features.rowwise() - fit.feature_mean;
  const Eigen::MatrixXd covariance =
      (centred.transpose() * (weight / sum).asDiagonal() * centred).cast<double>();
  const SymmetricEigen eigen = symmetric_eigen(covariance);
  const Index kept = std::min(most, features.cols());
  fit.basis = eigen.vectors.rightCols(kept).rowwise().reverse().cast<float>();
  fit.variance = eigen.values.tail(kept).reverse().cwiseMax(0.0).cast<float>();
  return fit;
}

void correlate(ClusterFit& fit, const BaselineMatrix& features, const Eigen::VectorXf& weight,
               const BaselineMatrix& targets) {
  const float sum = weight.sum();
  fit.target_mean = weight.transpose() * targets / sum;
  const BaselineMatrix reduced = (features.rowwise() - fit.feature_mean) * fit.basis;
  fit.correlation = reduced.transpose() * (weight / sum).asDiagonal() * (targets.rowwise() - fit.target_mean);
}

Eigen::VectorXf shrinkage(const ClusterFit& fit, double ridge) {
  const float level = std::max(fit.variance.mean(), 1e-8f) * float(ridge);
  return (fit.variance.array() + level).inverse();
}

BaselineMatrix rows_of(const BaselineMatrix& matrix, const std::vector<Index>& rows) {
  return matrix(rows, Eigen::all);
}

using ErrorGrid = Eigen::Array<double, ranks.size(), ridges.size()>;

// Returns the squared errors of one fold for every rank and ridge.
ErrorGrid validate_fold(const BaselineMatrix& features, const BaselineMatrix& targets,
                        const ValidationFold& fold, Index clusters, double width, std::uint64_t seed) {
  const BaselineMatrix x = rows_of(features, fold.fitted), y = rows_of(targets, fold.fitted);
  const BaselineMatrix held_x = rows_of(features, fold.left_out), held_y = rows_of(targets, fold.left_out);
  const PoseGroups groups = k_means(x, std::min(clusters, x.rows()), seed);
  const double variance = width * groups.mean_squared_distance;
  const BaselineMatrix w = blend_weights(x, groups.centre, variance),
                       held_w = blend_weights(held_x, groups.centre, variance);
  std::vector<BaselineMatrix> prediction(ranks.size() * ridges.size(),
                                         BaselineMatrix::Zero(held_y.rows(), held_y.cols()));
  for (Index k = 0; k < groups.centre.rows(); ++k) {
    const std::vector<Index> seen = seen_by(w, k), asked = seen_by(held_w, k);
    if (asked.empty() || seen.empty()) continue;
    const BaselineMatrix seen_x = rows_of(x, seen);
    const Eigen::VectorXf seen_w = w.col(k)(seen), asked_w = held_w.col(k)(asked);
    ClusterFit fit = principal_components(seen_x, seen_w, ranks.back());
    correlate(fit, seen_x, seen_w, rows_of(y, seen));
    const BaselineMatrix reduced = (rows_of(held_x, asked).rowwise() - fit.feature_mean) * fit.basis;
    for (std::size_t g = 0; g < ridges.size(); ++g) {
      const BaselineMatrix shrunk = shrinkage(fit, ridges[g]).asDiagonal() * fit.correlation;
      BaselineMatrix answer = fit.target_mean.replicate(reduced.rows(), 1);
      Index done = 0;
      for (std::size_t r = 0; r < ranks.size(); ++r) {
        const Index rank = std::min(ranks[r], reduced.cols());
        answer += reduced.middleCols(done, rank - done) * shrunk.middleRows(done, rank - done);
        done = rank;
        BaselineMatrix& sum = prediction[r * ridges.size() + g];
        for (std::size_t i = 0; i < asked.size(); ++i)
          sum.row(asked[i]) += asked_w[Index(i)] * answer.row(Index(i));
      }
    }
  }
  ErrorGrid errors;
  for (std::size_t r = 0; r < ranks.size(); ++r)
    for (std::size_t g = 0; g < ridges.size(); ++g)
      errors(Index(r), Index(g)) = clamped_squared_error(prediction[r * ridges.size() + g], held_y);
  return errors;
}

std::size_t stored_numbers(const PoseSpace& space, Index clusters, Index rank, std::size_t vertices) {
  return space.stored_numbers() + std::size_t(clusters) * (std::size_t(rank + 1) * vertices +
                                                           std::size_t((rank + 2) * space.dimensions()));
}

// Measures settings on all folds and stores their errors.
class Search {
 public:
  Search(std::span<const Pose> poses, const AoTargets& targets, std::uint64_t seed)
      : folds_(validation_folds(poses.size())),
        voting_(target_columns(targets, sample_vertices(targets.vertex_count, voting_vertices))),
        vertices_(targets.vertex_count),
        seed_(seed) {}

  // Measures the settings with every rank and ridge.
  void measure(const PoseSpace& space, const BaselineMatrix& x, Settings settings) {
    // A cluster with few poses does not have a meaningful linear model.
    if (settings.clusters > 1 && settings.clusters * 8 > x.rows()) return;
    std::vector<ErrorGrid> partial(folds_.size());
    tbb::parallel_for(std::size_t(0), folds_.size(), [&](std::size_t f) {
      partial[f] = validate_fold(x, voting_, folds_[f], settings.clusters, settings.width, seed_);
    });
    ErrorGrid sum = ErrorGrid::Zero();
    for (const ErrorGrid& p : partial) sum += p;
    for (std::size_t r = 0; r < ranks.size(); ++r)
      for (std::size_t g = 0; g < ridges.size(); ++g) {
        settings.rank = std::min(ranks[r], x.cols());
        settings.ridge = ridges[g];
        tried_.push_back(settings);
        errors_.push_back(
            {sum(Index(r), Index(g)), stored_numbers(space, settings.clusters, settings.rank, vertices_)});
      }
  }

  Settings best(double slack) const { return tried_[smallest_near_best(errors_, slack)]; }

 private:
  std::vector<ValidationFold> folds_;
  BaselineMatrix voting_;
  std::size_t vertices_;
  std::uint64_t seed_;
  std::vector<Settings> tried_;
  std::vector<SizedError> errors_;
};

// First chooses the space of poses, then the number of clusters, and finally the width of the blend.
Settings choose_settings(const SkinnedMesh& mesh, std::span<const Pose> poses, const AoTargets& targets,
                         std::uint64_t seed) {
  Search search(poses, targets, seed);
  for (FeatureKind kind : {FeatureKind::axis_angle, FeatureKind::matrix})
    for (bool by_moved_share : {false, true}) {
      const PoseSpace space(mesh, kind, by_moved_share, poses, ranks.back());
      const BaselineMatrix x = space.of(poses);
      for (Index clusters : {1, 8}) search.measure(space, x, {kind, by_moved_share, clusters});
    }
  const Settings first = search.best(0);
  const PoseSpace space(mesh, first.kind, first.by_moved_share, poses, ranks.back());
  const BaselineMatrix x = space.of(poses);
  for (Index clusters : cluster_counts)
    if (clusters != 1 && clusters != 8)
      search.measure(space, x, {first.kind, first.by_moved_share, clusters});
  // With a single cluster, the width has no effect. Two clusters may become better than one if the width
  // changes, so the search over widths uses at least two clusters.
  const Index clusters = std::max<Index>(search.best(0).clusters, 2);
  for (double width : widths)
    if (width != first_width)
      search.measure(space, x,
                     {first.kind, first.by_moved_share, clusters, ranks.back(), ridges.back(), width});
  return search.best(size_slack);
}

class PoseClusters final : public PoseRegression {
 public:
  PoseClusters(const SkinnedMesh& mesh, const Settings& settings, std::span<const Pose> poses,
               const AoTargets& targets, std::uint64_t seed)
      : settings_(settings),
        space_(mesh, settings.kind, settings.by_moved_share, poses, ranks.back()),
        vertices_(targets.vertex_count) {
    settings_.rank = std::min(settings_.rank, space_.dimensions());
    const BaselineMatrix x = space_.of(poses);
    const PoseGroups groups = k_means(x, std::min(settings_.clusters, x.rows()), seed);
    centres_ = groups.centre;
    variance_ = settings_.width * groups.mean_squared_distance;
    const BaselineMatrix w = blend_weights(x, centres_, variance_);
    clusters_.resize(std::size_t(centres_.rows()));
    for (Index k = 0; k < centres_.rows(); ++k) fit_cluster(clusters_[std::size_t(k)], x, w, k, targets);
  }

  std::vector<float> predict(const Pose& pose) const override {
    const BaselineMatrix x = space_.of(pose);
    const BaselineMatrix w = blend_weights(x, centres_, variance_);
    Eigen::RowVectorXf ao = Eigen::RowVectorXf::Zero(Index(vertices_));
    for (std::size_t k = 0; k < clusters_.size(); ++k) {
      const float weight = w(0, Index(k));
      if (weight <= 0) continue;
      const Cluster& c = clusters_[k];
      ao += weight * (c.mean + (x.row(0) - c.feature_mean) * c.basis * c.map);
    }
    ao = ao.cwiseMax(0.0f).cwiseMin(1.0f);
    return {ao.data(), ao.data() + ao.size()};
  }
  std::size_t model_bytes() const override {
    return 2 * stored_numbers(space_, Index(clusters_.size()), settings_.rank, vertices_);
  }
  std::string description() const override {
    char text[160];
    std::snprintf(text, sizeof text, "%s, %td clusters, rank %td, ridge %g, blend width %g%s",
                  settings_.kind == FeatureKind::axis_angle ? "axis-angle" : "rotation matrices",
                  settings_.clusters, settings_.rank, settings_.ridge, settings_.width,
                  settings_.by_moved_share ? ", joints weighted by the share of vertices they move" : "");
    return text;
  }

 private:
  static constexpr std::size_t block = 256;  // vertices solved together
  struct Cluster {
    Eigen::RowVectorXf feature_mean;
    BaselineMatrix basis;     // features x rank
    Eigen::RowVectorXf mean;  // one per vertex
    BaselineMatrix map;       // rank x vertices
  };

  void fit_cluster(Cluster& cluster, const BaselineMatrix& x, const BaselineMatrix& w, Index k,
                   const AoTargets& targets) {
    const std::vector<Index> seen = seen_by(w, k);
    cluster.mean = Eigen::RowVectorXf::Zero(Index(vertices_));
    cluster.feature_mean = centres_.row(k);
    cluster.basis = BaselineMatrix::Zero(x.cols(), settings_.rank);
    cluster.map = BaselineMatrix::Zero(settings_.rank, Index(vertices_));
    if (seen.empty()) return;
    const BaselineMatrix seen_x = rows_of(x, seen);
    const Eigen::VectorXf seen_w = w.col(k)(seen);
    const ClusterFit shared = principal_components(seen_x, seen_w, settings_.rank);
    cluster.feature_mean = shared.feature_mean;
    cluster.basis = shared.basis;
    const Eigen::VectorXf shrink = full_shrinkage(seen_x, seen_w);
    tbb::parallel_for(std::size_t(0), (vertices_ + block - 1) / block, [&](std::size_t b) {
      const std::size_t first = b * block, last = std::min(vertices_, first + block);
      ClusterFit part = shared;
      correlate(part, seen_x, seen_w, rows_of(target_columns(targets, first, last), seen));
      cluster.mean.segment(Index(first), Index(last - first)) = part.target_mean;
      cluster.map.middleCols(Index(first), Index(last - first)) = shrink.asDiagonal() * part.correlation;
    });
    round_to_half(cluster.basis);
    round_to_half(cluster.map);
  }

  // The ridge is relative to the mean variance of the components. This mean is always taken over the largest
  // number of components that validation used, independent of the chosen rank.
  Eigen::VectorXf full_shrinkage(const BaselineMatrix& seen_x, const Eigen::VectorXf& seen_w) const {
    const ClusterFit full = principal_components(seen_x, seen_w, ranks.back());
    return shrinkage(full, settings_.ridge).head(settings_.rank);
  }

  Settings settings_;
  PoseSpace space_;
  BaselineMatrix centres_;
  double variance_ = 1;
  std::size_t vertices_;
  std::vector<Cluster> clusters_;
};

// The model for a character without rotating joints. It predicts the mean AO.
class MeanAo final : public PoseRegression {
 public:
  explicit MeanAo(const AoTargets& targets)
      : mean_(target_columns(targets, 0, targets.vertex_count).colwise().mean()) {}
  std::vector<float> predict(const Pose&) const override {
    return {mean_.data(), mean_.data() + mean_.size()};
  }
  std::size_t model_bytes() const override { return 2 * std::size_t(mean_.size()); }
  std::string description() const override { return "the mean: no joint can turn"; }

 private:
  Eigen::RowVectorXf mean_;
};

}  // namespace

std::unique_ptr<PoseRegression> fit_pose_clusters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                                  const AoTargets& targets, std::uint64_t seed) {
  if (PoseFeatures(mesh, FeatureKind::axis_angle).count() == 0 || poses.size() < 2)
    return std::make_unique<MeanAo>(targets);
  return std::make_unique<PoseClusters>(mesh, choose_settings(mesh, poses, targets, seed), poses, targets,
                                        seed);
}

}  // namespace nook::lab
