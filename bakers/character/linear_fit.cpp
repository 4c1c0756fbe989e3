#include "bakers/character/linear_fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>

namespace nook::bake {
namespace {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Minimum weights of a vertex's anchors, proportional to the nearness of each anchor.
std::vector<double> anchor_floors(const Candidates& candidates, std::size_t vertex,
                                  const LinearFitSettings& settings, std::size_t anchors) {
  std::vector<double> floor(anchors, 1.0);
  double total = 0;
  for (std::size_t a = 0; a < anchors; ++a) {
    if (!candidates.nearness.empty()) floor[a] = double(candidates.nearness[vertex * candidates.count + a]);
    total += floor[a];
  }
  for (double& f : floor) f *= settings.anchor_floor / total;
  return floor;
}

// Solves for the weights of the chosen key points by non-negative least squares with an active set. Solves
// without bounds and drops the entry with the most negative weight, until no weight is negative. A dropped
// entry has the weight 0 in the result.
Eigen::VectorXd solve_non_negative(const Eigen::MatrixXd& gram, const Eigen::VectorXd& correlation) {
  const Eigen::Index n = correlation.size();
  std::vector<Eigen::Index> active(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) active[static_cast<std::size_t>(i)] = i;
  Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
  while (!active.empty()) {
    const Eigen::VectorXd x = gram(active, active).ldlt().solve(correlation(active));
    Eigen::Index worst = 0;
    if (x.minCoeff(&worst) >= 0) {
      for (std::size_t i = 0; i < active.size(); ++i) full[active[i]] = x[static_cast<Eigen::Index>(i)];
      break;
    }
    active.erase(active.begin() + worst);
  }
  return full;
}

// The shadows of the fitted poses, which all vertices share.
struct ShadowStatistics {
  Eigen::RowVectorXf mean;  // per key point
  RowMatrix centred;        // poses x key points, mean removed
  Eigen::MatrixXd gram;     // covariances of the key points, with the ridge
};

ShadowStatistics statistics_of(std::span<const float> shadows, std::size_t poses, std::size_t padded,
                               double ridge) {
  const auto rows = Eigen::Index(poses), columns = Eigen::Index(padded);
  const Eigen::Map<const RowMatrix> all(shadows.data(), rows, columns);
  ShadowStatistics s;
  s.mean = all.colwise().mean();
  s.centred = all.rowwise() - s.mean;
  s.gram = Eigen::MatrixXd::Zero(columns, columns);
  // Products within a block of rows are computed in floats, and the products of the blocks are added in
  // doubles. This is fast, and accurate enough for a well-scaled Gram matrix.
  const Eigen::Index block = 256;
  for (Eigen::Index first = 0; first < rows; first += block) {
    const auto part = s.centred.middleRows(first, std::min(block, rows - first));
    s.gram += (part.transpose() * part).cast<double>();
  }
  s.gram /= double(poses);
  const double added = ridge * std::max(s.gram.diagonal().mean(), 1e-12);
  s.gram.diagonal().array() += added;
  return s;
}

// The darkness (1 - AO) of consecutive vertices in the fitted poses.
struct DarknessBlock {
  Eigen::RowVectorXf mean;      // per vertex
  RowMatrix centred;            // poses x vertices, mean removed
  Eigen::MatrixXd correlation;  // key points x vertices
};

DarknessBlock darkness_of(const TrainingSet& set, const ShadowStatistics& shadows, std::size_t first,
                          std::size_t count) {
  const std::size_t poses = set.fitted();
  DarknessBlock block;
  block.centred.resize(Eigen::Index(poses), Eigen::Index(count));
  for (std::size_t t = 0; t < poses; ++t) {
    const auto target = set.targets.row(t);
    for (std::size_t i = 0; i < count; ++i)
      block.centred(Eigen::Index(t), Eigen::Index(i)) = 1 - float(target[first + i]) * AoTargets::scale;
  }
  block.mean = block.centred.colwise().mean();
  block.centred.rowwise() -= block.mean;
  block.correlation = (shadows.centred.transpose() * block.centred).cast<double>() / double(poses);
  return block;
}

// A vertex's darkness or a key point's shadow counts as constant if its variance is below this value. For
// example, the shadows on a rigid prop vary only by rounding. Without this limit, the fit would give such
// shadows enormous weights to explain the noise of the rays.
constexpr double constant_variance = 1e-8;

// Key points that are chosen for a vertex, with the weights that explain its darkness best.
struct Choice {
  std::vector<Eigen::Index> key_point;
  Eigen::VectorXd weight;
  double explained = 0;  // how much of the variance the weights explain

  double weight_of(Eigen::Index k) const {
    const auto found = std::find(key_point.begin(), key_point.end(), k);
    return found == key_point.end() ? 0 : weight[Eigen::Index(found - key_point.begin())];
  }
};

// Chooses key points for one vertex one by one, and solves for their weights.
class KeyPointChoice {
 public:
  // `allowed` contains the candidates of the vertex. The first `anchors` candidates always get an entry.
  KeyPointChoice(const Eigen::MatrixXd& gram, std::span<const std::uint16_t> allowed, std::size_t anchors,
                 std::size_t entries)
      : gram_(gram), allowed_(allowed), anchors_(anchors), entries_(entries) {}

  bool is_anchor(Eigen::Index k) const {
    const auto end = allowed_.begin() + std::ptrdiff_t(anchors_);
    return std::find(allowed_.begin(), end, k) != end;
  }

  // Stops when another key point would explain less than `minimum_gain` of additional variance.
  Choice run(const Eigen::VectorXd& correlation, double minimum_gain) const {
    Choice choice;
    for (;;) {
      const Eigen::Index best = best_addition(choice, correlation);
      if (best < 0) return choice;
      Choice next = with(choice, best, correlation);
      if (next.explained - choice.explained < minimum_gain) return choice;
      choice = std::move(next);
    }
  }

 private:
  // Returns the key point that explains most of the remaining variance if it is added and the other weights
  // stay the same. Returns -1 if no key point can be added.
  Eigen::Index best_addition(const Choice& choice, const Eigen::VectorXd& correlation) const {
    const auto others = std::count_if(choice.key_point.begin(), choice.key_point.end(),
                                      [&](Eigen::Index k) { return !is_anchor(k); });
    const bool full = std::size_t(others) + anchors_ >= entries_;
    double best_gain = 0;
    Eigen::Index best = -1;
    for (const Eigen::Index k : allowed_) {
      if (std::find(choice.key_point.begin(), choice.key_point.end(), k) != choice.key_point.end()) continue;
      if (full && !is_anchor(k)) continue;
      if (gram_(k, k) <= constant_variance) continue;
      double left = correlation[k];
      for (std::size_t s = 0; s < choice.key_point.size(); ++s)
        left -= gram_(k, choice.key_point[s]) * choice.weight[Eigen::Index(s)];
      if (left > 0 && left * left / gram_(k, k) > best_gain) {
        best_gain = left * left / gram_(k, k);
        best = k;
      }
    }
    return best;
  }

  // Solves with one more key point, and leaves out key points whose weights become 0.
  Choice with(const Choice& choice, Eigen::Index added, const Eigen::VectorXd& correlation) const {
    std::vector<Eigen::Index> trial = choice.key_point;
    trial.push_back(added);
    const Eigen::VectorXd c = correlation(trial);
    const Eigen::VectorXd x = solve_non_negative(gram_(trial, trial), c);
    Choice next;
    std::vector<double> kept;
    for (std::size_t s = 0; s < trial.size(); ++s) {
      if (x[Eigen::Index(s)] <= 0) continue;
      next.key_point.push_back(trial[s]);
      kept.push_back(x[Eigen::Index(s)]);
    }
    next.weight = Eigen::Map<Eigen::VectorXd>(kept.data(), Eigen::Index(kept.size()));
    next.explained = x.dot(c);
    return next;
  }

  const Eigen::MatrixXd& gram_;
  std::span<const std::uint16_t> allowed_;
  std::size_t anchors_, entries_;
};

LinearLayerFit empty_fit(std::size_t vertices, std::size_t entries) {
  LinearLayerFit fit;
  fit.entries = entries;
  fit.key_point.assign(vertices * entries, 0);
  fit.alpha.assign(vertices * entries, 0.0f);
  fit.floor.assign(vertices * entries, 0.0f);
  fit.bias.assign(vertices, 0.0f);
  return fit;
}

// Solves for one vertex, which is a column of the block, and writes its part of the fit.
void fit_vertex(std::size_t vertex, Eigen::Index column, const ShadowStatistics& shadows,
                const DarknessBlock& darkness, const Candidates& candidates,
                const LinearFitSettings& settings, LinearLayerFit& fit) {
  const std::size_t anchors =
      settings.anchor_floor > 0 ? std::min({settings.anchors, candidates.count, settings.entries}) : 0;
  const std::span allowed(&candidates.key_point[vertex * candidates.count], candidates.count);
  // We subtract the contribution of the anchors' minimum weights from the target, and solve for the remaining
  // weights >= 0.
  const std::vector<double> floor = anchor_floors(candidates, vertex, settings, anchors);
  Eigen::VectorXd correlation = darkness.correlation.col(column);
  for (std::size_t a = 0; a < anchors; ++a) correlation -= floor[a] * shadows.gram.col(allowed[a]);

  const double variance =
      double(darkness.centred.col(column).squaredNorm()) / double(darkness.centred.rows());
  const KeyPointChoice chooser(shadows.gram, allowed, anchors, settings.entries);
  Choice choice;
  if (variance > constant_variance) choice = chooser.run(correlation, settings.least_gain * variance);

  double bias = double(darkness.mean[column]);
  std::size_t entry = vertex * settings.entries;
  const auto store = [&](Eigen::Index k, double minimum) {
    const double weight = minimum + choice.weight_of(k);
    fit.key_point[entry] = std::uint16_t(k);
    fit.alpha[entry] = float(weight);
    fit.floor[entry] = float(minimum);
    bias -= weight * double(shadows.mean[k]);
    ++entry;
  };
  for (std::size_t a = 0; a < anchors; ++a) store(allowed[a], floor[a]);
  for (const Eigen::Index k : choice.key_point)
    if (!chooser.is_anchor(k)) store(k, 0);
  // An unused entry keeps a near key point at weight 0, so that mini-batches can still raise it.
  for (std::size_t next = anchors; entry < (vertex + 1) * settings.entries; ++next, ++entry)
    fit.key_point[entry] = allowed[std::min(next, candidates.count - 1)];
  fit.bias[vertex] = float(bias);
}

}  // namespace

LinearLayerFit fit_linear_layer(std::span<const float> shadows, std::size_t padded, const TrainingSet& set,
                                const Candidates& candidates, const LinearFitSettings& settings) {
  const std::size_t vertices = set.targets.vertex_count;
  const ShadowStatistics statistics = statistics_of(shadows, set.fitted(), padded, settings.ridge);
  LinearLayerFit fit = empty_fit(vertices, settings.entries);
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (vertices + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, count = std::min(block, vertices - first);
    const DarknessBlock darkness = darkness_of(set, statistics, first, count);
    for (std::size_t i = 0; i < count; ++i)
      fit_vertex(first + i, Eigen::Index(i), statistics, darkness, candidates, settings, fit);
  });
  return fit;
}

}  // namespace nook::bake
