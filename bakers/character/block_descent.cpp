#include "bakers/character/block_descent.h"

#include <LBFGS.h>

#include <stdexcept>

#include "bakers/character/cached_objective.h"

namespace nook::bake {

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
    // A line search that finds no better point ends the block; the best point so far stands.
  } catch (const std::logic_error&) {
  }
  state.parameters = best;
  return best_error;
}

}  // namespace nook::bake
