#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/api/probe_lobes.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/probe/probe_file.h"
#include "sdk/src/probe/probe_light.h"

using namespace nook;
using namespace nook::probe;

namespace {

Vec3 vec3(const float* v) {
  return {v[0], v[1], v[2]};
}

void write_vec3(float* out, Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

// Reads the coefficients of all probes from fits. All fits must have the same functions.
void read_fits(const nook_probe_desc& desc, Probes& probes) {
  if (desc.fit_count != probes.grid.size())
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.fit_count is not the number of probes (got %u, need %zu); pass one fit for each probe",
        desc.fit_count, probes.grid.size());
  for (std::size_t i = 0; i < desc.fit_count; ++i) {
    if (!desc.fits[i]) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.fits[%zu] is NULL", i);
    if (!(desc.fits[i]->fit.basis() == desc.fits[0]->fit.basis()))
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "desc.fits[%zu] and desc.fits[0] have different functions; create all fits with equal descriptors",
          i);
  }
  probes.basis = desc.fits[0]->fit.basis();
  probes.coefficients.resize(probes.grid.size() * probes.basis.count);
  for (std::size_t i = 0; i < desc.fit_count; ++i)
    desc.fits[i]->fit.read(
        std::span<Vec3>(probes.coefficients).subspan(i * probes.basis.count, probes.basis.count));
  if (probes.basis.kind != BasisKind::gaussians) return;
  probes.gloss.resize(probes.coefficients.size());
  for (std::size_t i = 0; i < desc.fit_count; ++i)
    desc.fits[i]->fit.read_gloss(
        std::span<Vec3>(probes.gloss).subspan(i * probes.basis.count, probes.basis.count));
}

// Returns a basis that consists of the lobes. The last one is the ambient term if its sharpness is 0.
Basis basis_of(const nook_lobe* lobes, std::uint32_t count) {
  std::array<Vec3, max_functions> axes;
  std::array<float, max_functions> sharpnesses;
  for (std::uint32_t i = 0; i < count; ++i) {
    axes[i] = vec3(lobes[i].axis);
    sharpnesses[i] = lobes[i].sharpness;
  }
  const bool ambient = count > 1 && sharpnesses[count - 1] == 0;
  const std::uint32_t own = count - (ambient ? 1 : 0);
  return gaussian_basis(std::span(axes).first(own), std::span(sharpnesses).first(own), ambient);
}

bool same_function(const nook_lobe& a, const nook_lobe& b) {
  return std::equal(a.axis, a.axis + 3, b.axis) && a.sharpness == b.sharpness;
}

void read_lobes(const nook_probe_desc& desc, Probes& probes) {
  check_range("desc.lobe_count", desc.lobe_count, 1, max_functions);
  const std::size_t count = desc.lobe_count, all = probes.grid.size() * count;
  for (std::size_t i = count; i < all; ++i)
    if (!same_function(desc.lobes[i], desc.lobes[i % count]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "lobe %zu of probe %zu differs from the same lobe of probe 0 in its axis or sharpness; "
                    "all probes need the same lobes",
                    i % count, i / count);
  probes.basis = basis_of(desc.lobes, desc.lobe_count);
  probes.coefficients.resize(all);
  for (std::size_t i = 0; i < all; ++i) probes.coefficients[i] = vec3(desc.lobes[i].amplitude);
}

void read_coefficients(const nook_probe_desc& desc, Probes& probes) {
  need(desc.functions, "desc.functions");
  need(desc.coefficients, "desc.coefficients");
  probes.basis = desc.functions->fit.basis();
  probes.coefficients.resize(probes.grid.size() * probes.basis.count);
  for (std::size_t i = 0; i < probes.coefficients.size(); ++i)
    probes.coefficients[i] = vec3(desc.coefficients + 3 * i);
}

Probes probes_of(const nook_probe_desc& desc, nook::Memory* memory) {
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", desc.reserved);
  const int sources = (desc.fits != nullptr) + (desc.lobes != nullptr) + (desc.coefficients != nullptr);
  if (sources != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc has %d sources of light, need 1; set exactly one of desc.fits, desc.lobes and "
                  "desc.coefficients",
                  sources);
  Probes probes(memory);
  for (std::size_t i = 0; i < 3; ++i) probes.grid.counts[i] = desc.counts[i];
  probes.grid.origin_ws = vec3(desc.origin_ws);
  probes.grid.spacing_ws = vec3(desc.spacing_ws);
  check_grid(probes.grid, NOOK_ERROR_INVALID_ARGUMENT);
  if (desc.fits)
    read_fits(desc, probes);
  else if (desc.lobes)
    read_lobes(desc, probes);
  else
    read_coefficients(desc, probes);
  check_probes(probes, NOOK_ERROR_INVALID_ARGUMENT);
  return probes;
}

// Returns true if the probes have no separate amplitudes for glossy reflection, and some amplitudes of their
// light are negative. Glossy reflection must then use the amplitudes of the light. Files of older versions
// can contain such probes.
bool lacks_gloss(const Probes& probes) {
  return probes.basis.kind == BasisKind::gaussians && !probes.has_gloss() &&
         std::any_of(probes.coefficients.begin(), probes.coefficients.end(), [](Vec3 v) {
           return std::min({v.x, v.y, v.z}) < 0;
         });
}

void check_lobes(const Probes& probes) {
  if (probes.basis.kind != BasisKind::gaussians)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the probe's functions are not lobes (got basis %d, need NOOK_PROBE_BASIS_LOBES)",
                  int(probes.basis.kind));
}

void write_lobes(const Basis& basis, std::span<const Vec3> coefficients, nook_lobe* lobes) {
  std::array<SphericalGaussian, max_functions> read;
  to_lobes(basis, coefficients, read);
  for (std::uint32_t i = 0; i < basis.count; ++i) lobes[i] = api::to_public(read[i]);
}

void check_count(const Probes& probes, std::uint32_t function_count) {
  if (function_count != probes.basis.count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "function_count differs from the probe's number of functions (got %u, need %u)",
                  function_count, probes.basis.count);
}

using Coefficients = std::array<Vec3, max_functions>;

std::span<const Vec3> coefficients_at(const Probes& probes, const float* position_ws, Coefficients& storage) {
  if (!position_ws) return probes.of(0);
  const std::span<Vec3> out = std::span(storage).first(probes.basis.count);
  interpolate(probes, vec3(position_ws), out);
  return out;
}

// Calls evaluate(coefficients, direction) for each direction. look_up(position, direction, out) writes the
// interpolated coefficients to `out`.
template <class LookUp, class Evaluate>
nook_result at_directions(const char* function, nook_probe probe, const float* positions_ws,
                          const float* directions, float* rgb, std::size_t count, LookUp&& look_up,
                          Evaluate&& evaluate) noexcept {
  return api::enter(function, [&] {
    need(probe, "probe");
    if (count == 0) return;
    need(directions, "the array of directions");
    need(rgb, "the array for the answer");
    check_array("count", count, 3 * sizeof(float));
    const Probes& probes = probe->probes;
    Coefficients storage;
    const std::span<Vec3> coefficients = std::span(storage).first(probes.basis.count);
    std::copy_n(probes.of(0).begin(), coefficients.size(), coefficients.begin());
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 direction = vec3(directions + 3 * i);
      if (positions_ws) look_up(probes, vec3(positions_ws + 3 * i), direction, coefficients);
      write_vec3(rgb + 3 * i, evaluate(probes.basis, coefficients, direction));
    }
  });
}

}  // namespace

nook_result nook_probe_create(nook_context context, const nook_probe_desc* desc, nook_probe* out) {
  return api::enter("nook_probe_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_probe_desc known = read_descriptor(desc);
    *out = Owned<nook_probe_s>::make(context->memory(), Ref<nook_context_s>::share(context),
                                     probes_of(known, context->memory()))
               .detach();
  });
}

nook_result nook_probe_load(nook_context context, const void* bytes, size_t size, nook_probe* out) {
  return api::enter("nook_probe_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    *out = Owned<nook_probe_s>::make(
               context->memory(), Ref<nook_context_s>::share(context),
               read_probes({static_cast<const std::byte*>(bytes), size}, context->memory()))
               .detach();
    const Probes& loaded = (*out)->probes;
    context->log(NOOK_LOG_INFO, "light probes: %zu probes with %u functions each, %zu bytes",
                 loaded.grid.size(), loaded.basis.count, size);
    if (lacks_gloss(loaded))
      context->log(NOOK_LOG_WARNING,
                   "light probes: the file has no gloss amplitudes, and some amplitudes of the light are "
                   "negative, so glossy reflections may have black patches; bake the file again");
  });
}

void nook_probe_destroy(nook_probe* probe) {
  if (!probe || !*probe) return;
  (*probe)->release();
  *probe = nullptr;
}

nook_result nook_probe_save(nook_probe probe, nook_probe_packing packing, void* bytes, size_t* size) {
  return api::enter("nook_probe_save", [&] {
    need(probe, "probe");
    need(size, "size");
    check_known("packing", packing, NOOK_PROBE_PACKING_RGB9E5);
    const std::vector<std::byte> file = write_probes(probe->probes, static_cast<Packing>(packing));
    const std::size_t room = *size;
    *size = file.size();
    if (!bytes) return;
    if (room < file.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "*size is too small (got %zu bytes, need %zu); call again with a larger buffer", room,
                    file.size());
    std::memcpy(bytes, file.data(), file.size());
  });
}

nook_result nook_probe_describe(nook_probe probe, nook_probe_info* info) {
  return api::enter("nook_probe_describe", [&] {
    need(probe, "probe");
    const Probes& probes = probe->probes;
    nook_probe_info answer{};
    answer.basis = static_cast<nook_probe_basis>(probes.basis.kind);
    answer.domain = static_cast<nook_probe_domain>(probes.basis.domain);
    write_vec3(answer.up, probes.basis.up);
    answer.function_count = probes.basis.count;
    answer.ambient = probes.basis.ambient;
    answer.order = probes.basis.order;
    answer.probe_count = static_cast<uint32_t>(probes.grid.size());
    for (std::size_t i = 0; i < 3; ++i) answer.counts[i] = probes.grid.counts[i];
    write_vec3(answer.origin_ws, probes.grid.origin_ws);
    write_vec3(answer.spacing_ws, probes.grid.spacing_ws);
    for (const CellWalls& cell : probes.walls.cell) answer.wall_cells += !cell.open();
    write_info(info, answer);
  });
}

nook_result nook_probe_read_coefficients(nook_probe probe, uint32_t index, float* coefficients,
                                         uint32_t function_count) {
  return api::enter("nook_probe_read_coefficients", [&] {
    need(probe, "probe");
    need(coefficients, "coefficients");
    const Probes& probes = probe->probes;
    check_index("index", index, probes.grid.size());
    check_count(probes, function_count);
    for (const Vec3 v : probes.of(index)) {
      write_vec3(coefficients, v);
      coefficients += 3;
    }
  });
}

nook_result nook_probe_read_lobes(nook_probe probe, const float* position_ws, nook_lobe* lobes,
                                  uint32_t function_count) {
  return api::enter("nook_probe_read_lobes", [&] {
    need(probe, "probe");
    need(lobes, "lobes");
    const Probes& probes = probe->probes;
    check_lobes(probes);
    check_count(probes, function_count);
    Coefficients storage;
    write_lobes(probes.basis, coefficients_at(probes, position_ws, storage), lobes);
  });
}

nook_result nook_probe_read_gloss(nook_probe probe, const float* position_ws, nook_lobe* lobes,
                                  uint32_t function_count) {
  return api::enter("nook_probe_read_gloss", [&] {
    need(probe, "probe");
    need(lobes, "lobes");
    const Probes& probes = probe->probes;
    check_lobes(probes);
    check_count(probes, function_count);
    if (!probes.has_gloss())
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "the probe has no gloss amplitudes, because it was not created from fits or from a file "
                    "that contains them; bake it again, or use the lobes of nook_probe_read_lobes");
    Coefficients storage;
    const std::span<Vec3> amplitudes = std::span(storage).first(probes.basis.count);
    if (position_ws)
      interpolate_gloss(probes, vec3(position_ws), amplitudes);
    else
      std::copy_n(probes.gloss.begin(), amplitudes.size(), amplitudes.begin());
    write_lobes(probes.basis, amplitudes, lobes);
  });
}

nook_result nook_probe_radiance(nook_probe probe, const float* positions_ws, const float* directions,
                                float* radiance_rgb, size_t count) {
  return at_directions(
      "nook_probe_radiance", probe, positions_ws, directions, radiance_rgb, count,
      [](const Probes& probes, Vec3 position, Vec3, std::span<Vec3> out) {
        interpolate(probes, position, out);
      },
      [](const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction) {
        return radiance(basis, coefficients, direction);
      });
}

nook_result nook_probe_irradiance(nook_probe probe, const float* positions_ws, const float* normals,
                                  float* irradiance_rgb, size_t count) {
  return at_directions(
      "nook_probe_irradiance", probe, positions_ws, normals, irradiance_rgb, count,
      [](const Probes& probes, Vec3 position, Vec3 normal, std::span<Vec3> out) {
        interpolate(probes, position, normal, out);
      },
      [](const Basis& basis, std::span<const Vec3> coefficients, Vec3 normal) {
        return irradiance(basis, coefficients, IrradianceForm::bands, normal);
      });
}
