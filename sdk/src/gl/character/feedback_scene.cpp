#include "sdk/src/gl/character/feedback_scene.h"

#include <cstring>

#include "shaders/character/layout.h"

namespace nook::gl {
namespace {

// The attributes of a vertex are stored together. First comes the bias. Then each group of four influences
// has its key points as 16-bit numbers, its alphas and its blend weights.
constexpr std::size_t alpha_offset = 4 * sizeof(std::uint16_t);
constexpr std::size_t blend_offset = alpha_offset + 4 * sizeof(float);
constexpr std::size_t quad_bytes = blend_offset + 4 * sizeof(float);

// Packs the attributes of welded vertices, or of file vertices if draws cannot have indices.
void pack_attributes(const FeedbackModel& sizes, bool welded, std::uint32_t first, std::uint32_t count,
                     std::byte* out) {
  const CharacterModel& model = sizes.model->model;
  const std::size_t stride = sizes.attribute_bytes();
  std::memset(out, 0, count * stride);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = welded ? first + i : model.file_to_welded[first + i];
    std::byte* const vertex = out + i * stride;
    std::memcpy(vertex, &model.bias[v], sizeof(float));
    for (std::size_t e = 0; e < model.influences; ++e) {
      const std::size_t entry = v * model.influences + e;
      std::byte* const quad = vertex + sizeof(float) + e / 4 * quad_bytes;
      std::memcpy(quad + e % 4 * sizeof(std::uint16_t), &model.influence[entry], sizeof(std::uint16_t));
      std::memcpy(quad + alpha_offset + e % 4 * sizeof(float), &model.alpha[entry], sizeof(float));
      std::memcpy(quad + blend_offset + e % 4 * sizeof(float), &model.blend[entry], sizeof(float));
    }
  }
}

void point_attributes(const Device& device, std::uint32_t quads) {
  const Functions& gl = device.gl;
  const auto stride = static_cast<GLsizei>(sizeof(float) + quads * quad_bytes);
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  gl.EnableVertexAttribArray(NOOK_ATTRIBUTE_BIAS);
  gl.VertexAttribPointer(NOOK_ATTRIBUTE_BIAS, 1, GL_FLOAT, GL_FALSE, stride, at(0));
  constexpr struct {
    GLuint key_points, alpha, blend;
  } of_quads[] = {{NOOK_ATTRIBUTE_KEY_POINTS_0, NOOK_ATTRIBUTE_ALPHA_0, NOOK_ATTRIBUTE_BLEND_0},
                  {NOOK_ATTRIBUTE_KEY_POINTS_1, NOOK_ATTRIBUTE_ALPHA_1, NOOK_ATTRIBUTE_BLEND_1}};
  for (std::uint32_t q = 0; q < quads; ++q) {
    const auto [key_points, alpha, blend] = of_quads[q];
    const std::size_t quad = sizeof(float) + q * quad_bytes;
    for (const GLuint attribute : {key_points, alpha, blend}) gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribIPointer(key_points, 4, GL_UNSIGNED_SHORT, stride, at(quad));
    gl.VertexAttribPointer(alpha, 4, GL_FLOAT, GL_FALSE, stride, at(quad + alpha_offset));
    gl.VertexAttribPointer(blend, 4, GL_FLOAT, GL_FALSE, stride, at(quad + blend_offset));
  }
}

}  // namespace

std::uint32_t FeedbackModel::attribute_bytes() const {
  return static_cast<std::uint32_t>(sizeof(float) + influence_quads() * quad_bytes);
}

void FeedbackModel::upload_piece(Device& device) {
  const bool indexed = device.gl.can.indexed_feedback;
  if (!has_attributes_) {
    const TableShape shape{"nook: linear layer", indexed ? vertices() : file_vertices(), attribute_bytes()};
    has_attributes_ = upload_.send(device, attributes, shape,
                                   [&](std::uint32_t first, std::uint32_t count, std::byte* out) {
                                     pack_attributes(*this, indexed, first, count, out);
                                   });
    return;
  }
  if (indexed) {
    const TableShape shape{"nook: file order", file_vertices(), sizeof(std::uint32_t)};
    const auto copy = [&](std::uint32_t first, std::uint32_t count, std::byte* out) {
      std::memcpy(out, model->model.file_to_welded.data() + first, count * sizeof(std::uint32_t));
    };
    if (!upload_.send(device, indices, shape, copy)) return;
  }
  describe_vertices(device);
  is_uploaded_ = true;
}

void FeedbackModel::describe_vertices(Device& device) {
  vertex_array = Object::make(device, Object::Kind::vertex_array);
  device.gl.BindVertexArray(vertex_array.name());
  device.gl.BindBuffer(GL_ARRAY_BUFFER, attributes.name());
  point_attributes(device, influence_quads());
  if (indices.name()) device.gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
  device.check("describing a model's vertices");
}

ModelMemory feedback_memory(const LoadedModel& loaded, bool indexed) {
  const CharacterModel& model = loaded.model;
  const std::uint64_t file_vertices = model.file_to_welded.size(), key_points = model.key_points.size();
  const std::uint64_t stride = sizeof(float) + (model.influences + 3) / 4 * quad_bytes;
  ModelMemory memory;
  memory.shared = indexed ? model.vertex_count() * stride + file_vertices * sizeof(std::uint32_t)
                          : file_vertices * stride;
  // The values include the share of a page that belongs to the instance. The real memory can be smaller,
  // because a page stops growing at a million key points.
  memory.instance = file_vertices * sizeof(float) + key_points * 2 * sizeof(float);
  memory.light = file_vertices * 3 * sizeof(float) + key_points * NOOK_COLOUR_VEC4S * 4 * sizeof(float);
  return memory;
}

void FeedbackScene::follow_edits(Device& device) {
  if (!outdated()) return;
  notice_edits(device);
  finish();
}

void FeedbackScene::place_within(Device& device, List<FeedbackModel>& models, const Budget& budget) {
  const auto make_chunk = [&](FeedbackModel& model, std::uint32_t capacity) -> FeedbackChunk& {
    FeedbackChunk& made = chunks.emplace_back(device, model, capacity);
    try {
      make_shadow_page(device);
    } catch (...) {
      chunks.pop_back();
      throw;
    }
    return made;
  };
  while (place_next(device, models, make_chunk) && budget.is_left()) {
  }
}

void FeedbackScene::make_buffers(Device& device) {
  make_shadow_page(device);
  make_light_buffers(device);
}

void FeedbackScene::make_shadow_page(Device& device) {
  std::uint64_t texels = 0, largest = 0;
  for (const FeedbackChunk& chunk : chunks) {
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points();
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points());
  }
  // With a million texels (8 MB) in a page, the overhead per page is negligible. A page must hold at least
  // one instance. The 65,536 texels that every OpenGL supports are enough for this, because key points have
  // 16-bit indices.
  constexpr std::uint64_t enough = 1 << 20;
  // While models stream, the page grows by half, so that it rarely grows.
  if (streaming.is_used && texels > shadows.capacity()) texels = std::max(texels, shadows.capacity() * 3 / 2);
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  shadows.reserve(device, GL_RG32F, texels, "nook: shadows");
}

void FeedbackScene::make_light_buffers(Device& device) {
  for (FeedbackChunk& chunk : chunks) {
    if (chunk.directional_ao.name() || !chunk.has_light(*scene)) continue;
    lights.make(device);
    chunk.make_directional_ao(device);
  }
  if (lights.made()) make_colour_page(device);
}

// Allocates the page for shadows and added occlusion of each channel. If the page is too small for all
// instances, it is filled and drawn several times.
void FeedbackScene::make_colour_page(Device& device) {
  std::uint64_t texels = 0, largest = 0;
  for (const FeedbackChunk& chunk : chunks) {
    if (chunk.directional_ao.name() == 0) continue;
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points() * NOOK_COLOUR_VEC4S;
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points() * NOOK_COLOUR_VEC4S);
  }
  if (largest == 0) return;
  if (largest > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "a model with a light has %llu key points, but a texture buffer of this OpenGL holds %u; "
                  "use a model with fewer key points",
                  static_cast<unsigned long long>(largest / NOOK_COLOUR_VEC4S),
                  device.max_texels / NOOK_COLOUR_VEC4S);
  constexpr std::uint64_t enough = 1 << 19;
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  colours.reserve(device, GL_RGBA32F, texels, "nook: colours of shadows");
}

}  // namespace nook::gl
