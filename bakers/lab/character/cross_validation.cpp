#include "bakers/lab/character/cross_validation.h"

#include <algorithm>

namespace nook::lab {

using namespace bake;

std::vector<ValidationFold> validation_folds(std::size_t poses, std::size_t folds, std::size_t runs_a_fold) {
  const std::size_t runs = std::min(folds * runs_a_fold, poses);
  std::vector<ValidationFold> result(std::min(folds, std::max<std::size_t>(runs, 1)));
  for (std::size_t t = 0; t < poses; ++t) {
    const std::size_t fold = t * runs / poses % result.size();
    for (std::size_t f = 0; f < result.size(); ++f)
      (f == fold ? result[f].left_out : result[f].fitted).push_back(Eigen::Index(t));
  }
  return result;
}

std::vector<std::size_t> sample_vertices(std::size_t vertex_count, std::size_t count) {
  count = std::min(count, vertex_count);
  std::vector<std::size_t> vertices(count);
  for (std::size_t i = 0; i < count; ++i) vertices[i] = i * vertex_count / count;
  return vertices;
}

BaselineMatrix target_columns(const AoTargets& targets, const std::vector<std::size_t>& vertices) {
  BaselineMatrix columns(Eigen::Index(targets.pose_count()), Eigen::Index(vertices.size()));
  for (std::size_t t = 0; t < targets.pose_count(); ++t)
    for (std::size_t i = 0; i < vertices.size(); ++i)
      columns(Eigen::Index(t), Eigen::Index(i)) = float(targets.row(t)[vertices[i]]) * AoTargets::scale;
  return columns;
}

BaselineMatrix target_columns(const AoTargets& targets, std::size_t first, std::size_t last) {
  BaselineMatrix columns(Eigen::Index(targets.pose_count()), Eigen::Index(last - first));
  for (std::size_t t = 0; t < targets.pose_count(); ++t)
    for (std::size_t i = first; i < last; ++i)
      columns(Eigen::Index(t), Eigen::Index(i - first)) = float(targets.row(t)[i]) * AoTargets::scale;
  return columns;
}

double clamped_squared_error(const BaselineMatrix& prediction, const BaselineMatrix& target) {
  return (prediction.array().max(0.0f).min(1.0f) - target.array()).square().cast<double>().sum();
}

std::size_t smallest_near_best(const std::vector<SizedError>& candidates, double slack) {
  double least = candidates.front().error;
  for (const SizedError& c : candidates) least = std::min(least, c.error);
  std::size_t best = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].error > least * (1 + slack)) continue;
    if (best == candidates.size() || candidates[i].bytes < candidates[best].bytes) best = i;
  }
  return best;
}

void round_to_half(BaselineMatrix& values) {
  values = values.cast<Eigen::half>().cast<float>().eval();
}

}  // namespace nook::lab
