#include "sdk/src/gl/character/compute_scene.h"

#include <cstring>

#include "sdk/src/core/floats.h"
#include "shaders/character/layout.h"

namespace nook::gl {
namespace {

using Words = Vector<std::uint32_t>;
using Floats = Vector<float>;

void append(Floats& out, Vec3 v, float w) {
  out.insert(out.end(), {v.x, v.y, v.z, w});
}

void append_spheres(Floats& out, const Vector<ProxySphere>& spheres) {
  for (const ProxySphere& sphere : spheres) {
    append(out, sphere.centre, sphere.radius);
    append(out, {static_cast<float>(sphere.bone), sphere.caster_weight, 0}, 0);
  }
}

// Packs the spheres of all levels, one level after another, in the layout of spheres.comp.
Floats pack_spheres(const CharacterModel& model, Memory* memory) {
  Floats out(memory);
  append_spheres(out, model.spheres);
  for (const CharacterLevel& level : model.levels) append_spheres(out, level.spheres);
  return out;
}

void append_key_point(Floats& out, const KeyPoint& point) {
  append(out, point.position, point.saturation);
  for (const Vec3 v : {point.normal, point.surface_position, point.surface_normal}) append(out, v, 0);
  for (const std::uint16_t bone : point.bone) out.push_back(bone);
  for (const float weight : point.weight) out.push_back(weight);
}

// Packs the key points of all levels, one level after another, in the layout of shadows.comp.
Floats pack_key_points(const CharacterModel& model, Memory* memory) {
  Floats out(memory);
  for (const KeyPoint& point : model.key_points) append_key_point(out, point);
  for (const CharacterLevel& level : model.levels)
    for (const std::uint16_t k : level.evaluated) append_key_point(out, model.key_points[k]);
  return out;
}

// Packs the coarser levels, one after another, in the layout of spread.comp.
Words pack_spread(const CharacterModel& model, Memory* memory) {
  Words out(memory);
  for (const CharacterLevel& level : model.levels)
    for (std::size_t k = 0; k < model.key_points.size(); ++k)
      out.insert(out.end(), {level.source[k], bit_cast<std::uint32_t>(level.scale[k]),
                             bit_cast<std::uint32_t>(level.offset[k])});
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

// Packs the linear layer in the layout of vertices.comp.
Words pack_linear(const ComputeModel& sizes, Memory* memory) {
  const CharacterModel& model = sizes.model->model;
  const std::size_t vertices = sizes.vertices(), pairs = sizes.influence_pairs();
  Words out(sizes.file_vertices() + vertices * (1 + 5 * pairs), 0, memory);
  std::memcpy(out.data(), model.file_to_welded.data(), sizes.file_vertices() * sizeof(std::uint32_t));
  std::uint32_t* const per_vertex = out.data() + sizes.file_vertices();
  for (std::size_t v = 0; v < vertices; ++v) {
    per_vertex[v] = bit_cast<std::uint32_t>(model.bias[v]);
    for (std::size_t e = 0; e < model.influences; ++e) {
      const std::size_t entry = v * model.influences + e;
      per_vertex[(1 + e / 2) * vertices + v] |= std::uint32_t{model.influence[entry]} << (16 * (e % 2));
      per_vertex[(1 + pairs + e) * vertices + v] = bit_cast<std::uint32_t>(model.alpha[entry]);
      per_vertex[(1 + 3 * pairs + e) * vertices + v] = bit_cast<std::uint32_t>(model.blend[entry]);
    }
  }
  return out;
}

}  // namespace

std::uint32_t ComputeModel::shadows() const {
  std::uint32_t max = 0;
  for (std::uint32_t l = 1; l < level_count(); ++l) max = std::max(max, levels[l].key_points);
  return key_points() + max;
}

std::uint64_t ComputeModel::largest_share() const {
  return std::max({std::uint64_t{file_vertices()} * 3 * sizeof(float),
                   std::uint64_t{shadows()} * NOOK_COLOUR_VEC4S * 4 * sizeof(float),
                   (std::uint64_t{bone_uvec4s()} + NOOK_RECORD_UVEC4S) * 4 * sizeof(std::uint32_t)});
}

ComputeModel::ComputeModel(Device& device, Ref<const LoadedModel> loaded)
    : ModelData(std::move(loaded)), levels(ranges_of(model->model)) {
  Memory* const memory = device.memory;
  const CharacterModel& m = model->model;
  spheres_rest = static_buffer(device, "nook: rest spheres", pack_spheres(m, memory));
  key_points_rest = static_buffer(device, "nook: rest key points", pack_key_points(m, memory));
  linear = static_buffer(device, "nook: linear layer", pack_linear(*this, memory));
  if (level_count() > 1) spread = static_buffer(device, "nook: levels", pack_spread(m, memory));
}

ModelMemory compute_memory(const LoadedModel& loaded) {
  const CharacterModel& model = loaded.model;
  const auto ranges = ranges_of(model);
  std::uint64_t spheres = 0, key_points = 0, coarse = 0;
  for (std::size_t l = 0; l <= model.levels.size(); ++l) {
    spheres += ranges[l].spheres;
    key_points += ranges[l].key_points;
    if (l > 0) coarse = std::max<std::uint64_t>(coarse, ranges[l].key_points);
  }
  const std::uint64_t word = sizeof(std::uint32_t), vec4 = 4 * word, all_points = model.key_points.size();
  const std::uint64_t shadows = all_points + coarse, file_vertices = model.file_to_welded.size();
  ModelMemory memory;
  memory.shared = spheres * NOOK_REST_SPHERE_VEC4S * vec4 + key_points * NOOK_KEY_POINT_VEC4S * vec4 +
                  model.levels.size() * all_points * NOOK_SPREAD_WORDS * word +
                  (file_vertices + model.vertex_count() * (1 + 5 * ((model.influences + 1) / 2))) * word;
  memory.instance = file_vertices * sizeof(float) + shadows * 2 * sizeof(float) +
                    spheres * NOOK_SPHERE_VEC4S * vec4 +
                    (NOOK_RECORD_UVEC4S + NOOK_BONE_ROWS * model.bone_count()) * vec4;
  memory.light = file_vertices * 3 * sizeof(float) + shadows * NOOK_COLOUR_VEC4S * vec4;
  return memory;
}

ComputeChunk::ComputeChunk(Device& device, ComputeModel& for_model, std::uint32_t instance_capacity)
    : ChunkData(device, for_model, instance_capacity),
      model(&for_model),
      shadows(device, "nook: shadows", std::uint64_t{capacity} * for_model.shadows() * 2 * sizeof(float),
              nullptr, GL_DYNAMIC_COPY),
      transformed(capacity, device.memory),
      posed_of(capacity, device.memory) {}

ComputeScene::ComputeScene(Device& device, const Scene& of)
    : PlacedScene(of, device.memory),
      stream(device, "nook: poses and casters", 4096, nullptr, GL_STREAM_DRAW),
      clips(device.memory),
      table(device.memory),
      candidates_(device.memory) {}

void ComputeScene::make_buffers(Device& device) {
  make_sphere_buffers(device);
  make_light_buffers(device);
  make_pool(device);
}

// One buffer holds the world-space spheres of all chunks, because any instance may be a caster of any other
// instance.
void ComputeScene::make_sphere_buffers(Device& device) {
  std::uint64_t count = 0;
  bool moved = false;
  for (ComputeChunk& chunk : chunks) {
    moved |= chunk.first_sphere != count;
    chunk.first_sphere = static_cast<std::uint32_t>(count);
    count += std::uint64_t{chunk.capacity} * chunk.model->spheres();
  }
  constexpr std::uint64_t bytes_each = NOOK_SPHERE_VEC4S * 4 * sizeof(float);
  if (count * bytes_each > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the scene has %llu proxy spheres, but this OpenGL allows %llu; remove instances or use two scenes",
        static_cast<unsigned long long>(count),
        static_cast<unsigned long long>(device.max_piece_bytes / bytes_each));
  const bool grown = count * bytes_each > spheres.bytes();
  if (grown) spheres = Buffer(device, "nook: spheres", count * bytes_each, nullptr, GL_DYNAMIC_COPY);
  if (grown || moved)
    for (ComputeChunk& chunk : chunks)
      std::fill(chunk.transformed.begin(), chunk.transformed.end(), ComputeChunk::Pose{});
}

void ComputeScene::make_light_buffers(Device& device) {
  for (ComputeChunk& chunk : chunks) {
    if (chunk.directional_ao.name() || !chunk.has_light(*scene)) continue;
    lights.make(device);
    chunk.colours =
        Buffer(device, "nook: colours of shadows",
               std::uint64_t{chunk.capacity} * chunk.model->shadows() * NOOK_COLOUR_VEC4S * 4 * sizeof(float),
               nullptr, GL_DYNAMIC_COPY);
    chunk.make_directional_ao(device);
  }
}

}  // namespace nook::gl
