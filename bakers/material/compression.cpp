#include "bakers/material/compression.h"

#include <algorithm>

#include "bakers/material/btf_error.h"
#include "bakers/material/neural_training.h"
#include "bakers/material/raw_relief.h"
#include "bakers/material/view_spline.h"
#include "bakers/material/visibility_values.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/nsvd.h"
#include "bakers/tensor/resample.h"
#include "bakers/tensor/seed_clusters.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_check.h"

namespace nook::bake::material {
namespace {

using nook::material::ClusteredTensor;
using nook::material::Material;
using nook::material::VisibilityForm;
using tensor::Matrix;

tensor::TensorView btf_view(const RawMaterial& raw) {
  return {{raw.light_rows(), raw.views.size(), raw.width, raw.height}, raw.btf.data()};
}

tensor::TensorView votf_view(const RawMaterial& raw, const std::vector<float>& values) {
  return {{raw.views.size(), raw.width, raw.height}, values.data()};
}

Matrix as_rows(const std::vector<Vec3>& directions) {
  Matrix rows(Eigen::Index(directions.size()), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Vec3 d = directions[std::size_t(i)];
    rows.row(i) << d.x, d.y, d.z;
  }
  return rows;
}

// The settings for fitting a tensor. Its clustered mode is the view mode.
struct FitTask {
  const RawMaterial& raw;
  tensor::TensorView values;
  std::size_t view_mode;
  std::vector<std::size_t> ranks;  // one for each mode; for the view mode, the total over all clusters
  tensor::Pursuit pursuit;         // only used by K-CTA
  const CompressionSettings& settings;
  const StageProgress& progress;
  const char* stage;
};

tensor::ClusteredFit fit_n_svd(const FitTask& task) {
  tensor::NsvdSettings settings;
  settings.ranks = task.ranks;
  const std::size_t modes = task.ranks.size();
  const auto progress = [&](const tensor::NsvdProgress& now) {
    return !task.progress || task.progress(task.stage, std::size_t(now.sweep) * modes + now.mode,
                                           std::size_t(now.sweeps + 1) * modes);
  };
  return tensor::as_one_cluster(tensor::fit_nsvd(task.values, settings, progress), task.view_mode);
}

tensor::ClusteredFit fit_clusters(const FitTask& task) {
  const CompressionSettings& s = task.settings;
  tensor::ClusteredSettings settings;
  settings.mode = task.view_mode;
  settings.ranks = task.ranks;
  settings.ranks[task.view_mode] = s.cluster_rank_view;
  settings.clusters = s.cluster_count();
  settings.mixture = s.method == Method::cta ? 1 : s.mixture;
  settings.pursuit = task.pursuit;
  if (task.view_mode > 0) settings.global_modes = {0};
  const Matrix points = s.seeding == Seeding::directions
                            ? as_rows(task.raw.views)
                            : tensor::sub_tensor_points(task.values, task.view_mode);
  settings.seeds = tensor::seed_clusters(points, settings.clusters, s.seed);
  const auto progress = [&](const tensor::ClusteredProgress& now) {
    return !task.progress ||
           task.progress(task.stage, std::size_t(now.iteration) * settings.clusters + now.cluster,
                         std::size_t(now.iterations + 1) * settings.clusters);
  };
  return s.method == Method::cta ? tensor::fit_cta(task.values, settings, progress)
                                 : tensor::fit_k_cta(task.values, settings, progress);
}

void append(Vector<float>& to, const Matrix& matrix) {
  to.insert(to.end(), matrix.data(), matrix.data() + matrix.size());
}

nook::material::ViewRows view_rows(const tensor::Mixture& mixture) {
  nook::material::ViewRows rows;
  for (const std::uint32_t c : mixture.membership) rows.membership.push_back(std::uint16_t(c));
  append(rows.coefficients, mixture.coefficients);
  return rows;
}

ClusteredTensor as_clustered_tensor(const tensor::ClusteredFit& fit) {
  const std::size_t view = fit.mode, x = view + 1, y = view + 2;
  ClusteredTensor t;
  t.shape.views = std::uint32_t(fit.dimensions[view]);
  t.shape.width = std::uint32_t(fit.dimensions[x]);
  t.shape.height = std::uint32_t(fit.dimensions[y]);
  t.shape.rank_light = view > 0 ? std::uint32_t(fit.ranks[0]) : 1;
  t.shape.rank_view = std::uint32_t(fit.ranks[view]);
  t.shape.rank_x = std::uint32_t(fit.ranks[x]);
  t.shape.rank_y = std::uint32_t(fit.ranks[y]);
  t.shape.clusters = std::uint32_t(fit.clusters.size());
  t.shape.mixture = std::uint32_t(fit.mixture.count);
  for (const auto& cluster : fit.clusters) {
    t.cores.insert(t.cores.end(), cluster.core.data.begin(), cluster.core.data.end());
    append(t.x_bases, cluster.basis[x]);
    append(t.y_bases, cluster.basis[y]);
  }
  t.rows = view_rows(fit.mixture);
  return t;
}

// Returns the light basis of a fitted BTF. With several clusters, all clusters share this basis. For an
// N-SVD, it is the basis of the only cluster.
std::vector<float> light_basis_of(const tensor::ClusteredFit& fit) {
  const Matrix& own = fit.clusters[0].basis.empty() ? fit.global_basis[0] : fit.clusters[0].basis[0];
  const Matrix& basis = fit.global_basis[0].size() > 0 ? fit.global_basis[0] : own;
  const auto rows = Eigen::Index(fit.dimensions[0]);
  const Matrix full = basis.size() > 0 ? basis : Matrix(Matrix::Identity(rows, rows));
  return {full.data(), full.data() + full.size()};
}

tensor::ClusteredFit fit(const FitTask& task) {
  if (task.progress && !task.progress(task.stage, 0, 1)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
  return task.settings.method == Method::n_svd ? fit_n_svd(task) : fit_clusters(task);
}

ClusteredTensor with_map(const tensor::ClusteredFit& fitted, const FitTask& task) {
  ClusteredTensor t = as_clustered_tensor(fitted);
  const std::uint32_t side = task.settings.made_map_side();
  if (side == 0) return t;
  if (task.progress && !task.progress("view map", 0, 1)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
  const Matrix projections = tensor::atom_projections(fitted, task.values);
  t.map.side = side;
  // The VOTF has no step penalty, because errors of its mask depend on the threshold and not on the steps
  // between neighbouring views.
  const double penalty = task.view_mode > 0 ? task.settings.step_penalty : 0;
  const auto progress = [&](std::size_t round, std::size_t rounds) {
    return !task.progress || task.progress("view map", round, rounds);
  };
  t.map.rows = view_rows(tensor::resample_map(fitted, projections, spline_weights(task.raw.views, side), side,
                                              penalty, tensor::Pursuit::exchange, progress));
  return t;
}

}  // namespace

CompressedBtf compress_btf(const RawMaterial& raw, const CompressionSettings& s,
                           const StageProgress& progress) {
  check_settings(s, raw);
  const FitTask task{
      raw, btf_view(raw), 1,    {s.rank_light, s.rank_view, s.rank_x, s.rank_y}, tensor::Pursuit::greedy,
      s,   progress,      "BTF"};
  const tensor::ClusteredFit fitted = fit(task);
  return {light_basis_of(fitted), with_map(fitted, task), int(fitted.objective.size()) - 1};
}

ClusteredTensor compress_votf(const RawMaterial& raw, const std::vector<float>& values,
                              const CompressionSettings& s, const StageProgress& progress) {
  check_settings(s, raw);
  // Uses the more thorough search, which is fast for this small tensor. On fiber, it reduces the number of
  // wrong texels by a fifth. The BTF does not gain from this search.
  FitTask task{raw,
               votf_view(raw, values),
               0,
               {s.rank_view, s.votf_rank_x, s.votf_rank_y},
               tensor::Pursuit::exchange,
               s,
               progress,
               "VOTF"};
  tensor::ClusteredFit fitted = fit(task);
  const float threshold = s.visibility == VisibilityForm::binary ? 0.5f : 0.0f;
  std::vector<float> targets;
  for (std::uint32_t refit = 0; refit < s.votf_refits; ++refit) {
    targets = margin_targets(values, tensor::reconstruct(fitted).data, threshold);
    task.values = votf_view(raw, targets);
    fitted = fit(task);
  }
  return with_map(fitted, task);
}

std::vector<float> votf_values(const RawMaterial& raw, VisibilityForm form) {
  return form == VisibilityForm::binary ? raw.mask : signed_distances(raw.mask, raw.width, raw.height);
}

namespace {

ReliefProgress stage(const StageProgress& progress, const char* name) {
  return [&progress, name](std::size_t done, std::size_t total) {
    return !progress || progress(name, done, total);
  };
}

nook::material::Relief relief_from(const RawMaterial& raw, ReliefSource source,
                                   const StageProgress& progress) {
  switch (source) {
    case ReliefSource::estimated:
      return estimate_relief(raw, stage(progress, "relief"));
    case ReliefSource::known:
      return known_relief(raw, stage(progress, "relief"));
    case ReliefSource::none:
      break;
  }
  return nook::material::Relief();
}

nook::material::Neural neural_of(const RawMaterial& raw, const CompressionSettings& s,
                                 const StageProgress& progress) {
  NeuralSettings settings;
  settings.shape.channels = s.neural_channels;
  settings.offset_steps =
      std::uint32_t(std::uint64_t(s.neural_steps) * settings.offset_steps / settings.steps);
  settings.steps = s.neural_steps;
  settings.seed = s.seed;
  return encoded(fit_neural_tile(raw, settings, progress));
}

void add_btf(const RawMaterial& raw, const MovedMaterial& moved, const CompressionSettings& s,
             const StageProgress& progress, Material& material) {
  material.relief = moved.relief;
  CompressedBtf btf = compress_btf(moved.or_still(raw), s, progress);
  material.light_basis.assign(btf.light_basis.begin(), btf.light_basis.end());
  material.btf = std::move(btf.tensor);
}

}  // namespace

MovedMaterial move_views(const RawMaterial& raw, ReliefSource source, const StageProgress& progress) {
  MovedMaterial moved;
  moved.relief = relief_from(raw, source, progress);
  if (!moved.relief.moves()) return moved;
  moved.raw = raw;
  move_to_relief(raw, moved.relief, moved.raw.btf, stage(progress, "views on the relief"));
  return moved;
}

Material compress(const RawMaterial& raw, const CompressionSettings& s, const StageProgress& progress) {
  check_settings(s, raw);
  return compress_moved(raw, move_views(raw, s.relief, progress), s, progress);
}

Material compress_moved(const RawMaterial& raw, const MovedMaterial& moved, const CompressionSettings& s,
                        const StageProgress& progress) {
  Material material;
  material.bits = s.bits;
  material.lights.assign(raw.lights.begin(), raw.lights.end());
  material.views.assign(raw.views.begin(), raw.views.end());
  check_settings(s, raw);
  if (s.method == Method::neural)
    material.neural = neural_of(raw, s, progress);
  else
    add_btf(raw, moved, s, progress, material);
  if (!has_votf(raw, s)) return material;
  material.visibility = s.visibility;
  material.mapping = s.mapping ? *s.mapping : default_mapping(s.visibility, raw.width, raw.height);
  material.votf = compress_votf(raw, votf_values(raw, s.visibility), votf_settings(s), progress);
  return material;
}

void set_core_rounding(const RawMaterial& raw, nook::material::Material& material) {
  if (material.bits == 16 || material.neural.is_used()) return;
  constexpr double added = 0.01, least = 0x1p-30, largest = 0x1p-7;
  const BtfError error = measure_btf(raw, material);
  const double share =
      error.squared_signal > 0 ? added * error.squared_error / error.squared_signal : largest;
  material.core_rounding = float(std::clamp(share, least, largest));
}

CompressionSettings ranks_by_threshold(const RawMaterial& raw, double share, CompressionSettings s) {
  const auto btf = tensor::ranks_for_error(btf_view(raw), std::vector<double>(4, share));
  s.rank_light = std::uint32_t(btf[0]);
  s.rank_view = std::uint32_t(btf[1]);
  s.rank_x = std::uint32_t(btf[2]);
  s.rank_y = std::uint32_t(btf[3]);
  if (!has_votf(raw, s)) return s;
  const std::vector<float> values = votf_values(raw, s.visibility);
  const auto votf = tensor::ranks_for_error(votf_view(raw, values), std::vector<double>(3, share));
  s.votf_rank_x = std::uint32_t(votf[1]);
  s.votf_rank_y = std::uint32_t(votf[2]);
  return s;
}

}  // namespace nook::bake::material
