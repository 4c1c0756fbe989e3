#include "bakers/measure/character/baseline.h"

#include <tbb/parallel_for.h>

#include <numeric>

#include "bakers/measure/character/evaluate.h"

namespace nook::bake {

RegressionError measure_regression(const PoseRegression& regression, std::span<const Pose> poses,
                                   const AoTargets& targets, std::span<const float> vertex_area) {
  // One partial sum a pose, added up in order: the same bits on any number of threads.
  std::vector<RegressionError> partial(poses.size());
  std::vector<std::size_t> visible(poses.size(), 0);
  tbb::parallel_for(std::size_t(0), poses.size(), [&](std::size_t t) {
    const std::vector<float> ao = regression.predict(poses[t]);
    const auto row = targets.row(t);
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double truth = double(row[i]) * double(AoTargets::scale), e = double(ao[i]) - truth;
      partial[t].mse += e * e;
      if (truth >= visible_truth) {
        partial[t].mse_visible += e * e;
        ++visible[t];
      }
      partial[t].mse_area += e * e * double(vertex_area[i]);
    }
  });
  double area = 0;
  for (float a : vertex_area) area += double(a);
  RegressionError total;
  for (const RegressionError& p : partial) {
    total.mse += p.mse;
    total.mse_visible += p.mse_visible;
    total.mse_area += p.mse_area;
  }
  total.mse /= double(poses.size()) * double(vertex_area.size());
  const std::size_t visible_count = std::accumulate(visible.begin(), visible.end(), std::size_t(0));
  if (visible_count > 0) total.mse_visible /= double(visible_count);
  total.mse_area /= double(poses.size()) * area;
  return total;
}

}  // namespace nook::bake
