#include "bakers/tensor/clustered_fit.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <set>

#include "bakers/tensor/resample.h"
#include "bakers/tensor/seed_clusters.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::tensor;
using Eigen::Index;

namespace {

ClusteredSettings settings_of(std::size_t mode, std::vector<std::size_t> ranks, std::size_t clusters,
                              std::size_t mixture, std::vector<std::uint32_t> seeds) {
  ClusteredSettings settings;
  settings.mode = mode;
  settings.ranks = std::move(ranks);
  settings.clusters = clusters;
  settings.mixture = mixture;
  settings.seeds = std::move(seeds);
  return settings;
}

std::vector<std::uint32_t> seeds_round(std::size_t count, std::size_t clusters) {
  std::vector<std::uint32_t> seeds(count);
  for (std::size_t i = 0; i < count; ++i) seeds[i] = std::uint32_t(i % clusters);
  return seeds;
}

// The mixing matrix U_{m,c}.
Matrix mixing(const ClusteredFit& fit, std::uint32_t c) {
  const Index rank = Index(fit.ranks[fit.mode]), k = Index(fit.mixture.count);
  Matrix u = Matrix::Zero(Index(fit.dimensions[fit.mode]), rank);
  for (Index i = 0; i < u.rows(); ++i)
    for (Index j = 0; j < k; ++j)
      if (fit.mixture.membership[std::size_t(i * k + j)] == c)
        u.row(i) = fit.mixture.coefficients.block(i, j * rank, 1, rank);
  return u;
}

void check_orthonormal(const Matrix& u) {
  const Matrix identity = Matrix::Identity(u.cols(), u.cols());
  CHECK((u.transpose() * u - identity).norm() < 1e-5);  // vectors rounded to floats
}

// The constraints of (8), for clusters of at least R_m members.
void check_constraints(const ClusteredFit& fit, std::size_t k) {
  const std::size_t sub_tensors = fit.dimensions[fit.mode];
  REQUIRE(fit.mixture.count == k);
  REQUIRE(fit.mixture.membership.size() == sub_tensors * k);
  REQUIRE(std::size_t(fit.mixture.coefficients.cols()) == k * fit.ranks[fit.mode]);
  for (std::size_t i = 0; i < sub_tensors; ++i) {
    const auto first = fit.mixture.membership.begin() + std::ptrdiff_t(i * k);
    const std::set<std::uint32_t> different(first, first + std::ptrdiff_t(k));
    CHECK(different.size() == k);
    CHECK(*different.rbegin() < fit.clusters.size());
  }
  for (std::uint32_t c = 0; c < fit.clusters.size(); ++c) {
    check_orthonormal(mixing(fit, c));
    for (const Matrix& u : fit.clusters[c].basis)
      if (u.size() > 0) check_orthonormal(u);
  }
  for (const Matrix& u : fit.global_basis)
    if (u.size() > 0) check_orthonormal(u);
}

void check_objective(const ClusteredFit& fit, const Tensor& a) {
  for (std::size_t n = 1; n < fit.objective.size(); ++n) CHECK(fit.objective[n] <= fit.objective[n - 1]);
  // The error is a difference of norms where a mode is reduced: 1e-6 of || A ||^2 are its rounding.
  CHECK(std::abs(squared_distance(reconstruct(fit), a) - fit.objective.back()) <
        1e-5 * fit.objective.back() + 1e-6 * squared_norm(a));
}

// Waves whose direction and phase turn with the index of the second mode, so that neighbours resemble each
// other and no small rank holds them all.
Tensor waves(const Dimensions& dimensions) {
  Tensor a(dimensions);
  std::size_t e = 0;
  for (std::size_t l = 0; l < dimensions[0]; ++l)
    for (std::size_t v = 0; v < dimensions[1]; ++v)
      for (std::size_t x = 0; x < dimensions[2]; ++x)
        for (std::size_t y = 0; y < dimensions[3]; ++y, ++e) {
          const double turn = 6.28 * double(v) / double(dimensions[1]);
          const double wave =
              std::sin(double(x) * std::cos(turn) + double(y) * std::sin(turn) + 0.3 * double(l));
          a.data[e] = float(0.5 + std::max(0.0, wave) * (1 + 0.1 * double(l)));
        }
  return a;
}

std::vector<std::uint32_t> seeds_in_order(std::size_t count, std::size_t clusters) {
  std::vector<std::uint32_t> seeds(count);
  for (std::size_t i = 0; i < count; ++i) seeds[i] = std::uint32_t(i * clusters / count);
  return seeds;
}

}  // namespace

TEST_CASE("CTA recovers planted clusters from seeds where a third is wrong") {
  const test::Planted planted = test::planted_clusters({5, 24, 9, 8}, {2, 2, 3, 3}, 1, 3, 1, 31);
  std::vector<std::uint32_t> seeds = planted.membership;
  for (const std::size_t i : {1, 4, 5, 9, 12, 14, 17, 22})
    seeds[i] = (seeds[i] + 1 + std::uint32_t(i) % 2) % 3;
  const ClusteredFit fit = fit_cta(planted.a, settings_of(1, {2, 2, 3, 3}, 3, 1, seeds));
  // The same partition, under whatever names.
  for (std::size_t i = 3; i < 24; ++i) CHECK(fit.mixture.membership[i] == fit.mixture.membership[i % 3]);
  CHECK(squared_distance(reconstruct(fit), planted.a) < 1e-12 * squared_norm(planted.a));
  check_constraints(fit, 1);
}

TEST_CASE("CTA that tries the nearest clusters only ends near CTA that tries all") {
  const Tensor a = waves({60, 6, 8, 8});
  ClusteredSettings settings = settings_of(0, {2, 2, 4, 4}, 8, 1, seeds_in_order(60, 8));
  const ClusteredFit all = fit_cta(a, settings);
  settings.nearest = 8;
  const ClusteredFit every = fit_cta(a, settings);
  CHECK(every.objective == all.objective);
  CHECK(every.mixture.membership == all.mixture.membership);
  settings.nearest = 3;
  const ClusteredFit some = fit_cta(a, settings);
  check_constraints(some, 1);
  check_objective(some, a);
  // The start is the same; clusters that are far away would take some sub-tensors a little better.
  CHECK(some.objective.front() == all.objective.front());
  CHECK(some.objective.back() < some.objective.front());
  CHECK(some.objective.back() < 1.5 * all.objective.back());
}

TEST_CASE("K-CTA recovers a tensor in which each sub-tensor mixes two clusters") {
  const test::Planted planted = test::planted_clusters({5, 40, 9, 8}, {2, 2, 3, 3}, 1, 4, 2, 32);
  ClusteredSettings settings = settings_of(1, {2, 2, 3, 3}, 4, 2, seeds_round(40, 4));
  settings.iterations = 200;
  settings.tolerance = 0;
  const ClusteredFit fit = fit_k_cta(planted.a, settings);
  CHECK(squared_distance(reconstruct(fit), planted.a) < 1e-8 * squared_norm(planted.a));
  for (std::size_t i = 4; i < 40; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto first = fit.mixture.membership.begin() + std::ptrdiff_t(i % 4 * 2);
      CHECK(std::count(first, first + 2, fit.mixture.membership[i * 2 + k]) == 1);
    }
  check_constraints(fit, 2);
}

TEST_CASE("K = 1 equals CTA") {
  const Tensor a = waves({4, 30, 8, 8});
  const ClusteredSettings settings = settings_of(1, {3, 2, 4, 4}, 5, 1, seeds_round(30, 5));
  const ClusteredFit cta = fit_cta(a, settings), k_cta = fit_k_cta(a, settings);
  REQUIRE(cta.objective.size() > 2);
  CHECK(cta.mixture.membership == k_cta.mixture.membership);
  REQUIRE(cta.objective.size() == k_cta.objective.size());
  // One sums what cores leave, the other what residuals hold.
  for (std::size_t n = 0; n < cta.objective.size(); ++n)
    CHECK(test::near(cta.objective[n], k_cta.objective[n], 1e-4));
  CHECK(squared_distance(reconstruct(cta), reconstruct(k_cta)) < 1e-6 * squared_norm(a));
}

TEST_CASE("the constraints hold, the objective is the error and never rises, and more mixture lowers it") {
  const Tensor a = waves({4, 36, 10, 9});
  for (const bool keep : {true, false})
    for (const bool global : {false, true}) {
      double before = 1e30;
      for (const std::size_t k : {std::size_t(1), std::size_t(2), std::size_t(3)}) {
        ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 6, k, seeds_in_order(36, 6));
        if (global) settings.global_modes = {0};
        settings.keep_better_clusters = keep;
        const ClusteredFit fit = fit_k_cta(a, settings);
        check_constraints(fit, k);
        check_objective(fit, a);
        CHECK((fit.global_basis[0].size() > 0) == global);
        CHECK(fit.objective.back() < before);
        before = fit.objective.back();
      }
    }
}

TEST_CASE("the clustered mode may be any") {
  const Tensor a = waves({6, 16, 5, 7});
  for (std::size_t mode = 0; mode < 4; ++mode) {
    std::vector<std::size_t> ranks{3, 6, 3, 4};
    ranks[mode] = 1;
    const ClusteredFit fit =
        fit_k_cta(a, settings_of(mode, ranks, 3, 2, seeds_in_order(a.dimensions[mode], 3)));
    check_constraints(fit, 2);
    check_objective(fit, a);
  }
}

TEST_CASE("exchange and the exhaustive search end no worse than the greedy one") {
  const Tensor a = waves({4, 36, 10, 9});
  ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 6, 3, seeds_in_order(36, 6));
  const ClusteredFit greedy = fit_k_cta(a, settings);
  for (const Pursuit pursuit : {Pursuit::exchange, Pursuit::exhaustive}) {
    settings.pursuit = pursuit;
    const ClusteredFit better = fit_k_cta(a, settings);
    check_objective(better, a);
    check_constraints(better, 3);
    CHECK_FALSE(better.undone);
    CHECK(better.objective.back() < greedy.objective.back() * 1.02);  // local optima
  }
}

TEST_CASE("an iteration that got worse is undone, and what stands is the one before") {
  // Sub-tensors that are not negative have clusters that resemble each other: the greedy search soon finds a
  // worse set than the one before.
  const Tensor a = waves({4, 24, 10, 9});
  ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 4, 3, seeds_in_order(24, 4));
  settings.keep_better_clusters = false;
  settings.tolerance = 0;
  settings.iterations = 100;
  const ClusteredFit fit = fit_k_cta(a, settings);
  REQUIRE(fit.undone);
  check_objective(fit, a);
  check_constraints(fit, 3);
  // As many iterations as stood, and no more, give the same.
  settings.iterations = int(fit.objective.size()) - 1;
  const ClusteredFit shorter = fit_k_cta(a, settings);
  CHECK_FALSE(shorter.undone);
  CHECK(shorter.objective == fit.objective);
  CHECK(shorter.mixture.coefficients == fit.mixture.coefficients);
  CHECK(shorter.clusters[2].core.data == fit.clusters[2].core.data);
  // Keeping better clusters needs no undoing, and gets further.
  settings.keep_better_clusters = true;
  settings.iterations = 100;
  const ClusteredFit kept = fit_k_cta(a, settings);
  CHECK_FALSE(kept.undone);
  CHECK(kept.objective.back() < fit.objective.back());
}

TEST_CASE("a cluster with fewer members than its rank has zeros where its core lacks them") {
  const Tensor a = waves({4, 12, 8, 8});
  std::vector<std::uint32_t> seeds(12, 0);
  seeds[0] = 1;
  seeds[1] = seeds[2] = 2;
  ClusteredSettings settings = settings_of(1, {3, 4, 4, 4}, 3, 1, seeds);
  settings.iterations = 0;
  const ClusteredFit fit = fit_cta(a, settings);
  check_objective(fit, a);
  for (std::uint32_t c = 1; c < 3; ++c) {
    const Matrix u = mixing(fit, c), core = unfold(fit.clusters[c].core, 1);
    CHECK(u.rightCols(4 - Index(c)).norm() == 0);
    CHECK(core.bottomRows(4 - Index(c)).norm() == 0);
    check_orthonormal(u.leftCols(Index(c)));
  }
  settings.iterations = 20;
  check_objective(fit_cta(a, settings), a);
  settings.mixture = 2;
  check_objective(fit_k_cta(a, settings), a);
}

TEST_CASE("tensors of no or one direction, as of a mask that is visible everywhere, are fitted exactly") {
  for (const float value : {0.0f, 1.0f}) {
    Tensor a({12, 8, 8});
    std::fill(a.data.begin(), a.data.end(), value);
    const ClusteredSettings settings = settings_of(0, {2, 4, 4}, 3, 2, seeds_round(12, 3));
    ClusteredSettings hard = settings;
    hard.mixture = 1;
    for (const ClusteredFit& fit :
         {fit_k_cta(a, settings), fit_cta(a, hard), as_one_cluster(fit_nsvd(a, {{2, 4, 4}}), 0)}) {
      CHECK(fit.mixture.coefficients.allFinite());
      CHECK(squared_distance(reconstruct(fit), a) <= 1e-12 * squared_norm(a));  // floats
      const Mixture mixture = resample(fit, atom_projections(fit, a), Matrix::Identity(12, 12));
      CHECK(mixture.coefficients.allFinite());
    }
  }
}

TEST_CASE("an N-SVD can be written as a clustered fit with one cluster") {
  const Tensor a = waves({4, 12, 8, 8});
  const Nsvd fit = fit_nsvd(a, {{2, 5, 4, 8}});
  const ClusteredFit one = as_one_cluster(fit, 1);
  CHECK(squared_distance(reconstruct(one), reconstruct(fit)) < 1e-12 * squared_norm(a));
  check_constraints(one, 1);
  check_objective(one, a);
}

TEST_CASE("resampling at the sub-tensors themselves gives them back, and between them a mixture") {
  const Tensor a = waves({4, 36, 10, 9});
  ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 6, 3, seeds_in_order(36, 6));
  settings.global_modes = {0};
  const ClusteredFit fit = fit_k_cta(a, settings);
  const Matrix projections = atom_projections(fit, a);
  ClusteredFit same = fit;
  same.mixture = resample(fit, projections, Matrix::Identity(36, 36));
  const double error = squared_distance(reconstruct(fit), a);
  // The fit may keep clusters that the greedy search does not find; on the same ones, optimal projection is
  // no worse than what the update stage left.
  CHECK(squared_distance(reconstruct(same), a) < 1.1 * error);
  std::size_t alike = 0;
  for (std::size_t i = 0; i < 36; ++i) {
    const auto clusters = [&](const ClusteredFit& of) {
      const auto first = of.mixture.membership.begin() + std::ptrdiff_t(i * 3);
      return std::set<std::uint32_t>(first, first + 3);
    };
    const auto error_of = [&](const ClusteredFit& of) {
      return squared_distance(sub_tensors(reconstruct(of), 1, {i}), sub_tensors(a, 1, {i}));
    };
    if (clusters(fit) != clusters(same)) continue;
    ++alike;
    CHECK(error_of(same) <= error_of(fit) * (1 + 1e-4));  // floats
  }
  CHECK(alike >= 18);

  // Half way between neighbours: the mean of two sub-tensors, approximated about as well as they are.
  Matrix halves = Matrix::Zero(36, 36);
  for (Index i = 0; i < 36; ++i) halves(i, i) = halves(i, (i + 1) % 36) = 0.5f;
  const Tensor between = mode_product(a, 1, halves);
  ClusteredFit resampled = fit;
  resampled.mixture = resample(fit, projections, halves);
  CHECK(squared_distance(reconstruct(resampled), between) < 1.5 * error);
  CHECK(test::says(test::failure_of([&] { resample(fit, projections, Matrix::Identity(35, 35)); }),
                   "35 columns"));
}

namespace {

// Columns of a map whose left half is cluster 0 and right half cluster 1, of one atom each, orthogonal, so
// that the error is the sum of (weight - 1)^2.
MixedCells two_halves(std::size_t side) {
  MixedCells cells;
  cells.side = side;
  cells.count = 1;
  for (std::size_t i = 0; i < side * side; ++i) cells.clusters.push_back(2 * (i % side) < side ? 0 : 1);
  cells.weights = WideMatrix::Ones(Index(side * side), 1);
  return cells;
}

}  // namespace

TEST_CASE("weights with lower steps equal the closed form, between cells and where cells go on") {
  const AtomGram atoms{2, 1, Eigen::MatrixXd::Identity(2, 2)};
  // The border of two cells: (w - 1)^2 + 3 w^2.
  MixedCells cells = two_halves(2);
  lower_steps(atoms, WideMatrix::Ones(4, 2), 3, cells);
  for (Index i = 0; i < 4; ++i) CHECK(cells.weights(i, 0) == Approx(0.25));
  // Of four columns the inner ones go on from the outer ones: without a step 3 w_inner = w_outer, and
  // (w_outer - 1)^2 + (w_inner - 1)^2 is smallest at 1.2 and 0.4.
  cells = two_halves(4);
  lower_steps(atoms, WideMatrix::Ones(16, 2), 1e6, cells);
  for (Index i = 0; i < 16; ++i)
    CHECK(cells.weights(i, 0) == Approx(i % 4 == 0 || i % 4 == 3 ? 1.2 : 0.4).epsilon(1e-4));
  cells = two_halves(4);
  CHECK_THROWS_AS(
      lower_steps(atoms, WideMatrix::Ones(16, 2), 1e6, cells, [](std::size_t, std::size_t) { return false; }),
      Failure);
  // Nothing changes without a penalty, or where all cells mix the same.
  cells = two_halves(4);
  lower_steps(atoms, WideMatrix::Zero(16, 2), 0, cells);
  CHECK(cells.weights == WideMatrix::Ones(16, 1));
}

TEST_CASE("a map with lower steps is resampled from the same clusters") {
  const Tensor a = waves({4, 36, 10, 9});
  ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 6, 3, seeds_in_order(36, 6));
  settings.global_modes = {0};
  const ClusteredFit fit = fit_k_cta(a, settings);
  const Matrix projections = atom_projections(fit, a);
  const auto map = [&](double penalty) {
    return resample_map(fit, projections, Matrix::Identity(36, 36), 6, penalty, Pursuit::greedy);
  };
  const Mixture plain = resample(fit, projections, Matrix::Identity(36, 36));
  CHECK(map(0).coefficients == plain.coefficients);
  const Mixture calm = map(1);
  CHECK(calm.membership == plain.membership);
  ClusteredFit of_plain = fit, of_calm = fit;
  of_plain.mixture = plain;
  of_calm.mixture = calm;
  // Optimal projection has the smallest error of the cells, so that a penalty raises it.
  CHECK(squared_distance(reconstruct(of_calm), a) > squared_distance(reconstruct(of_plain), a));
  CHECK(squared_distance(reconstruct(of_calm), a) < 0.5 * squared_norm(a));
}

TEST_CASE("resampling leaves out directions in which the members of a cluster hardly differ") {
  // Two patterns, each with its own second direction of a ten-thousandth.
  Tensor a({12, 8, 8});
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    const std::size_t view = i / 64, texel = i % 64;
    const double phase = double(texel) * (view < 6 ? 0.7 : 1.9);
    a.data[i] = float(std::cos(phase) + 1e-4 * std::sin(double(view) * 1.3) * std::sin(3.1 * phase));
  }
  std::vector<std::uint32_t> seeds(12, 0);
  std::fill(seeds.begin() + 6, seeds.end(), 1u);
  const ClusteredFit fit = fit_cta(a, settings_of(0, {2, 8, 8}, 2, 1, seeds));
  Matrix half = Matrix::Zero(1, 12);
  half(0, 0) = half(0, 6) = 0.5f;
  const Mixture between = resample(fit, atom_projections(fit, a), half);
  // Coefficients of a fit are at most 1. The half way between the patterns has a tenth of its size along the
  // second direction, which would take a coefficient of hundreds.
  CHECK(between.coefficients.cwiseAbs().maxCoeff() < 2);
}

TEST_CASE("clustered fits have the same bits on one thread and on three") {
  const Tensor a = waves({5, 24, 12, 11});
  ClusteredSettings settings = settings_of(1, {3, 2, 5, 4}, 4, 2, seeds_in_order(24, 4));
  settings.global_modes = {0};
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return fit_k_cta(a, settings);
  };
  const ClusteredFit one = with_threads(1), three = with_threads(3);
  CHECK(one.objective == three.objective);
  CHECK(one.mixture.membership == three.mixture.membership);
  CHECK(one.mixture.coefficients == three.mixture.coefficients);
  for (std::size_t c = 0; c < 4; ++c) CHECK(one.clusters[c].core.data == three.clusters[c].core.data);
}

TEST_CASE("settings that do not fit are refused by name") {
  Tensor a = waves({4, 12, 8, 8});
  const ClusteredSettings good = settings_of(1, {3, 2, 4, 4}, 3, 2, seeds_round(12, 3));
  const auto message = [&](auto&& change) {
    ClusteredSettings settings = good;
    change(settings);
    return test::failure_of([&] { fit_k_cta(a, settings); });
  };
  CHECK(message([](auto&) {}).empty());
  CHECK(test::says(message([](auto& s) { s.ranks[2] = 9; }), "mode 3 is out of range (got 9, need 1 to 8)"));
  CHECK(test::says(message([](auto& s) { s.clusters = 13; }), "got 13, need 1 to 12"));
  CHECK(test::says(message([](auto& s) { s.mixture = 4; }), "got 4, need 1 to 3"));
  CHECK(test::says(message([](auto& s) { s.mixture = 0; }), "got 0"));
  CHECK(test::says(message([](auto& s) { s.mode = 4; }), "mode 5"));
  CHECK(test::says(message([](auto& s) { s.global_modes = {1}; }), "mode 2 cannot have a global basis"));
  CHECK(test::says(message([](auto& s) { s.global_modes = {7}; }), "mode 8"));
  CHECK(test::says(message([](auto& s) { s.seeds.pop_back(); }), "11 sub-tensors"));
  CHECK(test::says(message([](auto& s) { s.seeds[5] = 3; }), "sub-tensor 5 starts in cluster 3"));
  CHECK(test::says(message([](auto& s) { s.seeds.assign(12, 1); }), "no sub-tensor starts in cluster 0"));
  CHECK(test::says(message([](auto& s) { s.iterations = -2; }), "-2"));
  CHECK(test::says(message([](auto& s) { s.sweeps = 0; }), "sweeps"));
  CHECK(test::says(message([](auto& s) { s.nearest = 2; }), "mode 2 is clustered"));
  CHECK(test::says(test::failure_of([&] { fit_cta(a, good); }), "got K = 2"));
  a.data[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK(test::says(message([](auto&) {}), "(0, 0, 0, 1)"));
}

TEST_CASE("progress tells the stage, and stops the fit") {
  const Tensor a = waves({4, 12, 8, 8});
  const ClusteredSettings settings = settings_of(1, {3, 2, 4, 4}, 3, 2, seeds_round(12, 3));
  std::vector<std::pair<int, std::size_t>> seen;
  try {
    fit_k_cta(a, settings, [&](const ClusteredProgress& now) {
      CHECK((now.objective > 0) == (now.iteration > 0));
      seen.emplace_back(now.iteration, now.cluster);
      return seen.size() < 5;
    });
    FAIL("was not stopped");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_CANCELLED);
  }
  CHECK(seen == std::vector<std::pair<int, std::size_t>>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}});
}
