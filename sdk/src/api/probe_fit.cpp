#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>

#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/probe/axes.h"

using namespace nook;
using namespace nook::probe;

namespace {

void check_choices(const nook_probe_fit_desc& desc) {
  check_known("desc.method", desc.method, NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE);
  check_known("desc.form", desc.form, NOOK_FORM_PAPER);
  check_known("desc.match_sh", desc.match_sh, 1);
  check_known("desc.basis", desc.basis, NOOK_PROBE_BASIS_SH);
  check_known("desc.domain", desc.domain, NOOK_PROBE_DOMAIN_HEMISPHERE);
  check_known("desc.ambient", desc.ambient, 1);
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", desc.reserved);
  if (desc.form == NOOK_FORM_PAPER && (desc.method != NOOK_PROBE_FIT_LEAST_SQUARES || desc.match_sh != 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.form is NOOK_FORM_PAPER, which itself chooses desc.method and desc.match_sh (got %d "
                  "and %d, need 0 and 1); leave both at their defaults",
                  desc.method, desc.match_sh);
}

void check_study(const nook_probe_fit_desc& desc, const nook_probe_fit_study_desc& study) {
  const auto choice = [](const char* field, std::int32_t value, std::int32_t last) {
    if (value < 0 || value > last)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s of nook_probe_fit_study_desc is unknown (got %d, need 0 to %d)", field, value, last);
  };
  choice("method", study.method, NOOK_PROBE_FIT_STUDY_MOMENTS);
  choice("published_step", study.published_step, 1);
  choice("denominator", study.denominator, NOOK_PROBE_DENOMINATOR_PRECOMPUTED);
  choice("dice", study.dice, 1);
  if (study.method != NOOK_PROBE_FIT_STUDY_DEFAULT &&
      (desc.form != NOOK_FORM_DEFAULT || desc.method != NOOK_PROBE_FIT_LEAST_SQUARES))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "`method` of nook_probe_fit_study_desc replaces desc.form and desc.method (got desc.form "
                  "%d and desc.method %d, need 0 for both); leave both at their defaults",
                  desc.form, desc.method);
}

Basis lobes_of(const nook_probe_fit_desc& desc, Domain domain, Vec3 up) {
  const std::uint32_t most = max_functions - (desc.ambient ? 1 : 0);
  check_range("desc.lobe_count", desc.lobe_count, 1, most);
  check_range("desc.sharpness", desc.sharpness, 0, max_sharpness);
  std::array<Vec3, max_functions> storage;
  std::array<float, max_functions> sharpnesses;
  const std::span<Vec3> axes = std::span(storage).first(desc.lobe_count);
  for (std::uint32_t i = 0; i < desc.lobe_count; ++i) {
    if (desc.axes) axes[i] = {desc.axes[3 * i], desc.axes[3 * i + 1], desc.axes[3 * i + 2]};
    sharpnesses[i] = desc.sharpnesses      ? desc.sharpnesses[i]
                     : desc.sharpness == 0 ? even_sharpness(desc.lobe_count, domain)
                                           : desc.sharpness;
  }
  if (!desc.axes && domain == Domain::sphere) vogel_sphere(axes);
  if (!desc.axes && domain == Domain::hemisphere) vogel_hemisphere(up, axes);
  return gaussian_basis(axes, std::span(sharpnesses).first(desc.lobe_count), desc.ambient != 0, domain, up);
}

Basis basis_of(const nook_probe_fit_desc& desc, const nook_probe_fit_study_desc& study) {
  const auto domain = static_cast<Domain>(desc.domain);
  const Vec3 up{desc.up[0], desc.up[1], desc.up[2]};
  if (!(std::abs(length(up) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.up is not a unit vector (got %g, %g, %g); normalise it",
                  double(up.x), double(up.y), double(up.z));
  if (study.dice) return dice_basis(domain, up);
  if (desc.basis == NOOK_PROBE_BASIS_SH) return harmonic_basis(desc.order, domain, up);
  return lobes_of(desc, domain, up);
}

FitMethod method_of(const nook_probe_fit_desc& desc, const nook_probe_fit_study_desc& study) {
  switch (study.method) {
    case NOOK_PROBE_FIT_STUDY_NAIVE:
      return FitMethod::naive;
    case NOOK_PROBE_FIT_STUDY_RUNNING_AVERAGE_ORIGINAL:
      return FitMethod::running_average_original;
    case NOOK_PROBE_FIT_STUDY_MOMENTS:
      return FitMethod::moments;
    default:
      break;
  }
  if (desc.form == NOOK_FORM_PAPER) return FitMethod::running_average;
  switch (desc.method) {
    case NOOK_PROBE_FIT_LEAST_SQUARES_NON_NEGATIVE:
      return FitMethod::non_negative_least_squares;
    case NOOK_PROBE_FIT_RUNNING_AVERAGE:
      return FitMethod::running_average;
    case NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE:
      return FitMethod::running_average_non_negative;
    default:
      return FitMethod::least_squares;
  }
}

FitSettings settings_of(const nook_probe_fit_desc& desc, const nook_probe_fit_study_desc& study,
                        nook_isa isa) {
  const bool paper = desc.form == NOOK_FORM_PAPER;
  FitSettings settings;
  settings.method = method_of(desc, study);
  settings.constraint = desc.match_sh && !paper ? Constraint::bands : Constraint::none;
  settings.step = study.published_step || paper ? Step::plain : Step::fast;
  settings.denominator = static_cast<Denominator>(study.denominator);
  settings.growing_samples = desc.growing_samples;
  settings.isa = isa;
  return settings;
}

template <class Body>
nook_result with_fit(const char* function, nook_probe_fit fit, Body&& body) noexcept {
  return api::enter(function, [&] {
    need(fit, "fit");
    body(fit->fit);
  });
}

}  // namespace

nook_result nook_probe_fit_create(nook_context context, const nook_probe_fit_desc* desc,
                                  nook_probe_fit* out) {
  return api::enter("nook_probe_fit_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const auto known = read_descriptor<nook_probe_fit_desc, nook_probe_fit_study_desc>(desc);
    check_choices(known);
    nook_probe_fit_study_desc study = default_desc<nook_probe_fit_study_desc>();
    if (const auto* given = find_extension<nook_probe_fit_study_desc>(known.next))
      study = read_descriptor(given);
    check_study(known, study);
    *out = Owned<nook_probe_fit_s>::make(context->memory(), Ref<nook_context_s>::share(context), context,
                                         basis_of(known, study), settings_of(known, study, context->isa()))
               .detach();
  });
}

void nook_probe_fit_destroy(nook_probe_fit* fit) {
  if (!fit || !*fit) return;
  (*fit)->release();
  *fit = nullptr;
}

nook_result nook_probe_fit_add_samples(nook_probe_fit fit, const float* directions, const float* radiance,
                                       const float* weights, size_t count) {
  return with_fit("nook_probe_fit_add_samples", fit, [&](Fit& f) {
    if (count == 0) return;
    need(directions, "directions");
    need(radiance, "radiance");
    check_array("count", count, 3 * sizeof(float));
    f.add_samples(directions, radiance, weights, count);
  });
}

nook_result nook_probe_fit_seed(nook_probe_fit fit, nook_probe_fit short_run) {
  return with_fit("nook_probe_fit_seed", fit, [&](Fit& f) {
    need(short_run, "short_run");
    f.seed(short_run->fit);
  });
}

nook_result nook_probe_fit_merge(nook_probe_fit fit, nook_probe_fit other) {
  return with_fit("nook_probe_fit_merge", fit, [&](Fit& f) {
    need(other, "other");
    f.merge(other->fit);
  });
}

nook_result nook_probe_fit_reset(nook_probe_fit fit) {
  return with_fit("nook_probe_fit_reset", fit, [](Fit& f) { f.reset(); });
}

nook_result nook_probe_fit_solve(nook_probe_fit fit, nook_probe* out) {
  return api::enter("nook_probe_fit_solve", [&] {
    need(out, "out");
    *out = nullptr;
    need(fit, "fit");
    Probes probes(fit->context->memory());
    probes.basis = fit->fit.basis();
    probes.coefficients.resize(probes.basis.count);
    fit->fit.read(probes.coefficients);
    if (probes.basis.kind == BasisKind::gaussians) {
      probes.gloss.resize(probes.basis.count);
      fit->fit.read_gloss(probes.gloss);
    }
    *out = Owned<nook_probe_s>::make(fit->context->memory(), Ref<nook_context_s>::share(fit->context),
                                     std::move(probes))
               .detach();
  });
}

nook_result nook_probe_fit_describe(nook_probe_fit fit, nook_probe_fit_info* info) {
  return with_fit("nook_probe_fit_describe", fit, [&](Fit& f) {
    const SampleCounts& counts = f.counts();
    nook_probe_fit_info answer{};
    answer.function_count = f.basis().count;
    answer.samples = counts.used;
    answer.skipped = counts.skipped();
    answer.skipped_direction = counts.bad_direction;
    answer.skipped_radiance = counts.bad_radiance;
    answer.skipped_weight = counts.bad_weight;
    answer.weight = counts.weight;
    for (int c = 0; c < 3; ++c)
      answer.mean_radiance[c] = counts.weight > 0 ? counts.radiance[c] / counts.weight : 0;
    write_info(info, answer);
  });
}
