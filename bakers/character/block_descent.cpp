#include "bakers/character/block_descent.h"

#include <LBFGS.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace nook::bake {
namespace {

// Number of poses in one task. Each task has its own sums. They are added in order afterwards, so that the
// number of threads does not change the bits.
constexpr std::size_t block_poses = 32;

// Returns the quadratic form of the shadows of one block (count x padded), without the constant term.
// Replaces the values in `shadow` by the gradient of the form with respect to the shadows.
double quadratic_form(const CachedObjective& cache, std::size_t first, std::size_t count, float* shadow) {
  const auto rows = Eigen::Index(count);
  Eigen::Map<CachedObjective::RowMatrix> x(shadow, rows, cache.a.rows());
  const auto b = cache.b.middleRows(Eigen::Index(first), rows);
  const CachedObjective::RowMatrix product = x * cache.a;
  double error = 0;
  for (Eigen::Index t = 0; t < rows; ++t)
    error += (product.row(t).cast<double>() - 2 * b.row(t).cast<double>()).dot(x.row(t).cast<double>());
  x = 2 * (product - b);
  return error;
}

}  // namespace

CachedObjective cache_linear_layer(const FitState& state, const TrainingSet& set) {
  const LinearLayerFit& linear = state.linear;
  const auto padded = Eigen::Index(state.structure.padded_count()), poses = Eigen::Index(set.fitted());
  CachedObjective cache;
  cache.a = Eigen::MatrixXf::Zero(padded, padded);
  cache.b = CachedObjective::RowMatrix::Zero(poses, padded);
  for (std::size_t i = 0; i < linear.vertex_count(); ++i)
    for (std::size_t s = i * linear.entries; s < (i + 1) * linear.entries; ++s)
      for (std::size_t r = i * linear.entries; r < (i + 1) * linear.entries; ++r)
        cache.a(linear.key_point[s], linear.key_point[r]) +=
            set.vertex_weight[i] * linear.alpha[s] * linear.alpha[r];
  std::vector<double> constant(set.fitted());
  tbb::parallel_for(std::size_t(0), set.fitted(), [&](std::size_t t) {
    const auto target = set.targets.row(t);
    for (std::size_t i = 0; i < linear.vertex_count(); ++i) {
      const float left = 1 - linear.bias[i] - float(target[i]) * AoTargets::scale;
      for (std::size_t s = i * linear.entries; s < (i + 1) * linear.entries; ++s)
        cache.b(Eigen::Index(t), linear.key_point[s]) += set.vertex_weight[i] * linear.alpha[s] * left;
      constant[t] += double(set.vertex_weight[i]) * double(left) * double(left);
    }
  });
  for (double c : constant) cache.constant += c;
  return cache;
}

double evaluate_cached(const FitState& state, const TrainingSet& set, const CachedObjective& cache,
                       std::vector<double>* gradient) {
  const std::size_t poses = set.fitted(), padded = state.structure.padded_count();
  const std::size_t blocks = (poses + block_poses - 1) / block_poses;
  const NonLinearLayer layer(state.structure);
  std::vector<double> error(blocks);
  std::vector<std::vector<float>> partial(blocks);
  tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
    const std::size_t first = b * block_poses, count = std::min(block_poses, poses - first);
    LayerWorkspace workspace(state.structure);
    std::vector<float> shadow(count * padded);
    for (std::size_t t = 0; t < count; ++t)
      layer.forward(set.poses[first + t], state.parameters, workspace, &shadow[t * padded]);
    error[b] = quadratic_form(cache, first, count, shadow.data());
    if (!gradient) return;
    partial[b].assign(state.parameters.size(), 0.0f);
    std::vector<float> again(padded);
    for (std::size_t t = 0; t < count; ++t) {
      // The workspace holds one pose. A second forward pass is cheaper than keeping workspaces for all poses.
      layer.forward(set.poses[first + t], state.parameters, workspace, again.data());
      layer.backward(set.poses[first + t], state.parameters, workspace, &shadow[t * padded], 1, partial[b]);
    }
  });
  double total = 0;
  for (double e : error) total += e;
  const double vertices = double(state.linear.vertex_count()), scale = 1 / (double(poses) * vertices);
  if (gradient) {
    gradient->assign(state.parameters.size(), 0.0);
    for (const std::vector<float>& p : partial)
      for (std::size_t i = 0; i < p.size(); ++i) (*gradient)[i] += double(p[i]) * scale;
  }
  return total * scale + cache.constant / (double(poses) * vertices);
}

double descend_non_linear(FitState& state, const TrainingSet& set, const LbfgsSettings& settings) {
  const CachedObjective cache = cache_linear_layer(state, set);
  const std::size_t count = state.parameters.size();
  std::vector<float> best = state.parameters;
  double best_error = evaluate_cached(state, set, cache, nullptr);

  LBFGSpp::LBFGSParam<double> param;
  param.m = settings.history;
  param.max_iterations = settings.iterations;
  param.epsilon = 1e-10;
  param.epsilon_rel = 1e-10;
  param.linesearch = LBFGSpp::LBFGS_LINESEARCH_BACKTRACKING_STRONG_WOLFE;
  LBFGSpp::LBFGSSolver<double, LBFGSpp::LineSearchNocedalWright> solver(param);

  std::vector<double> gradient;
  const auto objective = [&](const Eigen::VectorXd& x, Eigen::VectorXd& slope) {
    for (std::size_t i = 0; i < count; ++i) state.parameters[i] = float(x[Eigen::Index(i)]);
    const double error = evaluate_cached(state, set, cache, &gradient);
    slope = Eigen::Map<const Eigen::VectorXd>(gradient.data(), Eigen::Index(count));
    if (error < best_error) {
      best_error = error;
      best = state.parameters;
    }
    return error;
  };
  Eigen::VectorXd x(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) x[Eigen::Index(i)] = double(best[i]);
  double reached = 0;
  try {
    solver.minimize(objective, x, reached);
  } catch (const std::runtime_error&) {
    // If a line search finds no better point, the descent ends and keeps the best point so far.
  } catch (const std::logic_error&) {
  }
  state.parameters = best;
  return best_error;
}

}  // namespace nook::bake
