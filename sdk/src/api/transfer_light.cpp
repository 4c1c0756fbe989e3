// Distant light, and lobes that are fitted to it.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/probe/evaluate.h"
#include "sdk/src/transfer/check.h"

using namespace nook;
using namespace nook::transfer;

namespace {

constexpr std::size_t first_map = offsetof(nook_transfer_map_desc, split_suns) + sizeof(std::int32_t);
constexpr std::size_t first_quality = offsetof(nook_transfer_fit_quality, negative_share) + sizeof(float);
constexpr float max_irradiance = 1e15f;

nook_transfer_map_desc default_map() {
  nook_transfer_map_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  return desc;
}

MapView checked(const nook_transfer_map_desc& desc) {
  need(desc.rgb, "desc.rgb");
  if (desc.layout != NOOK_TRANSFER_MAP_LATLONG && desc.layout != NOOK_TRANSFER_MAP_CUBE)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.layout is unknown (got %d); use a NOOK_TRANSFER_MAP_",
                  int(desc.layout));
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
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "light_from_shape is no rotation: the product of its rows %d and %d is %g (need %d)", r,
                      s, double(product), int(r == s));
    }
  return matrix;
}

void check_output(const LobeFit& fit, const float* amplitudes, std::uint32_t lobe_count) {
  need(amplitudes, "amplitudes");
  if (lobe_count != fit.lobes())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "lobe_count is not the fit's (got %u, need %u)", lobe_count,
                  fit.lobes());
}

}  // namespace

nook_result nook_transfer_map_desc_init(nook_transfer_map_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_transfer_map_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_map, default_map()); });
}

nook_result nook_transfer_light_create_map(nook_context context, const nook_transfer_map_desc* desc,
                                           nook_transfer_light* out) {
  return api::enter("nook_transfer_light_create_map", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_transfer_map_desc d =
        read_descriptor(desc, "nook_transfer_map_desc_init", first_map, default_map());
    MapView map = checked(d);
    Memory* const memory = context->memory();
    auto light = Owned<nook_transfer_light_s>::make(memory, Ref<nook_context_s>::share(context), memory);
    Vector<float> rest(memory);
    if (d.split_suns) {
      rest.assign(map.rgb.begin(), map.rgb.end());
      light->suns = take_suns(map, rest, memory);
      map.rgb = rest;
    }
    light->radiance = cell_means(map, light->cells, memory);
    *out = light.detach();
  });
}

nook_result nook_transfer_light_create_probe(nook_context context, nook_probe probe, const float* position_ws,
                                             nook_transfer_light* out) {
  return api::enter("nook_transfer_light_create_probe", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(probe, "probe");
    const nook::probe::Probes& probes = probe->probes;
    std::array<Vec3, nook::probe::max_functions> storage;
    std::span<const Vec3> coefficients = probes.of(0);
    if (position_ws) {
      for (int i = 0; i < 3; ++i)
        if (!std::isfinite(position_ws[i]))
          throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "position_ws is not finite (got %g)",
                        double(position_ws[i]));
      const std::span<Vec3> mixed = std::span(storage).first(probes.basis.count);
      interpolate(probes, {position_ws[0], position_ws[1], position_ws[2]}, mixed);
      coefficients = mixed;
    }
    Memory* const memory = context->memory();
    auto light = Owned<nook_transfer_light_s>::make(memory, Ref<nook_context_s>::share(context), memory);
    light->radiance.reserve(light->cells.size());
    for (const Vec3 direction : light->cells.direction)
      light->radiance.push_back(nook::probe::radiance(probes.basis, coefficients, direction));
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
    if (*count > 0) need(suns, "suns");
    const std::size_t written = std::min(std::size_t(*count), light->suns.size());
    for (std::size_t i = 0; i < written; ++i) {
      const MapSun& sun = light->suns[i];
      suns[i] = {{sun.direction.x, sun.direction.y, sun.direction.z},
                 {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z},
                 sun.solid_angle};
    }
    *count = std::uint32_t(light->suns.size());
  });
}

nook_result nook_transfer_fit_create(nook_context context, uint32_t lobe_count, nook_transfer_fit* out) {
  return api::enter("nook_transfer_fit_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    check_lobes(lobe_count, NOOK_ERROR_INVALID_ARGUMENT);
    *out = Owned<nook_transfer_fit_s>::make(context->memory(), Ref<nook_context_s>::share(context),
                                            context->memory(), lobe_count)
               .detach();
  });
}

void nook_transfer_fit_destroy(nook_transfer_fit* fit) {
  if (!fit || !*fit) return;
  (*fit)->release();
  *fit = nullptr;
}

nook_result nook_transfer_fit_read_axes(nook_transfer_fit fit, float* axes, uint32_t lobe_count) {
  return api::enter("nook_transfer_fit_read_axes", [&] {
    need(fit, "fit");
    check_output(fit->fit, axes, lobe_count);
    for (std::size_t j = 0; j < lobe_count; ++j) {
      const Vec3 axis = fit->fit.axes()[j];
      axes[3 * j] = axis.x;
      axes[3 * j + 1] = axis.y;
      axes[3 * j + 2] = axis.z;
    }
  });
}

nook_result nook_transfer_fit_light(nook_transfer_fit fit, nook_transfer_light light,
                                    const float* light_from_shape, float* amplitudes, uint32_t lobe_count,
                                    nook_transfer_fit_quality* quality) {
  return api::enter("nook_transfer_fit_light", [&] {
    need(fit, "fit");
    need(light, "light");
    check_output(fit->fit, amplitudes, lobe_count);
    if (quality && quality->struct_size < first_quality)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "quality.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                    quality->struct_size, first_quality);
    const Mat3x4 rotation = rotation_of(light_from_shape);
    const std::span<float> out(amplitudes, std::size_t(3) * lobe_count);
    fit->fit.fit(light->cells, light->radiance, rotation, out);
    if (!quality) return;
    const FitQuality found = fit_quality(fit->fit, out, light->cells, light->radiance, rotation);
    nook_transfer_fit_quality known{};
    known.relative_error = float(found.relative_error);
    known.negative_share = float(found.negative_share);
    write_info(quality, first_quality, known);
  });
}

nook_result nook_transfer_fit_directional(nook_transfer_fit fit, const float* direction,
                                          const float* irradiance, float* amplitudes, uint32_t lobe_count) {
  return api::enter("nook_transfer_fit_directional", [&] {
    need(fit, "fit");
    need(direction, "direction");
    need(irradiance, "irradiance");
    check_output(fit->fit, amplitudes, lobe_count);
    const Vec3 d{direction[0], direction[1], direction[2]};
    if (!(std::abs(length(d) - 1) <= 1e-3f))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "direction has no unit length (got %g); normalise it",
                    double(length(d)));
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(irradiance[c]) <= max_irradiance))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "irradiance is out of range (got %g, need finite numbers up to 1e15)",
                      double(irradiance[c]));
    fit->fit.fit_direction(normalised(d), {irradiance[0], irradiance[1], irradiance[2]},
                           {amplitudes, std::size_t(3) * lobe_count});
  });
}
