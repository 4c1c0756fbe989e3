#include "bakers/tensor/mixture_search.h"

#include <Eigen/QR>
#include <algorithm>

#include "bakers/tensor/gram.h"
#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook::bake::tensor;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Clusters with correlated bases, and everything written out in the space of whole sub-tensors.
struct Explicit {
  static constexpr std::size_t clusters = 5, rank = 2, mode = 1;
  const Dimensions dimensions{3, 30, 3, 3};
  std::vector<ClusteredFit::Cluster> parts;
  std::vector<DualBasis> dual;
  Tensor a;
  AtomGram atoms;
  MatrixXd products;              // I_m x (C R_m)
  std::vector<MatrixXd> spanned;  // a cluster: R_m x (I_1 I_3 I_4), uf_m(Z_c x_{n != m} U_{n,c})
  MatrixXd sub_tensors;           // I_m x the same

  explicit Explicit(std::uint64_t seed) {
    std::mt19937_64 bits(seed);
    a = test::random_tensor(dimensions, bits);
    sub_tensors = unfold(a, mode).cast<double>();
    for (std::size_t c = 0; c < clusters; ++c) {
      ClusteredFit::Cluster cluster{test::random_tensor({2, rank, 2, 2}, bits), {}};
      for (std::size_t n = 0; n < 4; ++n)
        cluster.basis.push_back(test::random_basis(dimensions[n], cluster.core.dimensions[n], bits));
      cluster.basis[mode] = Matrix();
      spanned.push_back(unfold(mode_products(cluster.core, cluster.basis), mode).cast<double>());
      dual.push_back(dual_basis(cluster.core, mode));
      parts.push_back(std::move(cluster));
    }
    const Tensor joined = join_atoms(parts, dual, dimensions, mode);
    atoms = atom_gram(joined, mode, clusters);
    products = cross_gram(a, joined, mode);
  }

  // The least squared error of sub-tensor i, less `taken`, over coefficients of these clusters: by QR.
  double least_error(Index i, const std::vector<std::uint32_t>& of, const VectorXd& taken) const {
    MatrixXd span(sub_tensors.cols(), Index(of.size() * rank));
    for (std::size_t k = 0; k < of.size(); ++k)
      span.middleCols(Index(k * rank), rank) = spanned[of[k]].transpose();
    const VectorXd target = sub_tensors.row(i).transpose() - taken;
    return (target - span * span.colPivHouseholderQr().solve(target)).squaredNorm();
  }
  double least_error(Index i, const std::vector<std::uint32_t>& of) const {
    return least_error(i, of, VectorXd::Zero(sub_tensors.cols()));
  }
  // The tensor that a mix represents, by U = w (uf(Z) uf(Z)^T)^(-1/2) and the cores themselves.
  VectorXd mixed(const SubTensorMix& mix) const {
    VectorXd sum = VectorXd::Zero(sub_tensors.cols());
    for (std::size_t k = 0; k < mix.clusters.size(); ++k)
      sum += (mix.weights.segment(Index(k * rank), rank).transpose() * dual[mix.clusters[k]].inverse_root *
              spanned[mix.clusters[k]])
                 .transpose();
    return sum;
  }
};

// Inner products of floats over some hundred entries.
constexpr double rounding = 1e-5;

}  // namespace

TEST_CASE("theorem 1 and lemma 2: the first cluster and its coefficients have the least squared error") {
  const Explicit e(11);
  for (Index i = 0; i < e.sub_tensors.rows(); ++i) {
    double least = 1e30;
    std::uint32_t best = 0;
    for (std::uint32_t c = 0; c < Explicit::clusters; ++c) {
      const double error = e.least_error(i, {c});
      // (32): what remains is || A ||^2 less the objective of (9).
      const double kept = e.products.row(i).segment(Index(c) * 2, 2).squaredNorm();
      CHECK(test::near(e.sub_tensors.row(i).squaredNorm() - kept, error, rounding));
      if (error < least) best = c, least = error;
    }
    const SubTensorMix mix = search_greedy(e.atoms, e.products.row(i), 1);
    CHECK(mix.clusters == std::vector<std::uint32_t>{best});
    CHECK(test::near((e.sub_tensors.row(i).transpose() - e.mixed(mix)).squaredNorm(), least, rounding));
  }
}

TEST_CASE("theorem 3: the next cluster leaves the lowest error of the residual") {
  const Explicit e(12);
  for (Index i = 0; i < e.sub_tensors.rows(); ++i) {
    SubTensorMix mix = search_greedy(e.atoms, e.products.row(i), 1);
    for (std::size_t k = 2; k <= 4; ++k) {
      double least = 1e30;
      std::uint32_t best = 0;
      for (std::uint32_t c = 0; c < Explicit::clusters; ++c) {
        if (std::count(mix.clusters.begin(), mix.clusters.end(), c)) continue;
        const double error = e.least_error(i, {c}, e.mixed(mix));
        if (error < least) best = c, least = error;
      }
      CHECK(next_cluster(e.atoms, e.products.row(i), mix) == best);
      mix = search_greedy(e.atoms, e.products.row(i), k);
      CHECK(mix.clusters.back() == best);
    }
  }
}

TEST_CASE("theorem 4: optimal projection is the least-squares solution over the chosen clusters") {
  const Explicit e(13);
  for (Index i = 0; i < e.sub_tensors.rows(); ++i)
    for (const std::vector<std::uint32_t>& of :
         {std::vector<std::uint32_t>{3}, {0, 2}, {4, 1, 3}, {0, 1, 2, 3, 4}}) {
      const SubTensorMix mix = project_on(e.atoms, e.products.row(i), of);
      const double error = (e.sub_tensors.row(i).transpose() - e.mixed(mix)).squaredNorm();
      CHECK(test::near(error, e.least_error(i, of), rounding));
      CHECK(test::near(e.sub_tensors.row(i).squaredNorm() - mix.explained, error, rounding));
    }
}

TEST_CASE("the exhaustive search finds the best of all sets") {
  const Explicit e(14);
  bool beats_greedy = false;
  for (Index i = 0; i < e.sub_tensors.rows(); ++i) {
    double least = 1e30;
    for (std::uint32_t b = 1; b < 5; ++b)
      for (std::uint32_t a = 0; a < b; ++a) least = std::min(least, e.least_error(i, {a, b}));
    const SubTensorMix best = search_exhaustive(e.atoms, e.products.row(i), 2);
    const SubTensorMix greedy = search_greedy(e.atoms, e.products.row(i), 2);
    CHECK(test::near(e.sub_tensors.row(i).squaredNorm() - best.explained, least, rounding));
    CHECK(best.explained >= greedy.explained - rounding);
    beats_greedy |= best.explained > greedy.explained * (1 + 1e-3);
  }
  CHECK(beats_greedy);
}

TEST_CASE("exchange ends where no single cluster can be exchanged for a better one") {
  const Explicit e(16);
  bool beats_greedy = false;
  for (Index i = 0; i < e.sub_tensors.rows(); ++i) {
    const VectorXd products = e.products.row(i);
    const SubTensorMix greedy = search_greedy(e.atoms, products, 3);
    const SubTensorMix mix = search(Pursuit::exchange, e.atoms, products, 3);
    beats_greedy |= mix.explained > greedy.explained * (1 + 1e-3);
    CHECK(mix.explained >= greedy.explained);
    CHECK(mix.explained <= search_exhaustive(e.atoms, products, 3).explained * (1 + rounding));
    const double error = e.least_error(i, mix.clusters);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::uint32_t c = 0; c < Explicit::clusters; ++c) {
        if (std::count(mix.clusters.begin(), mix.clusters.end(), c)) continue;
        std::vector<std::uint32_t> other = mix.clusters;
        other[k] = c;
        CHECK(e.least_error(i, other) >= error - rounding * e.sub_tensors.row(i).squaredNorm());
      }
  }
  CHECK(beats_greedy);
}

TEST_CASE("clusters that span the same space share a sub-tensor without blowing up") {
  Explicit e(15);
  e.parts[1] = e.parts[0];
  e.dual[1] = e.dual[0];
  const Tensor joined = join_atoms(e.parts, e.dual, e.dimensions, Explicit::mode);
  const AtomGram atoms = atom_gram(joined, Explicit::mode, Explicit::clusters);
  const MatrixXd products = cross_gram(e.a, joined, Explicit::mode);
  for (Index i = 0; i < products.rows(); ++i) {
    const SubTensorMix mix = project_on(atoms, products.row(i), {0, 1});
    CHECK(test::near(mix.explained, project_on(atoms, products.row(i), {0}).explained, rounding));
    // The pseudo-inverse gives both the same half.
    CHECK((mix.weights.head(2) - mix.weights.tail(2)).norm() < 1e-3 * mix.weights.norm());
  }
}
