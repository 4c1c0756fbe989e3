#include <algorithm>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/blocked_vectors.h"
#include "sdk/src/character/memory_use.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

nook_result nook_character_model_load(nook_context context, const void* bytes, size_t size,
                                      nook_character_model* out) {
  return api::enter("nook_character_model_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    const auto shared = Ref<nook_context_s>::share(context);
    const auto read = [&](Memory* memory) {
      return read_character_model({static_cast<const std::byte*>(bytes), size}, memory);
    };
    *out = Owned<nook_character_model_s>::make(context->memory(), shared, shared, read).detach();
    const CharacterModel& loaded = (*out)->model;
    context->log(
        NOOK_LOG_INFO, "character model: %zu vertices, %zu bones, %zu spheres, %zu key points, %zu bytes",
        loaded.vertex_count(), loaded.bone_count(), loaded.spheres.size(), loaded.key_points.size(), size);
  });
}

void nook_character_model_destroy(nook_character_model* model) {
  if (!model || !*model) return;
  (*model)->release();
  *model = nullptr;
}

nook_result nook_character_model_describe(nook_character_model model, nook_character_model_info* info) {
  return api::enter("nook_character_model_describe", [&] {
    need(model, "model");
    const CharacterModel& m = model->model;
    nook_character_model_info answer{};
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
    write_info(info, offsetof(nook_character_model_info, gamma) + sizeof info->gamma, answer);
  });
}

nook_result nook_character_model_memory(nook_character_model model, nook_character_memory* memory) {
  return api::enter("nook_character_model_memory", [&] {
    need(model, "model");
    nook_character_memory answer{};
    answer.model_bytes = sizeof *model + model->metered.bytes();
    answer.instance_bytes = instance_bytes(*model);
    answer.lit_instance_bytes = answer.instance_bytes + light_bytes(*model);
    write_info(memory, offsetof(nook_character_memory, lit_instance_bytes) + sizeof(uint64_t), answer);
  });
}

const char* nook_character_model_bone_name(nook_character_model model, uint32_t bone) {
  return model && bone < model->model.bone_count() ? model->model.bone_names[bone].c_str() : nullptr;
}

nook_result nook_character_model_primitive(nook_character_model model, uint32_t primitive,
                                           uint32_t* first_vertex, uint32_t* vertex_count) {
  return api::enter("nook_character_model_primitive", [&] {
    need(model, "model");
    need(first_vertex, "first_vertex");
    need(vertex_count, "vertex_count");
    const auto& primitives = model->model.primitives;
    if (primitive >= primitives.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "primitive is out of range (got %u, need less than %zu)",
                    primitive, primitives.size());
    *first_vertex = primitives[primitive].first_vertex;
    *vertex_count = primitives[primitive].vertex_count;
  });
}

nook_result nook_character_model_static_ao(nook_character_model model, float* out, uint32_t count) {
  return api::enter("nook_character_model_static_ao", [&] {
    need(model, "model");
    need(out, "out");
    const CharacterModel& m = model->model;
    if (count != m.file_to_welded.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "count is not the model's file_vertex_count (got %u, need %zu)", count,
                    m.file_to_welded.size());
    if (m.static_ao.empty())
      throw Failure(NOOK_ERROR_UNSUPPORTED, "the model was baked without static AO; bake it with it");
    std::transform(m.file_to_welded.begin(), m.file_to_welded.end(), out,
                   [&](std::uint32_t welded) { return m.static_ao[welded]; });
  });
}

nook_result nook_character_model_blocked_vectors(nook_character_model model, int8_t* out, uint32_t count,
                                                 size_t stride) {
  return api::enter("nook_character_model_blocked_vectors", [&] {
    need(model, "model");
    need(out, "out");
    const CharacterModel& m = model->model;
    if (count != m.file_to_welded.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "count is not the model's file_vertex_count (got %u, need %zu)", count,
                    m.file_to_welded.size());
    if (stride == 0) stride = blocked_bytes;
    if (stride < blocked_bytes)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "stride is too small (got %zu, need 0 or at least %zu)",
                    stride, blocked_bytes);
    if (m.blocked.empty())
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "the model was baked without bent normals; add them with `nook bake bent`");
    copy_blocked_vectors(m, out, stride);
  });
}
