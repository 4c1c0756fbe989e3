#include "sdk/src/gl/character/model_buffers.h"

#include <bit>
#include <cstring>

#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

using Words = std::pmr::vector<std::uint32_t>;
using Floats = std::pmr::vector<float>;

template <class T>
Buffer static_buffer(Device& device, const char* label, const std::pmr::vector<T>& data) {
  const std::uint64_t bytes = data.size() * sizeof(T);
  if (bytes > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "a model needs %llu bytes in one buffer, this OpenGL allows %llu; use a model with fewer vertices",
        static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(device.max_piece_bytes));
  return Buffer(device, label, bytes, data.data(), GL_STATIC_DRAW);
}

void append(Floats& out, Vec3 v, float w) {
  out.insert(out.end(), {v.x, v.y, v.z, w});
}

void append_spheres(Floats& out, const std::pmr::vector<ProxySphere>& spheres) {
  for (const ProxySphere& sphere : spheres) {
    append(out, sphere.centre, sphere.radius);
    append(out, {static_cast<float>(sphere.bone), sphere.caster_weight, 0}, 0);
  }
}

// The levels in a row, as spheres.comp reads them.
Floats pack_spheres(const CharacterModel& model, std::pmr::memory_resource* memory) {
  Floats out(memory);
  append_spheres(out, model.spheres);
  for (const CharacterLevel& level : model.levels) append_spheres(out, level.spheres);
  return out;
}

void append_key_point(Floats& out, const KeyPoint& point) {
  for (const Vec3 v : {point.position, point.normal, point.surface_position, point.surface_normal})
    append(out, v, 0);
  for (const std::uint16_t bone : point.bone) out.push_back(bone);
  for (const float weight : point.weight) out.push_back(weight);
}

// The levels in a row, as shadows.comp reads them.
Floats pack_key_points(const CharacterModel& model, std::pmr::memory_resource* memory) {
  Floats out(memory);
  for (const KeyPoint& point : model.key_points) append_key_point(out, point);
  for (const CharacterLevel& level : model.levels)
    for (const std::uint16_t k : level.evaluated) append_key_point(out, model.key_points[k]);
  return out;
}

// The coarser levels in a row, as spread.comp reads them.
Words pack_spread(const CharacterModel& model, std::pmr::memory_resource* memory) {
  Words out(memory);
  for (const CharacterLevel& level : model.levels)
    for (std::size_t k = 0; k < model.key_points.size(); ++k)
      out.insert(out.end(), {level.source[k], std::bit_cast<std::uint32_t>(level.scale[k]),
                             std::bit_cast<std::uint32_t>(level.offset[k])});
  return out;
}

std::array<LevelRange, CharacterModel::max_levels + 1> ranges_of(const CharacterModel& model) {
  std::array<LevelRange, CharacterModel::max_levels + 1> ranges{};
  ranges[0] = {0, static_cast<std::uint32_t>(model.spheres.size()), 0,
               static_cast<std::uint32_t>(model.key_points.size())};
  for (std::size_t l = 0; l < model.levels.size(); ++l)
    ranges[l + 1] = {ranges[l].first_sphere + ranges[l].spheres,
                     static_cast<std::uint32_t>(model.levels[l].spheres.size()),
                     ranges[l].first_key_point + ranges[l].key_points,
                     static_cast<std::uint32_t>(model.levels[l].evaluated.size())};
  return ranges;
}

// As vertices.comp reads it.
Words pack_linear(const ModelBuffers& sizes, std::pmr::memory_resource* memory) {
  const CharacterModel& model = sizes.model->model;
  const std::size_t vertices = sizes.vertices(), pairs = sizes.influence_pairs();
  Words out(sizes.file_vertices() + vertices * (1 + 5 * pairs), 0, memory);
  std::memcpy(out.data(), model.file_to_welded.data(), sizes.file_vertices() * sizeof(std::uint32_t));
  std::uint32_t* const per_vertex = out.data() + sizes.file_vertices();
  for (std::size_t v = 0; v < vertices; ++v) {
    per_vertex[v] = std::bit_cast<std::uint32_t>(model.bias[v]);
    for (std::size_t e = 0; e < model.influences; ++e) {
      const std::size_t entry = v * model.influences + e;
      per_vertex[(1 + e / 2) * vertices + v] |= std::uint32_t{model.influence[entry]} << (16 * (e % 2));
      per_vertex[(1 + pairs + e) * vertices + v] = std::bit_cast<std::uint32_t>(model.alpha[entry]);
      per_vertex[(1 + 3 * pairs + e) * vertices + v] = std::bit_cast<std::uint32_t>(model.blend[entry]);
    }
  }
  return out;
}

// A vertex's attributes lie together: bias, then for each four influences the key points as 16-bit numbers,
// the alphas and the blend weights.
constexpr std::size_t alpha_offset = 4 * sizeof(std::uint16_t);
constexpr std::size_t blend_offset = alpha_offset + 4 * sizeof(float);
constexpr std::size_t quad_bytes = blend_offset + 4 * sizeof(float);

std::pmr::vector<std::byte> pack_attributes(const ModelBuffers& sizes, std::pmr::memory_resource* memory) {
  const CharacterModel& model = sizes.model->model;
  const std::size_t stride = sizeof(float) + sizes.influence_quads() * quad_bytes;
  std::pmr::vector<std::byte> out(sizes.vertices() * stride, std::byte{0}, memory);
  for (std::size_t v = 0; v < sizes.vertices(); ++v) {
    std::byte* const vertex = out.data() + v * stride;
    std::memcpy(vertex, &model.bias[v], sizeof(float));
    for (std::size_t e = 0; e < model.influences; ++e) {
      const std::size_t entry = v * model.influences + e;
      std::byte* const quad = vertex + sizeof(float) + e / 4 * quad_bytes;
      std::memcpy(quad + e % 4 * sizeof(std::uint16_t), &model.influence[entry], sizeof(std::uint16_t));
      std::memcpy(quad + alpha_offset + e % 4 * sizeof(float), &model.alpha[entry], sizeof(float));
      std::memcpy(quad + blend_offset + e % 4 * sizeof(float), &model.blend[entry], sizeof(float));
    }
  }
  return out;
}

void point_attributes(const Device& device, std::uint32_t quads) {
  const Functions& gl = device.gl;
  const auto stride = static_cast<GLsizei>(sizeof(float) + quads * quad_bytes);
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  gl.EnableVertexAttribArray(0);
  gl.VertexAttribPointer(0, 1, GL_FLOAT, GL_FALSE, stride, at(0));
  for (GLuint q = 0; q < quads; ++q) {
    const std::size_t quad = sizeof(float) + q * quad_bytes;
    const GLuint first = 1 + 3 * q;
    for (GLuint slot = first; slot < first + 3; ++slot) gl.EnableVertexAttribArray(slot);
    gl.VertexAttribIPointer(first, 4, GL_UNSIGNED_SHORT, stride, at(quad));
    gl.VertexAttribPointer(first + 1, 4, GL_FLOAT, GL_FALSE, stride, at(quad + alpha_offset));
    gl.VertexAttribPointer(first + 2, 4, GL_FLOAT, GL_FALSE, stride, at(quad + blend_offset));
  }
}

}  // namespace

std::uint32_t ModelBuffers::shadows() const {
  std::uint32_t most = 0;
  for (std::uint32_t l = 1; l < level_count(); ++l) most = std::max(most, levels[l].key_points);
  return key_points() + most;
}

ModelBuffers::ModelBuffers(Device& device, Ref<const LoadedModel> loaded)
    : model(std::move(loaded)), levels(ranges_of(model->model)) {
  std::pmr::memory_resource* const memory = device.memory;
  const CharacterModel& m = model->model;
  if (device.gl.tier == 43) {
    spheres_rest = static_buffer(device, "nook: rest spheres", pack_spheres(m, memory));
    key_points_rest = static_buffer(device, "nook: rest key points", pack_key_points(m, memory));
    linear = static_buffer(device, "nook: linear layer", pack_linear(*this, memory));
    if (level_count() > 1) spread = static_buffer(device, "nook: levels", pack_spread(m, memory));
    return;
  }
  vertex_array = Object::make(device, Object::Kind::vertex_array);
  device.gl.BindVertexArray(vertex_array.name());
  attributes = static_buffer(device, "nook: linear layer", pack_attributes(*this, memory));
  point_attributes(device, influence_quads());
  indices = static_buffer(device, "nook: file order", m.file_to_welded);
  device.gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
  device.check("describing a model's vertices");
}

}  // namespace nook::gl
