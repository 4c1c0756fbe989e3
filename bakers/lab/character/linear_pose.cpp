#include "bakers/lab/character/character_peers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/lab/character/cross_validation.h"
#include "bakers/lab/character/pose_space.h"

namespace nook::lab {
namespace {

using namespace bake;
using namespace measure;

using Eigen::Index;

constexpr std::array ridges{1e-6, 1e-5, 1e-4, 1e-3, 3e-3,
                            1e-2, 3e-2, 1e-1, 3e-1, 1.0};  // in units of the mean variance
constexpr std::array<Index, 12> ranks{2, 4, 8, 16, 24, 32, 48, 64, 96, 128, 192, 256};
constexpr std::size_t voting_vertices = 384;
constexpr double rank_slack = 0.005;

struct Parametrisation {
  FeatureKind kind = FeatureKind::axis_angle;
  bool scaled = false;  // true if each parameter is scaled to unit variance
};

// The diagonalised normal equations of one set of poses. With them, the solution for any ridge and rank needs
// only matrix products: coefficients = Q (S + ridge)^-1 Q^T X^T Y.
struct NormalEquations {
  Eigen::RowVectorXf feature_mean, feature_scale, target_mean;
  Eigen::MatrixXd q;        // eigenvectors of the features' covariance
  Eigen::VectorXd s;        // its eigenvalues
  Eigen::MatrixXd rotated;  // Q^T X^T Y / n: features x targets
  double mean_variance = 0;
};

BaselineMatrix standardise(const NormalEquations& n, const BaselineMatrix& features) {
  return ((features.rowwise() - n.feature_mean).array().rowwise() * n.feature_scale.array()).matrix();
}

NormalEquations diagonalise(const BaselineMatrix& features, bool scaled) {
  NormalEquations n;
  n.feature_mean = features.colwise().mean();
  n.feature_scale = Eigen::RowVectorXf::Ones(features.cols());
  if (scaled) {
    const Eigen::RowVectorXf variance =
        (features.rowwise() - n.feature_mean).colwise().squaredNorm() / float(features.rows());
    // A parameter that never changes is 0 after the mean is subtracted, so any scale will do.
    for (Index i = 0; i < variance.size(); ++i)
      n.feature_scale[i] = variance[i] > 1e-10f ? 1 / std::sqrt(variance[i]) : 0.0f;
  }
  const Eigen::MatrixXd x = standardise(n, features).cast<double>();
  SymmetricEigen eigen = symmetric_eigen(x.transpose() * x / double(x.rows()));
  n.q = std::move(eigen.vectors);
  n.s = eigen.values.cwiseMax(0.0);
  n.mean_variance = std::max(n.s.mean(), 1e-12);
  return n;
}

void add_targets(NormalEquations& n, const BaselineMatrix& features, const BaselineMatrix& targets) {
  n.target_mean = targets.colwise().mean();
  const Eigen::MatrixXd x = standardise(n, features).cast<double>();
  const Eigen::MatrixXd y = (targets.rowwise() - n.target_mean).cast<double>();
  n.rotated = n.q.transpose() * (x.transpose() * y / double(x.rows()));
}

// The basis of reduced-rank regression: the directions that the ridge solution explains best. They are the
// left singular vectors of A = (S + ridge)^-1/2 Q^T X^T Y, because |X W|^2 + ridge |W|^2 = |A|^2 for the
// solution W.
struct RankBasis {
  Eigen::VectorXd inverse_root;  // (S + ridge)^-1/2
  Eigen::MatrixXd u;             // strongest first
};
RankBasis rank_basis(const NormalEquations& n, double ridge, const Eigen::MatrixXd& outer) {
  RankBasis basis;
  basis.inverse_root = (n.s.array() + ridge * n.mean_variance).rsqrt();
  const Eigen::MatrixXd weighted = basis.inverse_root.asDiagonal() * outer * basis.inverse_root.asDiagonal();
  basis.u = symmetric_eigen(weighted).vectors.rowwise().reverse();
  return basis;
}

BaselineMatrix rows_of(const BaselineMatrix& matrix, const std::vector<Index>& rows) {
  return matrix(rows, Eigen::all);
}

struct Choice {
  Parametrisation parametrisation;
  double ridge = ridges.back();
  double error = 0;
};

// Returns the sum of squared errors over all folds, for each ridge.
std::vector<double> validate_ridges(const BaselineMatrix& features, const BaselineMatrix& targets,
                                    bool scaled, const std::vector<ValidationFold>& folds) {
  std::vector<std::array<double, ridges.size()>> partial(folds.size());
  tbb::parallel_for(std::size_t(0), folds.size(), [&](std::size_t f) {
    const BaselineMatrix x = rows_of(features, folds[f].fitted), held_y = rows_of(targets, folds[f].left_out);
    NormalEquations n = diagonalise(x, scaled);
    add_targets(n, x, rows_of(targets, folds[f].fitted));
    const Eigen::MatrixXd held_x = standardise(n, rows_of(features, folds[f].left_out)).cast<double>() * n.q;
    for (std::size_t r = 0; r < ridges.size(); ++r) {
      const Eigen::VectorXd shrink = (n.s.array() + ridges[r] * n.mean_variance).inverse();
      BaselineMatrix prediction = (held_x * shrink.asDiagonal() * n.rotated).cast<float>();
      prediction.rowwise() += n.target_mean;
      partial[f][r] = clamped_squared_error(prediction, held_y);
    }
  });
  std::vector<double> errors(ridges.size(), 0.0);
  for (const auto& p : partial)
    for (std::size_t r = 0; r < ridges.size(); ++r) errors[r] += p[r];
  return errors;
}

std::vector<Index> ranks_up_to(Index most) {
  std::vector<Index> allowed;
  for (Index r : ranks)
    if (r < most) allowed.push_back(r);
  allowed.push_back(most);
  return allowed;
}

Index choose_rank(const BaselineMatrix& features, const BaselineMatrix& targets, const Choice& choice,
                  const std::vector<ValidationFold>& folds) {
  const std::vector<Index> allowed = ranks_up_to(std::min(features.cols(), targets.cols()));
  std::vector<std::vector<double>> partial(folds.size(), std::vector<double>(allowed.size()));
  tbb::parallel_for(std::size_t(0), folds.size(), [&](std::size_t f) {
    const BaselineMatrix x = rows_of(features, folds[f].fitted), held_y = rows_of(targets, folds[f].left_out);
    NormalEquations n = diagonalise(x, choice.parametrisation.scaled);
    add_targets(n, x, rows_of(targets, folds[f].fitted));
    const RankBasis basis = rank_basis(n, choice.ridge, n.rotated * n.rotated.transpose());
    const Eigen::MatrixXd latent = standardise(n, rows_of(features, folds[f].left_out)).cast<double>() * n.q *
                                   basis.inverse_root.asDiagonal() * basis.u;
    const Eigen::MatrixXd map = basis.u.transpose() * basis.inverse_root.asDiagonal() * n.rotated;
    for (std::size_t r = 0; r < allowed.size(); ++r) {
      BaselineMatrix prediction = (latent.leftCols(allowed[r]) * map.topRows(allowed[r])).cast<float>();
      prediction.rowwise() += n.target_mean;
      partial[f][r] = clamped_squared_error(prediction, held_y);
    }
  });
  std::vector<SizedError> candidates(allowed.size());
  for (std::size_t r = 0; r < allowed.size(); ++r) {
    candidates[r].bytes = std::size_t(allowed[r]);
    for (const auto& p : partial) candidates[r].error += p[r];
  }
  return allowed[smallest_near_best(candidates, rank_slack)];
}

class LinearPose final : public PoseRegression {
 public:
  LinearPose(const SkinnedMesh& mesh, const Choice& choice)
      : choice_(choice), features_(mesh, choice.parametrisation.kind) {}

  void fit(std::span<const Pose> poses, const AoTargets& targets, Index rank) {
    const BaselineMatrix x = features_.of(poses);
    const std::size_t vertices = targets.vertex_count;
    if (rank == 0) {
      mean_ = target_columns(targets, 0, vertices).colwise().mean();
      feature_mean_ = Eigen::RowVectorXf::Zero(x.cols());
      to_latent_.resize(x.cols(), 0);
      map_.resize(0, Index(vertices));
      return;
    }
    NormalEquations n = diagonalise(x, choice_.parametrisation.scaled);
    const std::size_t blocks = (vertices + block - 1) / block;
    std::vector<Eigen::MatrixXd> rotated(blocks);
    mean_.resize(Index(vertices));
    tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
      NormalEquations part = n;
      add_targets(part, x, target_columns(targets, b * block, std::min(vertices, (b + 1) * block)));
      mean_.segment(Index(b * block), part.target_mean.size()) = part.target_mean;
      rotated[b] = std::move(part.rotated);
    });
    Eigen::MatrixXd outer = Eigen::MatrixXd::Zero(x.cols(), x.cols());
    for (const Eigen::MatrixXd& part : rotated) outer += part * part.transpose();
    const RankBasis basis = rank_basis(n, choice_.ridge, outer);
    rank = std::min(rank, x.cols());
    // Scales the latent coordinates so that half floats can store them without overflow or loss of precision.
    const Eigen::MatrixXd u = basis.u.leftCols(rank);
    const Eigen::MatrixXd to_latent =
        n.feature_scale.cast<double>().asDiagonal() * n.q * basis.inverse_root.asDiagonal() * u;
    to_latent_ = to_latent.cast<float>();
    round_to_half(to_latent_);
    feature_mean_ = n.feature_mean;
    map_.resize(rank, Index(vertices));
    for (std::size_t b = 0; b < blocks; ++b)
      map_.middleCols(Index(b * block), rotated[b].cols()) =
          (u.transpose() * basis.inverse_root.asDiagonal() * rotated[b]).cast<float>();
    round_to_half(map_);
  }

  std::vector<float> predict(const Pose& pose) const override {
    const Eigen::RowVectorXf latent = (features_.of(pose) - feature_mean_) * to_latent_;
    const Eigen::RowVectorXf ao = (latent * map_ + mean_).cwiseMax(0.0f).cwiseMin(1.0f);
    return {ao.data(), ao.data() + ao.size()};
  }
  std::size_t model_bytes() const override {
    return 2 * std::size_t(map_.size() + mean_.size() + to_latent_.size() + feature_mean_.size());
  }
  std::string description() const override {
    char text[160];
    std::snprintf(
        text, sizeof text, "%s%s, %td parameters, ridge %g, rank %td",
        choice_.parametrisation.kind == FeatureKind::axis_angle ? "axis-angle" : "rotation matrices",
        choice_.parametrisation.scaled ? " scaled to unit variance" : "", features_.count(), choice_.ridge,
        to_latent_.cols());
    return text;
  }

 private:
  static constexpr std::size_t block = 256;  // number of vertices that are solved together

  Choice choice_;
  PoseFeatures features_;
  Eigen::RowVectorXf feature_mean_, mean_;
  BaselineMatrix to_latent_;  // features x rank
  BaselineMatrix map_;        // rank x vertices
};

}  // namespace

std::unique_ptr<PoseRegression> fit_linear_pose(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                                const AoTargets& targets) {
  const std::vector<ValidationFold> folds = validation_folds(poses.size());
  const BaselineMatrix voting =
      target_columns(targets, sample_vertices(targets.vertex_count, voting_vertices));
  Choice best;
  bool first = true;
  for (FeatureKind kind : {FeatureKind::axis_angle, FeatureKind::matrix})
    for (bool scaled : {false, true}) {
      const BaselineMatrix features = PoseFeatures(mesh, kind).of(poses);
      if (features.cols() == 0 || folds.size() < 2) continue;
      const std::vector<double> errors = validate_ridges(features, voting, scaled, folds);
      for (std::size_t r = 0; r < ridges.size(); ++r) {
        if (!first && errors[r] >= best.error) continue;
        best = {{kind, scaled}, ridges[r], errors[r]};
        first = false;
      }
    }
  auto model = std::make_unique<LinearPose>(mesh, best);
  // If there are no parameters or too few poses, the model consists only of the mean.
  const Index rank =
      first ? 0 : choose_rank(PoseFeatures(mesh, best.parametrisation.kind).of(poses), voting, best, folds);
  model->fit(poses, targets, rank);
  return model;
}

}  // namespace nook::lab
