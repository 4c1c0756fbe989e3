#include "sdk/src/gl/character/compute_scene.h"

#include <cstring>

#include "sdk/src/core/floats.h"
#include "shaders/character/layout.h"

namespace nook::gl {
namespace {

// Writes numbers of a table one after another.
class Writer {
 public:
  explicit Writer(std::byte* out) : out_(out) {}
  void put(float number) { copy(&number, sizeof number); }
  void put(std::uint32_t number) { copy(&number, sizeof number); }
  void put(Vec3 v, float w) {
    for (const float number : {v.x, v.y, v.z, w}) put(number);
  }

 private:
  void copy(const void* from, std::size_t bytes) {
    std::memcpy(out_, from, bytes);
    out_ += bytes;
  }
  std::byte* out_;
};

// The tables of a model contain the elements of all levels, one level after another.

void write_sphere(Writer& out, const ProxySphere& sphere) {
  out.put(sphere.centre, sphere.radius);
  out.put({static_cast<float>(sphere.bone), sphere.caster_weight, 0}, 0);
}

// Writes spheres in the layout of spheres.comp.
void write_spheres(const ComputeModel& sizes, std::uint32_t first, std::uint32_t count, Writer out) {
  const CharacterModel& model = sizes.model->model;
  for (std::uint32_t i = first; i < first + count; ++i) {
    std::uint32_t l = sizes.level_count() - 1;
    while (i < sizes.levels[l].first_sphere) --l;
    const std::uint32_t in_level = i - sizes.levels[l].first_sphere;
    write_sphere(out, l == 0 ? model.spheres[in_level] : model.levels[l - 1].spheres[in_level]);
  }
}

void write_key_point(Writer& out, const KeyPoint& point) {
  out.put(point.position, point.saturation);
  for (const Vec3 v : {point.normal, point.surface_position, point.surface_normal}) out.put(v, 0);
  for (const std::uint16_t bone : point.bone) out.put(static_cast<float>(bone));
  for (const float weight : point.weight) out.put(weight);
}

// Writes key points in the layout of shadows.comp.
void write_key_points(const ComputeModel& sizes, std::uint32_t first, std::uint32_t count, Writer out) {
  const CharacterModel& model = sizes.model->model;
  for (std::uint32_t i = first; i < first + count; ++i) {
    std::uint32_t l = sizes.level_count() - 1;
    while (i < sizes.levels[l].first_key_point) --l;
    const std::uint32_t in_level = i - sizes.levels[l].first_key_point;
    write_key_point(out, model.key_points[l == 0 ? in_level : model.levels[l - 1].evaluated[in_level]]);
  }
}

// Writes the key points of coarser levels in the layout of spread.comp.
void write_spread(const ComputeModel& sizes, std::uint32_t first, std::uint32_t count, Writer out) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    const CharacterLevel& level = sizes.model->model.levels[i / sizes.key_points()];
    const std::uint32_t k = i % sizes.key_points();
    out.put(std::uint32_t{level.source[k]});
    out.put(level.scale[k]);
    out.put(level.offset[k]);
  }
}

// Writes a part of a row of the linear layer: the row's number for the vertices from `v` on. The rows are in
// the layout of vertices.comp.
void write_linear_row(const ComputeModel& sizes, std::uint32_t row, std::uint32_t v, std::uint32_t count,
                      Writer& out) {
  const CharacterModel& model = sizes.model->model;
  const std::uint32_t pairs = sizes.influence_pairs(), influences = model.influences;
  const auto each = [&](const auto& number) {
    for (std::uint32_t i = v; i < v + count; ++i) out.put(number(std::size_t{i} * influences));
  };
  if (row == 0) {
    for (std::uint32_t i = v; i < v + count; ++i) out.put(model.bias[i]);
  } else if (row <= pairs) {
    const std::uint32_t e = 2 * (row - 1);
    each([&](std::size_t entry) {
      const std::uint32_t second = e + 1 < influences ? model.influence[entry + e + 1] : 0u;
      return std::uint32_t{model.influence[entry + e]} | second << 16;
    });
  } else {
    const bool is_alpha = row <= 3 * pairs;
    const std::uint32_t e = row - 1 - (is_alpha ? pairs : 3 * pairs);
    const auto& numbers = is_alpha ? model.alpha : model.blend;
    each([&](std::size_t entry) { return e < influences ? numbers[entry + e] : 0.0f; });
  }
}

// Writes words of the linear layer: the welded vertex of each file vertex, then the rows.
void write_linear(const ComputeModel& sizes, std::uint32_t first, std::uint32_t count, Writer out) {
  const std::uint32_t file = sizes.file_vertices(), vertices = sizes.vertices();
  std::uint32_t at = first;
  for (; at < std::min(file, first + count); ++at) out.put(sizes.model->model.file_to_welded[at]);
  while (at < first + count) {
    const std::uint32_t row = (at - file) / vertices, v = (at - file) % vertices;
    const std::uint32_t part = std::min(vertices - v, first + count - at);
    write_linear_row(sizes, row, v, part, out);
    at += part;
  }
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

ComputeModel::ComputeModel(Ref<const LoadedModel> loaded)
    : ModelData(std::move(loaded)), levels(ranges_of(model->model)) {}

void ComputeModel::upload_piece(Device& device) {
  if (!is_uploaded() && upload_table(device)) ++uploaded_;
}

// Returns whether the table is complete.
bool ComputeModel::upload_table(Device& device) {
  constexpr std::uint32_t word = sizeof(std::uint32_t), vec4 = 4 * word;
  const LevelRange& last = levels[level_count() - 1];
  const auto writer = [this](auto write) {
    return [this, write](std::uint32_t first, std::uint32_t count, std::byte* out) {
      write(*this, first, count, Writer(out));
    };
  };
  switch (uploaded_) {
    case 0:
      return upload_.send(device, spheres_rest,
                          {"nook: rest spheres", spheres(), NOOK_REST_SPHERE_VEC4S * vec4},
                          writer(write_spheres));
    case 1:
      return upload_.send(device, key_points_rest,
                          {"nook: rest key points", std::uint64_t{last.first_key_point} + last.key_points,
                           NOOK_KEY_POINT_VEC4S * vec4},
                          writer(write_key_points));
    case 2:
      return upload_.send(device, linear,
                          {"nook: linear layer",
                           file_vertices() + vertices() * (1 + std::uint64_t{5} * influence_pairs()), word},
                          writer(write_linear));
    default:
      if (level_count() == 1) return true;
      return upload_.send(
          device, spread,
          {"nook: levels", (level_count() - 1) * std::uint64_t{key_points()}, NOOK_SPREAD_WORDS * word},
          writer(write_spread));
  }
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

namespace {

constexpr std::uint64_t sphere_size = NOOK_SPHERE_VEC4S * 4 * sizeof(float);

// Returns the size of a buffer of spheres. Throws Failure if the buffer is too large to be bound by this
// OpenGL.
std::uint64_t sphere_bytes(const Device& device, std::uint64_t count) {
  if (count * sphere_size > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the scene has %llu proxy spheres, but this OpenGL allows %llu; remove instances or use two scenes",
        static_cast<unsigned long long>(count),
        static_cast<unsigned long long>(device.max_piece_bytes / sphere_size));
  return count * sphere_size;
}

}  // namespace

// One buffer holds the world-space spheres of all chunks, because any instance may be a caster of any other
// instance.
void ComputeScene::make_sphere_buffers(Device& device) {
  std::uint64_t count = 0;
  bool moved = false;
  for (ComputeChunk& chunk : chunks) {
    moved |= chunk.first_sphere != count;
    chunk.first_sphere = static_cast<std::uint32_t>(count);
    count += chunk.spheres();
  }
  const std::uint64_t bytes = sphere_bytes(device, count);
  const bool grown = bytes > spheres.bytes();
  if (grown) spheres = Buffer(device, "nook: spheres", bytes, nullptr, GL_DYNAMIC_COPY);
  if (grown || moved)
    for (ComputeChunk& chunk : chunks)
      std::fill(chunk.transformed.begin(), chunk.transformed.end(), ComputeChunk::Pose{});
}

ComputeChunk& ComputeScene::add_chunk(Device& device, ComputeModel& model, std::uint32_t instance_capacity) {
  const std::uint64_t count = std::uint64_t{instance_capacity} * model.spheres();
  std::uint64_t first = 0;
  auto at = chunks.begin();
  for (; at != chunks.end() && at->first_sphere - first < count; ++at)
    first = at->first_sphere + at->spheres();
  grow_spheres(device, first + count);
  ComputeChunk& made = *chunks.emplace(at, device, model, instance_capacity);
  made.first_sphere = static_cast<std::uint32_t>(first);
  return made;
}

// Copies the spheres on the GPU, so that the next update need not compute all of them again.
void ComputeScene::grow_spheres(Device& device, std::uint64_t count) {
  const std::uint64_t bytes = sphere_bytes(device, count);
  if (bytes <= spheres.bytes()) return;
  const std::uint64_t kept = spheres.bytes();
  Buffer grown(device, "nook: spheres",
               std::max(bytes, std::min(kept + kept / 2, device.max_piece_bytes / sphere_size * sphere_size)),
               nullptr, GL_DYNAMIC_COPY);
  if (kept > 0) {
    device.gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, spheres.name());
    device.gl.CopyBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_ARRAY_BUFFER, 0, 0,
                                static_cast<GLsizeiptr>(kept));
  }
  spheres = std::move(grown);
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

void ComputeScene::follow_edits(Device& device) {
  if (!outdated()) return;
  notice_edits(device);
  finish();
}

void ComputeScene::place_within(Device& device, List<ComputeModel>& models, const Budget& budget) {
  const auto make_chunk = [&](ComputeModel& model, std::uint32_t capacity_wanted) -> ComputeChunk& {
    return add_chunk(device, model, capacity_wanted);
  };
  while (place_next(device, models, make_chunk) && budget.is_left()) {
  }
}

std::uint32_t ComputeScene::count_pending() const {
  const bool has_all =
      std::all_of(clips.begin(), clips.end(), [](const PlacedClips& c) { return c.is_uploaded; });
  if (has_all) return streaming.pending;
  std::uint32_t count = 0;
  for (std::uint32_t slot = 0; slot < placements.size(); ++slot)
    count += placements[slot].id && !has_data(slot);
  return count;
}

bool ComputeScene::has_data(std::uint32_t slot) const {
  const Instance& instance = scene->instances[slot];
  return placements[slot].chunk && (!instance.input.clip.is_late || number_of_clips(instance) > 0);
}

bool ComputeScene::is_ready(std::uint32_t slot) const {
  const Placement<ComputeChunk>& placement = placements[slot];
  const Instance& instance = scene->instances[slot];
  const bool is_lost = instance.input.is_posed_on_gpu && placement.chunk &&
                       placement.chunk->posed_of[placement.place] != pose_of(instance);
  return !is_lost && has_data(slot);
}

}  // namespace nook::gl
