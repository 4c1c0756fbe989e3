// The C functions for distant light, and for lobes that are fitted to it.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/probe/probe_light.h"
#include "sdk/src/transfer/lobe_fit.h"
#include "sdk/src/transfer/transfer_check.h"

using namespace nook;
using namespace nook::transfer;

namespace {

constexpr float max_irradiance = 1e15f;

MapView map_of(const nook_transfer_light_desc& desc) {
  if (desc.layout != NOOK_TRANSFER_MAP_LATLONG && desc.layout != NOOK_TRANSFER_MAP_CUBE)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.layout is unknown (got %d); use a NOOK_TRANSFER_MAP_ value", int(desc.layout));
  if (desc.split_suns != 0 && desc.split_suns != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.split_suns is %d, need 0 or 1", desc.split_suns);
  MapView map{MapLayout(desc.layout), desc.width, desc.height, {}};
  check_map(map);
  map.rgb = {desc.rgb, 3 * map.texel_count()};
  check_map(map);
  return map;
}

Mat3x4 rotation_of(const float* rows) {
  Mat3x4 matrix;
  if (!rows) return matrix;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix.m[4 * r + c] = rows[3 * r + c];
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      float product = 0;
      for (int c = 0; c < 3; ++c) product += rows[3 * r + c] * rows[3 * s + c];
      if (!(std::abs(product - float(r == s)) <= 1e-3f))
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "light_from_shape is not a rotation: the dot product of its rows %d and %d is %g (need %d)", r, s,
            double(product), int(r == s));
    }
  return matrix;
}

void read_map(const nook_transfer_light_desc& desc, nook_transfer_light_s& light, Memory* memory) {
  MapView map = map_of(desc);
  Vector<float> rest(memory);
  if (desc.split_suns) {
    rest.assign(map.rgb.begin(), map.rgb.end());
    light.suns = take_suns(map, rest, memory);
    map.rgb = rest;
  }
  light.radiance = cell_means(map, light.cells, memory);
}

void read_probe(const nook_transfer_light_desc& desc, nook_transfer_light_s& light) {
  const nook::probe::Probes& probes = desc.probe->probes;
  std::array<Vec3, nook::probe::max_functions> storage;
  std::span<const Vec3> coefficients = probes.of(0);
  if (const float* const at = desc.position_ws) {
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(at[i]))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.position_ws is not finite (got %g)", double(at[i]));
    const std::span<Vec3> mixed = std::span(storage).first(probes.basis.count);
    interpolate(probes, {at[0], at[1], at[2]}, mixed);
    coefficients = mixed;
  }
  light.radiance.reserve(light.cells.size());
  for (const Vec3 direction : light.cells.direction)
    light.radiance.push_back(nook::probe::radiance(probes.basis, coefficients, direction));
}

void read_direction(const nook_transfer_light_desc& desc, nook_transfer_light_s& light) {
  const Vec3 d{desc.direction[0], desc.direction[1], desc.direction[2]};
  if (!(std::abs(length(d) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.direction is not of unit length (got %g); normalise it",
                  double(length(d)));
  for (const float irradiance : desc.irradiance)
    check_fits("desc.irradiance", irradiance, std::abs(irradiance) <= max_irradiance,
               "finite numbers up to 1e15");
  light.direction = normalised(d);
  light.irradiance = {desc.irradiance[0], desc.irradiance[1], desc.irradiance[2]};
}

void need_one_source(const nook_transfer_light_desc& desc) {
  const int sources = (desc.rgb != nullptr) + (desc.probe != nullptr) + (desc.direction != nullptr);
  if (sources != 1)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc has %d sources of light, need 1; set exactly one of desc.rgb, desc.probe and desc.direction",
        sources);
}

// Rotates a direction from the light's space to the shape's. The inverse of a rotation is its transpose.
Vec3 in_shape(const Mat3x4& light_from_shape, Vec3 d) {
  const float* const m = light_from_shape.m;
  return {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
          m[2] * d.x + m[6] * d.y + m[10] * d.z};
}

void check_info(const nook_transfer_light_s& light, const nook_transfer_projection_info* info) {
  if (!info) return;
  if (info->struct_size < sizeof(nook_transfer_projection_info))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "info.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                  info->struct_size, sizeof(nook_transfer_projection_info));
  if (light.is_directional())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "info is not NULL, but a light with desc.direction has no projection quality; pass NULL");
}

}  // namespace

nook_result nook_transfer_light_create(nook_context context, const nook_transfer_light_desc* desc,
                                       nook_transfer_light* out) {
  return api::enter("nook_transfer_light_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_transfer_light_desc d = read_descriptor(desc);
    need_one_source(d);
    auto light = Owned<nook_transfer_light_s>::make(context->memory(), Ref<nook_context_s>::share(context),
                                                    context, !d.direction);
    if (d.rgb) read_map(d, *light, context->memory());
    if (d.probe) read_probe(d, *light);
    if (d.direction) read_direction(d, *light);
    *out = light.detach();
  });
}

void nook_transfer_light_destroy(nook_transfer_light* light) {
  if (!light || !*light) return;
  (*light)->release();
  *light = nullptr;
}

nook_result nook_transfer_light_read_suns(nook_transfer_light light, nook_transfer_sun* suns,
                                          uint32_t* count) {
  return api::enter("nook_transfer_light_read_suns", [&] {
    need(light, "light");
    need(count, "count");
    const auto found = std::uint32_t(light->suns.size()), room = *count;
    *count = found;
    if (!suns) return;
    if (room < found)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "*count is too small (got %u, need %u); call with suns NULL to get the number", room,
                    found);
    for (std::size_t i = 0; i < found; ++i) {
      const MapSun& sun = light->suns[i];
      suns[i] = {{sun.direction.x, sun.direction.y, sun.direction.z},
                 {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z},
                 sun.solid_angle};
    }
  });
}

nook_result nook_transfer_light_project(nook_transfer_light light, uint32_t lobe_count,
                                        const float* light_from_shape, float* amplitudes,
                                        nook_transfer_projection_info* info) {
  return api::enter("nook_transfer_light_project", [&] {
    need(light, "light");
    check_lobes(lobe_count, NOOK_ERROR_INVALID_ARGUMENT);
    need(amplitudes, "amplitudes");
    check_info(*light, info);
    const Mat3x4 rotation = rotation_of(light_from_shape);
    const std::span<float> out(amplitudes, std::size_t(3) * lobe_count);
    const LobeFit& fit = light->context->lobe_fits.of(lobe_count);
    if (light->is_directional()) {
      fit.fit_direction(in_shape(rotation, light->direction), light->irradiance, out);
      return;
    }
    fit.fit(light->cells, light->radiance, rotation, out);
    if (!info) return;
    const FitQuality found = fit_quality(fit, out, light->cells, light->radiance, rotation);
    nook_transfer_projection_info known{};
    known.relative_error = float(found.relative_error);
    known.negative_share = float(found.negative_share);
    write_info(info, known);
  });
}
