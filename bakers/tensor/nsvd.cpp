#include "bakers/tensor/nsvd.h"

#include <algorithm>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/gram.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

Nsvd fit_nsvd(const TensorView& a, const NsvdSettings& settings, const OnNsvd& progress) {
  check_tensor(a);
  check_ranks(a.dimensions, settings.ranks);
  check_iterations(settings.iterations, settings.tolerance);
  OnNsvd of_hosvd;
  if (progress)
    of_hosvd = [&](const NsvdProgress& now) { return progress({0, settings.iterations, now.mode, 0}); };
  std::vector<Matrix> bases = hosvd_bases(a, settings.ranks, of_hosvd);
  return alternate(a, squared_norm(a), std::move(bases),
                   {settings.ranks, 0, settings.iterations, settings.tolerance}, progress);
}

Tensor reconstruct(const Nsvd& fit) {
  return mode_products(fit.core, fit.basis);
}

namespace {

// Returns the modes that have a basis, in cyclic order from `first`.
std::vector<std::size_t> fitted_modes(const Dimensions& dimensions, const Alternation& settings) {
  std::vector<std::size_t> modes;
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    const std::size_t n = (settings.first + k) % dimensions.size();
    if (settings.ranks[n] < dimensions[n]) modes.push_back(n);
  }
  return modes;
}

void report(const OnNsvd& progress, const NsvdProgress& now) {
  if (progress && !progress(now))
    throw Failure(NOOK_ERROR_CANCELLED, "stopped by the progress callback in sweep %d of the N-SVD",
                  now.sweep);
}

}  // namespace

std::vector<Matrix> hosvd_bases(const TensorView& a, const std::vector<std::size_t>& ranks,
                                const OnNsvd& progress) {
  std::vector<Matrix> bases(a.order());
  for (std::size_t n = 0; n < a.order(); ++n) {
    if (ranks[n] == a.dimensions[n]) continue;
    report(progress, {0, 0, n, 0});
    bases[n] = leading_eigenvectors(gram(a, n), ranks[n]);
  }
  return bases;
}

Nsvd alternate(const TensorView& a, double squared, std::vector<Matrix> bases, const Alternation& settings,
               const OnNsvd& progress) {
  const std::vector<std::size_t> modes = fitted_modes(a.dimensions, settings);
  Nsvd best;
  const auto error_of = [&](const Tensor& core) { return std::max(0.0, squared - squared_norm(core)); };
  const bool complete =
      std::all_of(modes.begin(), modes.end(), [&](std::size_t n) { return bases[n].size() > 0; });
  if (complete) {
    best.core = project(a, bases);
    best.basis = bases;
    best.objective.push_back(error_of(best.core));
  }
  if (modes.empty()) return best;

  for (int sweep = 0; sweep < settings.sweeps || best.objective.empty(); ++sweep) {
    Tensor core;
    for (std::size_t n : modes) {
      report(progress, {sweep + 1, settings.sweeps, n, best.objective.empty() ? 0 : best.objective.back()});
      // All other modes are projected onto their bases. So the result is the best subspace of this mode for
      // these bases.
      bases[n] = Matrix();
      const Tensor projected = project(a, bases);
      bases[n] = leading_eigenvectors(gram(projected, n), settings.ranks[n]);
      if (n == modes.back()) core = mode_product(projected, n, bases[n].transpose());
    }
    const double error = error_of(core), before = best.objective.empty() ? squared : best.objective.back();
    // Only rounding can raise the error. Then the fit has reached the precision of floats.
    if (!best.objective.empty() && error >= before) break;
    best.core = std::move(core);
    best.basis = bases;
    best.objective.push_back(error);
    if (before - error <= settings.tolerance * before) break;
  }
  return best;
}

}  // namespace nook::bake::tensor
