#include "bakers/transfer/paper_bake.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/seed_clusters.h"
#include "bakers/transfer/inter_reflections.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/reflectance.h"

namespace nook::bake::transfer {

void light_matrix(const MatrixSource& source, std::uint32_t lobes, std::size_t vertex,
                  MatrixWorkspace& work) {
  const std::size_t modes = std::size_t(3) * source.tables.btf.light_modes;
  const nook::transfer::Frame frame = frame_of(source.mesh, vertex);
  const Vec3 side = frame.bitangent();
  work.basis.resize(modes);
  work.matrix.setZero(Eigen::Index(lobes), Eigen::Index(modes));
  work.visible.clear();
  visible_directions(source.scene,
                     source.mesh.position[vertex] + source.mesh.normal[vertex] * source.origin_offset,
                     source.mesh.normal[vertex], source.cells.direction, source.holes, work.visible);
  const Eigen::Map<const Eigen::RowVectorXf> basis(work.basis.data(), Eigen::Index(modes));
  for (const auto& [i, share] : work.visible) {
    const Vec3 d = source.cells.direction[i];
    light_basis_at(source.tables, {dot(frame.tangent, d), dot(side, d), dot(frame.normal, d)}, work.basis);
    for (std::uint32_t k = source.lobes.begin[i]; k < source.lobes.begin[i + 1]; ++k)
      work.matrix.row(Eigen::Index(source.lobes.lobe[k])) += basis * (share * source.lobes.weight[k]);
  }
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using nook::transfer::CubeCells;
using nook::transfer::PaperTransfer;
using nook::transfer::Transfer;
using tensor::Matrix;

constexpr std::size_t most_samples = 768;    // vertices that the common combinations of lobes are chosen from
constexpr std::size_t seed_vertices = 4096;  // vertices that the first clusters are chosen from
constexpr Index seed_axes = 24;

// Lobes overlap, so a least-squares fit gives neighbouring lobes amplitudes of opposite signs, which mostly
// cancel. We therefore weight the error of a matrix T by its visible effect under typical light l.
// LightMetric is the factor C of the second moment of light: S = E[l l^T] = C C^T. Then |C^T T| is the root
// mean square of |T^T l|.
struct LightMetric {
  MatrixXd root, inverse_transpose;  // C and C^-T
};

// We expect light with no preferred direction. As in natural maps, its power in each band is proportional to
// (band + 1)^-decay (R. Dror, A. Willsky, E. Adelson: Statistical Characterization of Real-World
// Illumination, 2004).
LightMetric light_metric(std::uint32_t lobes) {
  const double sharpness = double(nook::transfer::sharpness_of(lobes));
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  constexpr double decay = 2;
  // The zonal coefficients of a lobe fall off like a normal distribution.
  const auto bands = Index(std::ceil(3 * std::sqrt(sharpness))) + 2;
  std::vector<double> power;
  for (Index l = 0; l <= bands; ++l) {
    const double band = std::exp(-double(l * (l + 1)) / (2 * sharpness)) * gaussian_integral(sharpness);
    power.push_back(std::pow(double(l + 1), -decay) * double(2 * l + 1) / (4 * 3.14159265358979) * band *
                    band);
  }
  MatrixXd gram{Index(lobes), Index(lobes)}, moments{Index(lobes), Index(lobes)};
  for (Index i = 0; i < Index(lobes); ++i)
    for (Index j = 0; j <= i; ++j) {
      const double apart = double(one_minus_cosine(axes[std::size_t(i)], axes[std::size_t(j)])),
                   x = 1 - apart;
      gram(i, j) = gram(j, i) = gaussian_product_integral(sharpness, sharpness, apart);
      double sum = 0, before = 1, now = x;
      for (Index l = 0; l <= bands; ++l) {  // Legendre polynomials
        sum += power[std::size_t(l)] * (l == 0 ? 1 : now);
        if (l == 0) continue;
        const double next = (double(2 * l + 1) * x * now - double(l) * before) / double(l + 1);
        before = now;
        now = next;
      }
      moments(i, j) = moments(j, i) = sum;
    }
  // Since S = G^-1 M G^-1, C = G^-1 M^(1/2).
  moments.diagonal().array() *= 1 + 1e-6;
  const MatrixXd half = moments.llt().matrixL();
  const MatrixXd identity = MatrixXd::Identity(Index(lobes), Index(lobes));
  return {gram.llt().solve(half), gram * half.transpose().triangularView<Eigen::Upper>().solve(identity)};
}

// The common combinations of lobes. X = project * T approximates C^T T in a smaller basis, and expand * X
// approximates T.
struct CommonBasis {
  Matrix project;   // common rank x lobes
  MatrixXd expand;  // lobes x common rank
};

CommonBasis common_basis(const LightMetric& metric, const MatrixXd& sum, std::size_t rank) {
  const MatrixXd whole = metric.root.transpose() * sum * metric.root;
  const MatrixXd basis = tensor::leading_eigenvectors(whole, rank).cast<double>();
  CommonBasis out;
  out.project = (basis.transpose() * metric.root.transpose()).cast<float>();
  out.expand = metric.inverse_transpose * basis;
  return out;
}

// Returns the step between the vertices that the first clusters are chosen from.
Index seed_step(Index count) {
  return std::max<Index>(count / Index(seed_vertices), 1);
}

// Counts the rows of these vertices that differ in their norm, up to `enough`. There cannot be more clusters
// than distinct rows.
std::size_t distinct_rows(const Eigen::Map<const Matrix>& rows, std::size_t enough) {
  std::set<float> norms;
  for (Index i = 0; i < rows.rows() && norms.size() < enough; i += seed_step(rows.rows()))
    norms.insert(rows.row(i).squaredNorm());
  return norms.size();
}

// Makes the first clusters by k-means of the vertices' matrices on their leading axes.
std::vector<std::uint32_t> first_clusters(const Eigen::Map<const Matrix>& rows, std::size_t clusters,
                                          std::uint64_t seed) {
  const Index count = rows.rows(), stride = std::max<Index>(count / 1024, 1);
  Matrix some((count + stride - 1) / stride, rows.cols());
  for (Index i = 0; i < some.rows(); ++i) some.row(i) = rows.row(i * stride);
  const MatrixXd gram = (some * some.transpose()).cast<double>();
  const Index axes = std::min<Index>(seed_axes, some.rows());
  const Matrix axis = tensor::leading_eigenvectors(gram, std::size_t(axes)).transpose() * some;
  Matrix points = rows * axis.transpose();
  for (Index a = 0; a < axes; ++a) points.col(a) /= std::max(axis.row(a).norm(), 1e-20f);
  const Index step = seed_step(count);
  Matrix chosen((count + step - 1) / step, axes);
  for (Index i = 0; i < chosen.rows(); ++i) chosen.row(i) = points.row(i * step);
  const std::vector<std::uint32_t> group = tensor::seed_clusters(chosen, clusters, seed);
  Matrix means = Matrix::Zero(Index(clusters), axes);
  Eigen::VectorXf members = Eigen::VectorXf::Zero(Index(clusters));
  for (Index i = 0; i < chosen.rows(); ++i) {
    means.row(Index(group[std::size_t(i)])) += chosen.row(i);
    members[Index(group[std::size_t(i)])] += 1;
  }
  for (Index c = 0; c < Index(clusters); ++c) means.row(c) /= members[c];
  std::vector<std::uint32_t> out(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) {
    Index nearest = 0;
    (means.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    out[std::size_t(i)] = std::uint32_t(nearest);
  }
  // The vertices that the clusters were chosen from keep their groups, so that no group is empty.
  for (Index i = 0; i < chosen.rows(); ++i) out[std::size_t(i * step)] = group[std::size_t(i)];
  return out;
}

std::uint16_t finite_half(double value) {
  return to_half(float(std::clamp(value, -65504.0, 65504.0)));
}

// Packs the parts of a fit as half floats. Each column of a lobe basis is scaled so that its largest number
// is 1, and the cores absorb the factor. All cores have one common scale, which makes their largest number
// 2^12.
PaperTransfer packed(const tensor::ClusteredFit& fit, const MatrixXd& expand, std::uint32_t light_modes) {
  PaperTransfer paper;
  const auto vertex_rank = Index(fit.ranks[0]), lobe_rank = Index(fit.ranks[1]),
             modes = Index(3 * light_modes);
  paper.light_modes = light_modes;
  paper.clusters = std::uint32_t(fit.clusters.size());
  paper.lobe_rank = std::uint32_t(lobe_rank);
  paper.vertex_rank = std::uint32_t(vertex_rank);
  std::vector<double> cores;
  for (const tensor::ClusteredFit::Cluster& cluster : fit.clusters) {
    const Matrix& local = cluster.basis[1];
    MatrixXd basis = local.size() == 0 ? expand : MatrixXd(expand * local.cast<double>());
    const Eigen::VectorXd size = basis.cwiseAbs().colwise().maxCoeff().transpose().cwiseMax(1e-30);
    for (Index j = 0; j < basis.rows(); ++j)
      for (Index k = 0; k < lobe_rank; ++k) paper.lobe_basis.push_back(finite_half(basis(j, k) / size[k]));
    for (Index i = 0; i < modes; ++i)
      for (Index q = 0; q < vertex_rank; ++q)
        for (Index k = 0; k < lobe_rank; ++k)
          cores.push_back(double(cluster.core.data[std::size_t((q * lobe_rank + k) * modes + i)]) * size[k]);
  }
  double largest = 0;
  for (const double value : cores) largest = std::max(largest, std::abs(value));
  const double scale = largest > 0 ? std::exp2(std::ceil(std::log2(largest)) - 12) : 1;
  paper.scale = float(scale);
  for (const double value : cores) paper.cores.push_back(finite_half(value / scale));
  for (std::size_t v = 0; v < fit.mixture.membership.size(); ++v) {
    paper.cluster.push_back(std::uint8_t(fit.mixture.membership[v]));
    for (Index q = 0; q < vertex_rank; ++q)
      paper.coefficients.push_back(finite_half(double(fit.mixture.coefficients(Index(v), q))));
  }
  return paper;
}

void need(std::uint32_t got, std::uint32_t low, std::uint32_t high, const char* what) {
  if (got < low || got > high)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %u, need %u to %u)", what, got, low,
                  high);
}

}  // namespace

void check_paper_bake(const SurfaceMesh& mesh, const PaperSettings& paper) {
  const auto count = std::uint32_t(mesh.position.size());
  need(paper.clusters, 0, std::min(nook::transfer::max_clusters, count), "the number of clusters");
  need(paper.lobe_rank, 1, nook::transfer::max_lobe_rank, "the rank of lobes");
  need(paper.vertex_rank, 1, std::min(nook::transfer::max_vertex_rank, count), "the rank of vertices");
  need(paper.common_rank, paper.lobe_rank, nook::transfer::max_lobes, "the common rank of lobes");
  need(paper.iterations, 0, 1000, "the number of iterations");
}

Transfer bake_paper(const SurfaceMesh& mesh, const BakeSettings& settings, const PaperSettings& paper,
                    const nook::material::MaterialTables& tables, const Progress& progress,
                    const Progress& fitted) {
  nook::material::refuse_neural(tables.neural.is_used(), "the paper's form of radiance transfer");
  check_bake(mesh, settings);
  check_paper_bake(mesh, paper);
  const std::size_t count = mesh.position.size(), modes = std::size_t(3) * tables.btf.light_modes;
  const CubeCells cells(settings.side);
  const LobesOfDirections lobes = lobes_of(cells, settings.lobes);
  const RayScene scene({mesh.position, mesh.triangle});
  const auto holes = surface_holes(mesh, settings.holes.get(), settings.tiles, cells.size());
  const MatrixSource source{
      mesh, scene, cells, lobes, tables, holes ? &*holes : nullptr, ray_origin_offset(mesh.position)};
  Transfer transfer;
  transfer.lobes = settings.lobes;
  transfer.hashes = hashes_of(mesh);
  if (settings.holes) transfer.votf_hash = settings.holes->votf_hash;

  // Finds the common basis from a sample of the vertices. Then reduces all vertices.
  const std::size_t stride = (count + most_samples - 1) / most_samples,
                    samples = (count + stride - 1) / stride;
  VertexLoop loop(samples + count * (1 + settings.bounces), progress);
  const std::size_t common = std::min<std::size_t>(paper.common_rank, settings.lobes);
  const CommonBasis basis = [&] {
    const auto size = Index(settings.lobes);
    std::vector<MatrixXd> sums((samples + VertexLoop::block - 1) / VertexLoop::block,
                               MatrixXd::Zero(size, size));
    loop.run<MatrixWorkspace>(samples, [&](std::size_t s, MatrixWorkspace& work) {
      light_matrix(source, settings.lobes, s * stride, work);
      sums[s / VertexLoop::block] += (work.matrix * work.matrix.transpose()).cast<double>();
    });
    MatrixXd sum = MatrixXd::Zero(size, size);
    for (const MatrixXd& part : sums) sum += part;
    return common_basis(light_metric(settings.lobes), sum, common);
  }();
  tensor::Tensor reduced({count, common, modes});
  std::vector<IrradianceBands> received(settings.bounces > 0 ? count : 0);
  loop.run<MatrixWorkspace>(count, [&](std::size_t v, MatrixWorkspace& work) {
    light_matrix(source, settings.lobes, v, work);
    Eigen::Map<Matrix>(&reduced.data[v * common * modes], Index(common), Index(modes)).noalias() =
        basis.project * work.matrix;
    if (!received.empty()) received[v] = direct_irradiance(mesh.normal[v], cells, work.visible);
  });
  reflect({mesh, scene, source.origin_offset, cells, source.holes}, settings.bounces, loop,
          std::move(received), transfer);

  tensor::ClusteredSettings fit;
  const Eigen::Map<const Matrix> rows(reduced.data.data(), Index(count), Index(common * modes));
  const std::size_t wanted =
      paper.clusters > 0 ? paper.clusters
                         : std::clamp<std::size_t>((count + 180) / 360, 1, nook::transfer::max_clusters);
  fit.clusters = std::max<std::size_t>(distinct_rows(rows, wanted), 1);
  fit.ranks = {std::min<std::size_t>(paper.vertex_rank, count),
               std::min<std::size_t>(paper.lobe_rank, common), modes};
  fit.seeds = first_clusters(rows, fit.clusters, paper.seed);
  fit.nearest = paper.nearest;
  fit.iterations = int(paper.iterations);
  const std::size_t steps = (fit.iterations + std::size_t(1)) * fit.clusters;
  const auto on_fit = [&](const tensor::ClusteredProgress& at) {
    return !fitted || fitted(std::size_t(at.iteration) * fit.clusters + at.cluster, steps);
  };
  const tensor::ClusteredFit result = tensor::fit_cta(reduced, fit, on_fit);
  transfer.paper = packed(result, basis.expand, tables.btf.light_modes);
  transfer.paper.light_hash = tables.light_hash;
  return transfer;
}

}  // namespace nook::bake::transfer
