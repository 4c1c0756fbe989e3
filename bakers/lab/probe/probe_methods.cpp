#include "bakers/lab/probe/probe_methods.h"

#include <utility>

namespace nook::lab {
namespace {

using namespace bake::probe;
using nook::probe::Constraint;
using nook::probe::Denominator;
using nook::probe::FitMethod;
using nook::probe::FitSettings;
using nook::probe::Step;

FitSettings settings_of(FitMethod method, Constraint constraint = Constraint::none) {
  FitSettings settings;
  settings.method = method;
  settings.constraint = constraint;
  return settings;
}

}  // namespace

std::vector<ProbeMethod> probe_methods(std::uint32_t lobes, const Region& region) {
  const Basis gaussians = nook::probe::vogel_basis(lobes, false, region.domain, region.up);
  const Basis with_ambient = nook::probe::vogel_basis(lobes, true, region.domain, region.up);
  std::vector<ProbeMethod> methods;
  const auto add = [&](const char* name, const Basis& basis, const FitSettings& fit) {
    methods.push_back({name, basis, fit, false});
  };
  const FitSettings running = settings_of(FitMethod::running_average);
  add("naive", gaussians, settings_of(FitMethod::naive));
  add("running_average", gaussians, running);
  FitSettings variant = running;
  variant.growing_samples = 1;  // any value except 0; fit_samples replaces it by the number of samples
  add("running_average, growing weights", gaussians, variant);
  variant = running;
  variant.step = Step::plain;
  add("running_average, plain step", gaussians, variant);
  add("running_average, plain step, seeded", gaussians, variant);
  methods.back().seeded = true;
  variant.denominator = Denominator::precomputed;
  add("running_average, plain step, precomputed", gaussians, variant);
  add("running_average_original", gaussians, settings_of(FitMethod::running_average_original));
  add("running_average_non_negative", gaussians, settings_of(FitMethod::running_average_non_negative));
  add("moments", gaussians, settings_of(FitMethod::moments));
  add("least_squares", gaussians, settings_of(FitMethod::least_squares));
  add("non_negative_least_squares", gaussians, settings_of(FitMethod::non_negative_least_squares));
  constexpr std::pair<const char*, FitMethod> with_bands[] = {
      {"running_average, bands", FitMethod::running_average},
      {"running_average_non_negative, bands", FitMethod::running_average_non_negative},
      {"moments, bands", FitMethod::moments},
      {"least_squares, bands", FitMethod::least_squares},
      {"non_negative_least_squares, bands", FitMethod::non_negative_least_squares}};
  for (const auto& [name, method] : with_bands) add(name, gaussians, settings_of(method, Constraint::bands));
  if (region.domain == Domain::hemisphere) return methods;
  add("running_average, ambient", with_ambient, running);
  add("least_squares, ambient", with_ambient, settings_of(FitMethod::least_squares));
  add("non_negative_least_squares, ambient", with_ambient,
      settings_of(FitMethod::non_negative_least_squares));
  add("least_squares, ambient, bands", with_ambient,
      settings_of(FitMethod::least_squares, Constraint::bands));
  add("sh_l1", nook::probe::harmonic_basis(1), settings_of(FitMethod::least_squares));
  add("sh_l2", nook::probe::harmonic_basis(2), settings_of(FitMethod::least_squares));
  add("ambient_dice", nook::probe::dice_basis(), settings_of(FitMethod::least_squares));
  return methods;
}

}  // namespace nook::lab
