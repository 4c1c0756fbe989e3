#include <nook/nook_probe.h>

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/api/probe_lobes.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/probe/evaluate.h"
#include "sdk/src/probe/probe_file.h"

using namespace nook;
using namespace nook::probe;

namespace {

nook_probe_desc default_desc() {
  nook_probe_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  for (int i = 0; i < 3; ++i) {
    desc.counts[i] = 1;
    desc.spacing_ws[i] = 1;
  }
  return desc;
}
constexpr std::size_t first_desc = offsetof(nook_probe_desc, coefficients) + sizeof(const float*);
constexpr std::size_t first_info = offsetof(nook_probe_info, spacing_ws) + sizeof(float[3]);

Vec3 vec3(const float* v) {
  return {v[0], v[1], v[2]};
}

void write_vec3(float* out, Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

Probes probes_of(const nook_probe_desc& desc, nook::Memory* memory) {
  need(desc.functions, "desc.functions");
  need(desc.coefficients, "desc.coefficients");
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", desc.reserved);
  Probes probes(memory);
  probes.basis = desc.functions->fit.basis();
  for (std::size_t i = 0; i < 3; ++i) probes.grid.counts[i] = desc.counts[i];
  probes.grid.origin_ws = vec3(desc.origin_ws);
  probes.grid.spacing_ws = vec3(desc.spacing_ws);
  check_grid(probes.grid, NOOK_ERROR_INVALID_ARGUMENT);
  probes.coefficients.resize(probes.grid.size() * probes.basis.count);
  for (std::size_t i = 0; i < probes.coefficients.size(); ++i)
    probes.coefficients[i] = vec3(desc.coefficients + 3 * i);
  check_probes(probes, NOOK_ERROR_INVALID_ARGUMENT);
  return probes;
}

void check_count(const Probes& probes, std::uint32_t function_count) {
  if (function_count != probes.basis.count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "function_count is not the probe's (got %u, need %u)",
                  function_count, probes.basis.count);
}

using Coefficients = std::array<Vec3, max_functions>;

std::span<const Vec3> coefficients_at(const Probes& probes, const float* position_ws, Coefficients& storage) {
  if (!position_ws) return probes.of(0);
  const std::span<Vec3> out = std::span(storage).first(probes.basis.count);
  interpolate(probes, vec3(position_ws), out);
  return out;
}

// Calls evaluate(coefficients, direction) for each direction.
template <class Evaluate>
nook_result at_directions(const char* function, nook_probe probe, const float* position_ws,
                          const float* directions, float* rgb, std::size_t count,
                          Evaluate&& evaluate) noexcept {
  return api::enter(function, [&] {
    need(probe, "probe");
    if (count == 0) return;
    need(directions, "the array of directions");
    need(rgb, "the array for the answer");
    Coefficients storage;
    const std::span<const Vec3> coefficients = coefficients_at(probe->probes, position_ws, storage);
    for (std::size_t i = 0; i < count; ++i)
      write_vec3(rgb + 3 * i, evaluate(coefficients, vec3(directions + 3 * i)));
  });
}

}  // namespace

nook_result nook_probe_desc_init(nook_probe_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_probe_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_desc, default_desc()); });
}

nook_result nook_probe_create(nook_context context, const nook_probe_desc* desc, nook_probe* out) {
  return api::enter("nook_probe_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_probe_desc known = read_descriptor(desc, "nook_probe_desc_init", first_desc, default_desc());
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
    context->log(NOOK_LOG_INFO, "light probes: %zu of %u functions, %zu bytes", loaded.grid.size(),
                 loaded.basis.count, size);
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
    if (packing < NOOK_PROBE_PACKING_FLOAT || packing > NOOK_PROBE_PACKING_RGB9E5)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "packing is unknown (got %d, need 0 to %d)", packing,
                    NOOK_PROBE_PACKING_RGB9E5);
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
    write_info(info, first_info, answer);
  });
}

nook_result nook_probe_read_coefficients(nook_probe probe, uint32_t index, float* coefficients,
                                         uint32_t function_count) {
  return api::enter("nook_probe_read_coefficients", [&] {
    need(probe, "probe");
    need(coefficients, "coefficients");
    const Probes& probes = probe->probes;
    if (index >= probes.grid.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "index is out of range (got %u, need less than %zu)", index,
                    probes.grid.size());
    check_count(probes, function_count);
    for (const Vec3 v : probes.of(index)) {
      write_vec3(coefficients, v);
      coefficients += 3;
    }
  });
}

nook_result nook_probe_read_lobes(nook_probe probe, const float* position_ws, nook_probe_lobe* lobes,
                                  uint32_t function_count) {
  return api::enter("nook_probe_read_lobes", [&] {
    need(probe, "probe");
    need(lobes, "lobes");
    const Probes& probes = probe->probes;
    if (probes.basis.kind != BasisKind::gaussians)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the probe's functions are no lobes (got basis %d, need NOOK_PROBE_GAUSSIANS)",
                    int(probes.basis.kind));
    check_count(probes, function_count);
    Coefficients storage;
    const std::span<const Vec3> coefficients = coefficients_at(probes, position_ws, storage);
    std::array<SphericalGaussian, max_functions> read;
    to_lobes(probes.basis, coefficients, read);
    for (std::uint32_t i = 0; i < function_count; ++i) lobes[i] = api::to_public(read[i]);
  });
}

nook_result nook_probe_radiance(nook_probe probe, const float* position_ws, const float* directions,
                                float* radiance_rgb, size_t count) {
  return at_directions("nook_probe_radiance", probe, position_ws, directions, radiance_rgb, count,
                       [&](std::span<const Vec3> coefficients, Vec3 direction) {
                         return radiance(probe->probes.basis, coefficients, direction);
                       });
}

nook_result nook_probe_irradiance(nook_probe probe, const float* position_ws, nook_probe_irradiance_form form,
                                  const float* normals, float* irradiance_rgb, size_t count) {
  return at_directions("nook_probe_irradiance", probe, position_ws, normals, irradiance_rgb, count,
                       [&](std::span<const Vec3> coefficients, Vec3 normal) {
                         return irradiance(probe->probes.basis, coefficients, api::irradiance_form(form),
                                           normal);
                       });
}

nook_result nook_probe_surface_irradiance(nook_probe probe, nook_probe_irradiance_form form,
                                          const float* positions_ws, const float* normals,
                                          float* irradiance_rgb, size_t count) {
  return api::enter("nook_probe_surface_irradiance", [&] {
    need(probe, "probe");
    const IrradianceForm known = api::irradiance_form(form);
    if (count == 0) return;
    need(positions_ws, "positions_ws");
    need(normals, "normals");
    need(irradiance_rgb, "irradiance");
    const Probes& probes = probe->probes;
    Coefficients storage;
    const std::span<Vec3> coefficients = std::span(storage).first(probes.basis.count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 normal = vec3(normals + 3 * i);
      interpolate(probes, vec3(positions_ws + 3 * i), normal, coefficients);
      write_vec3(irradiance_rgb + 3 * i, irradiance(probes.basis, coefficients, known, normal));
    }
  });
}
