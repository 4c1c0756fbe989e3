#include <nook/nook_probe.h>

#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/core/isa.h"
#include "sdk/src/probe/axes.h"

using namespace nook;
using namespace nook::probe;

namespace {

nook_probe_fit_desc default_desc() {
  nook_probe_fit_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.method = NOOK_PROBE_LEAST_SQUARES;
  desc.up[2] = 1;
  desc.lobe_count = 12;
  desc.order = 2;
  return desc;
}
constexpr std::size_t first_desc = offsetof(nook_probe_fit_desc, reserved) + sizeof(std::uint32_t);
constexpr std::size_t first_info = offsetof(nook_probe_fit_info, mean_radiance) + sizeof(double[3]);

void check_choice(const char* field, std::int32_t value, std::int32_t last) {
  if (value < 0 || value > last)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s is unknown (got %d, need 0 to %d)", field, value,
                  last);
}

void check_choices(const nook_probe_fit_desc& desc) {
  check_choice("method", desc.method, NOOK_PROBE_NON_NEGATIVE_LEAST_SQUARES);
  check_choice("constraint", desc.constraint, NOOK_PROBE_CONSTRAINT_NONE);
  check_choice("basis", desc.basis, NOOK_PROBE_DICE);
  check_choice("domain", desc.domain, NOOK_PROBE_HEMISPHERE);
  check_choice("ambient", desc.ambient, 1);
  check_choice("denominator", desc.denominator, NOOK_PROBE_DENOMINATOR_PRECOMPUTED);
  check_choice("step", desc.step, NOOK_PROBE_STEP_PLAIN);
  check_choice("isa", desc.isa, last_isa());
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", desc.reserved);
}

Basis lobes_of(const nook_probe_fit_desc& desc, Domain domain, Vec3 up) {
  const std::uint32_t most = max_functions - (desc.ambient ? 1 : 0);
  if (desc.lobe_count < 1 || desc.lobe_count > most)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.lobe_count is out of range (got %u, need 1 to %u)",
                  desc.lobe_count, most);
  if (!(desc.sharpness >= 0 && desc.sharpness <= max_sharpness))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.sharpness is out of range (got %g, need 0 to %g)",
                  double(desc.sharpness), double(max_sharpness));
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

Basis basis_of(const nook_probe_fit_desc& desc) {
  const auto domain = static_cast<Domain>(desc.domain);
  const Vec3 up{desc.up[0], desc.up[1], desc.up[2]};
  if (!(std::abs(length(up) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.up is not a unit vector (got %g, %g, %g); normalise it",
                  double(up.x), double(up.y), double(up.z));
  if (desc.basis == NOOK_PROBE_HARMONICS) return harmonic_basis(desc.order, domain, up);
  if (desc.basis == NOOK_PROBE_DICE) return dice_basis(domain, up);
  return lobes_of(desc, domain, up);
}

FitSettings settings_of(const nook_probe_fit_desc& desc) {
  FitSettings settings;
  settings.method = static_cast<FitMethod>(desc.method);
  settings.constraint = static_cast<Constraint>(desc.constraint);
  settings.step = static_cast<Step>(desc.step);
  settings.denominator = static_cast<Denominator>(desc.denominator);
  settings.growing_samples = desc.growing_samples;
  settings.isa = desc.isa;
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

nook_result nook_probe_fit_desc_init(nook_probe_fit_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_probe_fit_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_desc, default_desc()); });
}

nook_result nook_probe_fit_create(nook_context context, const nook_probe_fit_desc* desc,
                                  nook_probe_fit* out) {
  return api::enter("nook_probe_fit_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_probe_fit_desc known =
        read_descriptor(desc, "nook_probe_fit_desc_init", first_desc, default_desc());
    check_choices(known);
    *out = Owned<nook_probe_fit_s>::make(context->memory(), Ref<nook_context_s>::share(context), context,
                                         basis_of(known), settings_of(known))
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

nook_result nook_probe_fit_read(nook_probe_fit fit, float* coefficients, uint32_t function_count) {
  return with_fit("nook_probe_fit_read", fit, [&](Fit& f) {
    need(coefficients, "coefficients");
    if (function_count != f.basis().count)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "function_count is not the fit's (got %u, need %u)",
                    function_count, f.basis().count);
    std::array<Vec3, max_functions> read;
    f.read(std::span(read).first(function_count));
    for (std::uint32_t i = 0; i < function_count; ++i, coefficients += 3) {
      coefficients[0] = read[i].x;
      coefficients[1] = read[i].y;
      coefficients[2] = read[i].z;
    }
  });
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
    write_info(info, first_info, answer);
  });
}
