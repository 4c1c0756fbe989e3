#include "bakers/character/linear_fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>

namespace nook::bake {
namespace {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Least weights of a vertex's anchors, by nearness.
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

// Non-negative least squares on the chosen key points by an active set: solves freely, drops the most
// negative weight until none is left. Chosen entries with weight 0 afterwards were dropped.
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

}  // namespace

LinearLayerFit fit_linear_layer(std::span<const float> shadows, std::size_t padded, const TrainingSet& set,
                                const Candidates& candidates, const LinearFitSettings& settings) {
  const std::size_t poses = set.fitted(), vertices = set.targets.vertex_count;
  const auto rows = Eigen::Index(poses), columns = Eigen::Index(padded);
  const Eigen::Map<const RowMatrix> all(shadows.data(), rows, columns);
  const Eigen::RowVectorXf mean = all.colwise().mean();
  const RowMatrix centred = all.rowwise() - mean;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns, columns);
  {
    // Blocks of rows in floats, summed in doubles: fast, and exact enough for a well-scaled Gram matrix.
    const Eigen::Index block = 256;
    for (Eigen::Index first = 0; first < rows; first += block) {
      const auto part = centred.middleRows(first, std::min(block, rows - first));
      gram += (part.transpose() * part).cast<double>();
    }
    gram /= double(poses);
  }
  const double ridge = settings.ridge * std::max(gram.diagonal().mean(), 1e-12);
  gram.diagonal().array() += ridge;

  LinearLayerFit fit;
  fit.entries = settings.entries;
  fit.key_point.assign(vertices * settings.entries, 0);
  fit.alpha.assign(vertices * settings.entries, 0.0f);
  fit.floor.assign(vertices * settings.entries, 0.0f);
  fit.bias.assign(vertices, 0.0f);
  const std::size_t anchors =
      settings.anchor_floor > 0 ? std::min({settings.anchors, candidates.count, settings.entries}) : 0;
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (vertices + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, last = std::min(vertices, first + block);
    RowMatrix darkness(rows, Eigen::Index(last - first));
    for (std::size_t t = 0; t < poses; ++t) {
      const auto target = set.targets.row(t);
      for (std::size_t i = first; i < last; ++i)
        darkness(Eigen::Index(t), Eigen::Index(i - first)) = 1 - float(target[i]) * AoTargets::scale;
    }
    const Eigen::RowVectorXf mean_darkness = darkness.colwise().mean();
    darkness.rowwise() -= mean_darkness;
    Eigen::MatrixXd correlation = (centred.transpose() * darkness).cast<double>() / double(poses);
    for (std::size_t i = first; i < last; ++i) {
      const auto column = Eigen::Index(i - first);
      const double variance = double(darkness.col(column).squaredNorm()) / double(poses);
      const std::uint16_t* allowed = &candidates.key_point[i * candidates.count];
      std::vector<Eigen::Index> chosen;
      Eigen::VectorXd weight;
      double explained = 0;
      // The anchors' least weights are taken off the target; what remains is solved with weights >= 0.
      const std::vector<double> floor = anchor_floors(candidates, i, settings, anchors);
      for (std::size_t a = 0; a < anchors; ++a) correlation.col(column) -= floor[a] * gram.col(allowed[a]);
      const auto is_anchor = [&](Eigen::Index k) {
        return std::find(allowed, allowed + anchors, k) != allowed + anchors;
      };
      const auto extra = [&](const std::vector<Eigen::Index>& list) {
        return std::size_t(
            std::count_if(list.begin(), list.end(), [&](Eigen::Index k) { return !is_anchor(k); }));
      };
      while (variance > 1e-8) {
        // The key point that would explain most of what is left, were it added alone.
        double best_gain = 0;
        Eigen::Index best = -1;
        for (std::size_t c = 0; c < candidates.count; ++c) {
          const Eigen::Index k = allowed[c];
          if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) continue;
          if (!is_anchor(k) && extra(chosen) + anchors >= settings.entries) continue;
          double left = correlation(k, column);
          for (std::size_t s = 0; s < chosen.size(); ++s)
            left -= gram(k, chosen[s]) * weight[Eigen::Index(s)];
          if (left > 0 && left * left / gram(k, k) > best_gain) {
            best_gain = left * left / gram(k, k);
            best = k;
          }
        }
        if (best < 0) break;
        std::vector<Eigen::Index> trial = chosen;
        trial.push_back(best);
        const Eigen::VectorXd c = correlation.col(column)(trial);
        const Eigen::VectorXd x = solve_non_negative(gram(trial, trial), c);
        const double gain = x.dot(c);
        if (gain - explained < settings.least_gain * variance) break;
        chosen.clear();
        std::vector<double> kept;
        for (std::size_t s = 0; s < trial.size(); ++s) {
          if (x[Eigen::Index(s)] <= 0) continue;
          chosen.push_back(trial[s]);
          kept.push_back(x[Eigen::Index(s)]);
        }
        weight = Eigen::Map<Eigen::VectorXd>(kept.data(), Eigen::Index(kept.size()));
        explained = gain;
      }
      double bias = double(mean_darkness[column]);
      std::size_t entry = i * settings.entries;
      const auto store = [&](Eigen::Index k, double least) {
        const auto found = std::find(chosen.begin(), chosen.end(), k);
        const double w = least + (found == chosen.end() ? 0 : weight[Eigen::Index(found - chosen.begin())]);
        fit.key_point[entry] = std::uint16_t(k);
        fit.alpha[entry] = float(w);
        fit.floor[entry] = float(least);
        bias -= w * double(mean[k]);
        ++entry;
      };
      for (std::size_t a = 0; a < anchors; ++a) store(allowed[a], floor[a]);
      for (Eigen::Index k : chosen)
        if (!is_anchor(k)) store(k, 0);
      // An unused entry keeps a near key point at weight 0, so that mini-batches may still wake it.
      for (std::size_t next = anchors; entry < (i + 1) * settings.entries; ++next, ++entry)
        fit.key_point[entry] = allowed[std::min(next, candidates.count - 1)];
      fit.bias[i] = float(bias);
    }
  });
  return fit;
}

}  // namespace nook::bake
