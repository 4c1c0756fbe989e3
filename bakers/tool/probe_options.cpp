#include "bakers/tool/probe_options.h"

#include <cstdio>
#include <vector>

#include "bakers/raytrace/instruction_set.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "sdk/src/core/geometry.h"

namespace nook::tool {
namespace {

// The names are in the order of the enums probe::FitMethod, probe::Constraint and probe::Packing.
const std::vector<std::string> method_names{
    "naive",   "running-average", "running-average-original",  "running-average-non-negative",
    "moments", "least-squares",   "non-negative-least-squares"};
const std::vector<std::string> constraint_names{"bands", "none"};
const std::vector<std::string> packing_names{"float", "half", "rgb9e5"};
const std::vector<std::string> basis_names{"gaussians", "harmonics", "dice"};

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

void add_probe_options(Command command, ProbeOptions& options) {
  command
      .add_option("--lobes", options.lobes,
                  "for --basis gaussians: number of lobes (spherical Gaussians). Their axes are spread "
                  "evenly over the sphere, on a Vogel spiral")
      .check(in_range(1u, probe::max_functions))
      .capture_default_str();
  command
      .add_option("--sharpness", options.sharpness,
                  "for --basis gaussians: sharpness of every lobe. 0 means half the number of lobes, or the "
                  "number of lobes with --hemisphere")
      .check(in_range(0.0f, probe::max_sharpness))
      .capture_default_str();
  command.add_flag("--ambient", options.ambient,
                   "for --basis gaussians: add a constant function to the lobes");
  command.add_flag("--hemisphere", options.hemisphere,
                   "fit and store only the light from above the horizon (+y is up)");
  command
      .add_option("--method", options.method,
                  "how the coefficients are fitted to the samples (docs/probes.md compares the methods)")
      .check(one_of(method_names))
      .capture_default_str();
  command
      .add_option("--constraint", options.constraint,
                  "constraint on the fit of lobes: bands (the lobes reproduce bands 0 to 2 of the light's "
                  "spherical harmonics exactly) or none (plain least squares)")
      .check(one_of(constraint_names))
      .capture_default_str();
  command
      .add_option("--basis", options.basis,
                  "functions that represent the light: gaussians (spherical Gaussians), harmonics (spherical "
                  "harmonics) or dice (ambient dice)")
      .check(one_of(basis_names))
      .capture_default_str();
  command
      .add_option("--order", options.order, "for --basis harmonics: highest band of the spherical harmonics")
      .check(in_range(1u, probe::max_order))
      .capture_default_str();
  command
      .add_option("--packing", options.packing,
                  "number format of the coefficients in the file: float (32 bits), half (16 bits) or rgb9e5 "
                  "(32 bits for the three colours together)")
      .check(one_of(packing_names))
      .capture_default_str();
}

probe::Basis basis_of(const ProbeOptions& options) {
  const probe::Domain domain = options.hemisphere ? probe::Domain::hemisphere : probe::Domain::sphere;
  const Vec3 up{0, 1, 0};
  switch (probe::BasisKind(index_of(basis_names, options.basis))) {
    case probe::BasisKind::harmonics:
      return probe::harmonic_basis(options.order, domain, up);
    case probe::BasisKind::dice:
      return probe::dice_basis(domain, up);
    default:
      break;
  }
  probe::Basis basis = probe::vogel_basis(options.lobes, options.ambient, domain, up);
  if (options.sharpness > 0)
    for (std::uint32_t i = 0; i < options.lobes; ++i) basis.sharpness[i] = options.sharpness;
  probe::check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  return basis;
}

probe::FitSettings fit_of(const ProbeOptions& options) {
  probe::FitSettings settings;
  settings.method = probe::FitMethod(index_of(method_names, options.method));
  settings.constraint = probe::Constraint(index_of(constraint_names, options.constraint));
  settings.isa = nook_isa(bake::kernel_isa());
  return settings;
}

probe::Packing packing_of(const ProbeOptions& options) {
  return probe::Packing(index_of(packing_names, options.packing));
}

nlohmann::json settings_of(const ProbeOptions& o) {
  return {{"lobes", o.lobes},           {"sharpness", o.sharpness}, {"ambient", o.ambient},
          {"hemisphere", o.hemisphere}, {"basis", o.basis},         {"method", o.method},
          {"constraint", o.constraint}, {"packing", o.packing},     {"order", o.order}};
}

nlohmann::ordered_json describe(const ProbeOptions& options, const probe::Basis& basis) {
  nlohmann::ordered_json text;
  text["basis"] = options.basis;
  text["domain"] = options.hemisphere ? "hemisphere" : "sphere";
  text["method"] = options.method;
  if (probe::meets_bands(basis, fit_of(options))) text["constraint"] = options.constraint;
  text["functions"] = basis.count;
  text["floats"] = 3 * basis.count;
  if (basis.kind == probe::BasisKind::gaussians) text["sharpness"] = basis.sharpness[0];
  text["packing"] = options.packing;
  return text;
}

std::array<std::uint32_t, 3> parse_grid_counts(const std::string& text) {
  std::array<std::uint32_t, 3> counts{};
  int used = 0;
  if (std::sscanf(text.c_str(), "%ux%ux%u%n", &counts[0], &counts[1], &counts[2], &used) != 3 ||
      std::size_t(used) != text.size() || counts[0] < 1 || counts[1] < 1 || counts[2] < 1 ||
      counts[0] > 1024 || counts[1] > 1024 || counts[2] > 1024)
    throw ToolError(
        exit_bad_arguments,
        "--grid: got " + text + ", need AxBxC: the number of probes along x, y and z, each 1 to 1024");
  return counts;
}

BoxArgument parse_grid_box(const std::string& text) {
  float v[6];
  int used = 0;
  bool good =
      std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f%n", v, v + 1, v + 2, v + 3, v + 4, v + 5, &used) == 6 &&
      std::size_t(used) == text.size();
  good = good && is_place({v[0], v[1], v[2]}) && is_place({v[3], v[4], v[5]});
  for (int i = 0; good && i < 3; ++i) good = v[i] <= v[i + 3];
  if (!good)
    throw ToolError(exit_bad_arguments, "--box: got " + text +
                                            ", need x0,y0,z0,x1,y1,z1: the low corner, then the high one, in "
                                            "metres up to 1e6");
  return {true, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

}  // namespace nook::tool
