#include <cstddef>
#include <cstring>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/occluded_directions.h"
#include "sdk/src/character/scene_readings.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

namespace {

void copy_static_ao(const CharacterModel& m, std::byte* out, std::size_t stride) {
  if (m.static_ao.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model was baked without static AO; bake it again with static AO");
  for (const std::uint32_t welded : m.file_to_welded) {
    std::memcpy(out, &m.static_ao[welded], sizeof(float));
    out += stride;
  }
}

void copy_occluded(const CharacterModel& m, std::int8_t* out, std::size_t stride) {
  if (m.occluded.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model was baked without bent normals; add them with `nook bake bent`");
  copy_occluded_directions(m, out, stride);
}

}  // namespace

nook_result nook_model_load(nook_context context, const void* bytes, size_t size, nook_model* out) {
  return api::enter("nook_model_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    const auto shared = Ref<nook_context_s>::share(context);
    const auto read = [&](Memory* memory) {
      return read_character_model({static_cast<const std::byte*>(bytes), size}, memory);
    };
    *out = Owned<nook_model_s>::make(context->memory(), shared, shared, read).detach();
    const CharacterModel& loaded = (*out)->model;
    context->log(
        NOOK_LOG_INFO, "character model: %zu vertices, %zu bones, %zu spheres, %zu key points, %zu bytes",
        loaded.vertex_count(), loaded.bone_count(), loaded.spheres.size(), loaded.key_points.size(), size);
  });
}

void nook_model_destroy(nook_model* model) {
  if (!model || !*model) return;
  (*model)->release();
  *model = nullptr;
}

nook_result nook_model_describe(nook_model model, nook_model_info* info) {
  return api::enter("nook_model_describe", [&] {
    need(model, "model");
    const CharacterModel& m = model->model;
    nook_model_info answer{};
    answer.bone_count = static_cast<uint32_t>(m.bone_count());
    answer.sphere_count = static_cast<uint32_t>(m.spheres.size());
    answer.key_point_count = static_cast<uint32_t>(m.key_points.size());
    answer.vertex_count = static_cast<uint32_t>(m.vertex_count());
    answer.file_vertex_count = static_cast<uint32_t>(m.file_to_welded.size());
    answer.primitive_count = static_cast<uint32_t>(m.primitives.size());
    answer.lod_count = static_cast<uint32_t>(1 + m.levels.size());
    answer.bounding_radius = m.bounding_radius;
    answer.gamma = m.kernel.gamma;
    answer.skin_count = static_cast<uint32_t>(m.bind.skins.size());
    answer.check_vertex_count = static_cast<uint32_t>(m.bind.vertices.size());
    answer.model_bytes = sizeof *model + model->metered.bytes();
    answer.instance_bytes = instance_bytes(*model);
    answer.lit_instance_bytes = answer.instance_bytes + light_bytes(*model);
    write_info(info, answer);
  });
}

const char* nook_model_bone_name(nook_model model, uint32_t bone) {
  return model && bone < model->model.bone_count() ? model->model.bone_names[bone].c_str() : nullptr;
}

nook_result nook_model_describe_primitive(nook_model model, uint32_t primitive, nook_range* out) {
  return api::enter("nook_model_describe_primitive", [&] {
    need(model, "model");
    need(out, "out");
    const auto& primitives = model->model.primitives;
    check_index("primitive", primitive, primitives.size());
    *out = {primitives[primitive].first_vertex, primitives[primitive].vertex_count};
  });
}

nook_result nook_model_read(nook_model model, nook_model_array array, void* out, uint32_t count,
                            size_t stride) {
  return api::enter("nook_model_read", [&] {
    need(model, "model");
    check_known("array", array, NOOK_MODEL_OCCLUDED_DIRECTIONS);
    need(out, "out");
    const CharacterModel& m = model->model;
    if (count != m.file_to_welded.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "count is not the model's file_vertex_count (got %u, need %zu)", count,
                    m.file_to_welded.size());
    const std::size_t bytes = array == NOOK_MODEL_STATIC_AO ? sizeof(float) : occluded_bytes;
    stride = checked_stride("stride", stride, count, bytes);
    if (array == NOOK_MODEL_STATIC_AO)
      copy_static_ao(m, static_cast<std::byte*>(out), stride);
    else
      copy_occluded(m, static_cast<std::int8_t*>(out), stride);
  });
}
