#include <algorithm>
#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/material_handle.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/material/cost.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/reflectance.h"

using namespace nook;
using namespace nook::material;

namespace {

nook_material_tensor tensor_info(const ClusteredTensor& tensor, const TensorTables& tables) {
  const TensorShape& s = tensor.shape;
  return {s.rank_light, s.rank_view, s.rank_x,        s.rank_y,
          s.clusters,   s.mixture,   tensor.map.side, tables.terms};
}

std::uint64_t map_bytes(const ClusteredTensor& tensor, std::uint32_t bits) {
  return view_rows_bytes(tensor.shape, std::size_t(tensor.map.side) * tensor.map.side, bits);
}

nook_material_info info_of(const Material& material, const MaterialTables& tables) {
  nook_material_info info{};
  info.visibility = static_cast<nook_material_visibility>(material.visibility);
  info.light_count = static_cast<std::uint32_t>(material.lights.size());
  info.view_count = static_cast<std::uint32_t>(material.views.size());
  info.width = tables.btf.width;
  info.height = tables.btf.height;
  const bool is_neural = tables.neural.is_used();
  if (!is_neural) info.btf = tensor_info(material.btf, tables.btf);
  const DecodeCost decode = is_neural ? neural_decode_cost(tables.neural) : decode_cost(tables.btf),
                   light = is_neural ? neural_light_cost(tables.neural) : light_cost(tables.btf),
                   occlusion = decode_cost(tables.votf);
  const DecodeCost relief = relief_cost(tables.relief);
  info.decode_fetches = relief.fetches + decode.fetches;
  info.decode_multiply_adds = relief.multiply_adds + decode.multiply_adds;
  info.light_fetches = light.fetches;
  info.light_multiply_adds = light.multiply_adds;
  info.occlusion_fetches = occlusion.fetches;
  info.occlusion_multiply_adds = occlusion.multiply_adds;
  // In a neural material, each additional place of the footprint fetches features. In other materials, it
  // fetches the relief and the spatial modes.
  info.further_decode_fetches = is_neural ? decode.fetches : relief.fetches + further_fetches(tables.btf);
  info.further_occlusion_fetches = further_fetches(tables.votf);
  info.compressed_bytes = compressed_bytes(material);
  info.view_map_bytes = map_bytes(material.btf, material.bits);
  info.table_bytes = table_bytes(tables);
  if (is_neural) {
    info.neural_channels = material.neural.shape.channels;
    info.neural_units = material.neural.shape.units;
  }
  if (material.visibility == VisibilityForm::none) return info;
  info.visibility_threshold = material.mapping.threshold;
  info.visibility_weight = material.mapping.weight;
  info.votf = tensor_info(material.votf, tables.votf);
  info.view_map_bytes += map_bytes(material.votf, material.bits);
  return info;
}

ModeForm checked(const nook_material_desc* given) {
  if (!given) return {};
  const nook_material_desc desc = read_descriptor(given);
  if (desc.blocks < NOOK_MATERIAL_BLOCKS_NONE || desc.blocks > NOOK_MATERIAL_BLOCKS_EAC)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.blocks is not a NOOK_MATERIAL_BLOCKS value (got %d, need 0 to 2)", desc.blocks);
  check_range("desc.whole_light_modes", desc.whole_light_modes, 0, std::int32_t(max_light_modes));
  return {static_cast<BlockForm>(desc.blocks), std::uint32_t(desc.whole_light_modes)};
}

void need_finite(std::initializer_list<float> numbers, const char* what, std::uint32_t index) {
  for (const float number : numbers)
    if (!std::isfinite(number))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s %u contains a value that is not finite (got %g)", what,
                    index, double(number));
}

Pixel checked(const nook_material_pixel& given, std::uint32_t index, std::uint32_t fetches) {
  need_finite({given.uv[0], given.uv[1], given.dx[0], given.dx[1], given.dy[0], given.dy[1], given.view[0],
               given.view[1], given.view[2], given.light[0], given.light[1], given.light[2]},
              "pixel", index);
  return {{{given.uv[0], given.uv[1]}, {given.dx[0], given.dx[1]}, {given.dy[0], given.dy[1]}},
          {given.view[0], given.view[1], given.view[2]},
          {given.light[0], given.light[1], given.light[2]},
          fetches};
}

nook_material_value value_of(const MaterialTables& tables, const Radiance& radiance, float occlusion) {
  // Compression can make radiance slightly negative. Negative radiance must not be drawn.
  return {{std::max(radiance.red, 0.0f), std::max(radiance.green, 0.0f), std::max(radiance.blue, 0.0f)},
          occlusion,
          visibility_of(tables.visibility, tables.mapping, occlusion)};
}

static_assert(NOOK_MATERIAL_MAX_FETCHES == max_fetches);

}  // namespace

nook_material_s::nook_material_s(nook_context_s* made_by, const Material& loaded, const ModeForm& form)
    : tables(make_tables(loaded, made_by->parallel(), made_by->memory(), default_map_side, form)) {
  info = info_of(loaded, tables);
}

nook_result nook_material_load(nook_context context, const void* bytes, size_t size,
                               const nook_material_desc* desc, nook_material* out) {
  return api::enter("nook_material_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    const ModeForm form = checked(desc);
    const auto shared = Ref<nook_context_s>::share(context);
    const Material material = read_material({static_cast<const std::byte*>(bytes), size}, context->memory());
    *out = Owned<nook_material_s>::make(context->memory(), shared, context, material, form).detach();
    const nook_material_info& info = (*out)->info;
    context->log(NOOK_LOG_INFO,
                 "material: %u x %u texels, %u clusters, %u of them mixed in each view, %u neural channels, "
                 "%zu bytes, %llu bytes expanded",
                 info.width, info.height, info.btf.clusters, info.btf.mixture, info.neural_channels, size,
                 static_cast<unsigned long long>(info.table_bytes));
  });
}

void nook_material_destroy(nook_material* material) {
  if (!material || !*material) return;
  (*material)->release();
  *material = nullptr;
}

nook_result nook_material_describe(nook_material material, nook_material_info* info) {
  return api::enter("nook_material_describe", [&] {
    need(material, "material");
    write_info(info, material->info);
  });
}

nook_result nook_material_evaluate(nook_material material, const nook_material_pixel* pixels, uint32_t count,
                                   uint32_t fetches, nook_material_value* values) {
  return api::enter("nook_material_evaluate", [&] {
    need(material, "material");
    check_range("fetches", fetches, 1, max_fetches);
    if (count == 0) return;
    need(pixels, "pixels");
    need(values, "values");
    for (std::uint32_t i = 0; i < count; ++i) checked(pixels[i], i, fetches);
    const MaterialTables& tables = material->tables;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Pixel pixel = checked(pixels[i], i, fetches);
      values[i] = value_of(tables, evaluate_btf_pixel(tables, pixel), evaluate_votf_pixel(tables, pixel));
    }
  });
}
