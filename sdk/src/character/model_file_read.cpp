#include <algorithm>
#include <cmath>

#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/model_file_packing.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/geometry.h"

namespace nook {
namespace {

using Bits = CharacterBits;

// check_model decides later which values are valid. This bound only ensures that decoded values are finite.
constexpr float max_box_metres = 2 * max_metres;

void read_head(ByteReader in, CharacterModel& model) {
  model.kernel.form = static_cast<KernelForm>(in.u8());
  model.kernel.gamma = in.f32();
  model.bounding_centre.x = in.f32();
  model.bounding_centre.y = in.f32();
  model.bounding_centre.z = in.f32();
  model.bounding_radius = in.f32();
  model.root_bone = static_cast<std::uint16_t>(in.u16());
  in.check_end();
}

void read_bone_names(ByteReader in, CharacterModel& model) {
  const std::uint32_t count = in.check_count(in.varint(), 16, "bone names");
  model.bone_names.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t shared = in.varint();
    const std::uint32_t rest = in.varint();
    const std::size_t before = i == 0 ? 0 : model.bone_names.back().size();
    if (shared > before || shared > max_shared_name)
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "the name of bone %u shares too many bytes with the previous name (got %u); bake the file again", i,
          shared);
    const std::string_view tail = in.text(rest);
    String& name = model.bone_names.emplace_back();
    name.reserve(shared + rest);
    if (i > 0) name.append(model.bone_names[i - 1], 0, shared);
    name.append(tail);
  }
  in.check_end();
}

void read_spheres(ByteReader& in, Vector<ProxySphere>& spheres, int bone_bits) {
  const std::uint32_t count = in.varint();
  const Box box = read_box(in, max_box_metres);
  const Range radius = read_range(in, max_box_metres);
  const Range weight = read_range(in, max_coefficient);
  in.check_count(count, 3 * Bits::sphere_centre + Bits::sphere_radius + Bits::caster_weight, "spheres");
  spheres.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    ProxySphere& sphere = spheres.emplace_back();
    sphere.centre = read_point(in, box, Bits::sphere_centre);
    sphere.radius = radius.decode(in.bits(Bits::sphere_radius), Bits::sphere_radius);
    sphere.caster_weight = weight.decode(in.bits(Bits::caster_weight), Bits::caster_weight);
    sphere.bone = static_cast<std::uint16_t>(in.bits(bone_bits));
  }
  in.align();
}

void read_key_points(ByteReader in, CharacterModel& model) {
  const int bone_bits = index_bits(model.bone_count());
  const std::uint32_t count = in.varint();
  const Box box = read_box(in, max_box_metres);
  const Box offsets = read_box(in, max_box_metres);
  in.check_count(count, 3 * Bits::key_position + 2 * Bits::key_normal + 3 * Bits::surface_offset,
                 "key points");
  model.key_points.reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    KeyPoint& point = model.key_points.emplace_back();
    point.position = read_point(in, box, Bits::key_position);
    point.normal = read_normal(in, Bits::key_normal);
    point.surface_position = point.position + read_point(in, offsets, Bits::surface_offset);
    point.surface_normal = read_normal(in, Bits::surface_normal);
    const std::uint32_t used = in.bits(Bits::bone_count) + 1;
    std::uint32_t left = 256;
    for (std::uint32_t b = 0; b < used; ++b) {
      point.bone[b] = static_cast<std::uint16_t>(in.bits(bone_bits));
      const std::uint32_t code = b + 1 < used ? in.bits(Bits::bone_weight) : left;
      if (code == 0 || code > left)
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "the bone weights of key point %u do not sum to 1; bake the file again", k);
      point.weight[b] = static_cast<float>(code) / 256;
      left -= code;
    }
  }
  in.check_end();
}

void read_saturations(ByteReader in, CharacterModel& model) {
  const float largest = in.f32();
  if (!(largest >= 0 && largest * largest <= max_saturation))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the root of the largest saturation is out of range (got %g, need 0 to %g); bake the file "
                  "again",
                  double(largest), double(std::sqrt(max_saturation)));
  const Range root{0, largest};
  for (KeyPoint& point : model.key_points) {
    const float decoded = root.decode(in.u8(), Bits::saturation);
    point.saturation = decoded * decoded;
  }
  in.check_end();
}

void read_linear_layer(ByteReader in, CharacterModel& model) {
  const int key_point_bits = index_bits(model.key_points.size());
  const std::uint32_t vertices = in.varint();
  const std::uint32_t influences = in.u8();
  const float max_alpha = in.f32();
  const Range bias = read_range(in, max_coefficient);
  check_range("the number of influences of a vertex", influences, 1, CharacterModel::max_influences,
              NOOK_ERROR_BAD_FILE);
  if (!(max_alpha > 0 && max_alpha <= max_coefficient))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the largest alpha is out of range (got %g, need 0 to 1e4); bake the file again",
                  double(max_alpha));
  in.check_count(vertices, Bits::entry_count + Bits::alpha + Bits::bias, "vertices");
  model.influences = influences;
  model.influence.assign(std::size_t(vertices) * influences, 0);
  model.alpha.assign(std::size_t(vertices) * influences, 0.0f);
  model.blend.assign(std::size_t(vertices) * influences, 0.0f);
  model.bias.reserve(vertices);
  std::array<std::uint32_t, max_references> counts{};  // key-point counts of the earlier vertices
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const std::uint32_t count = in.bits(Bits::entry_count) + 1;
    if (count > influences)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "vertex %u has too many influences (got %u, need at most %u); bake the file again", i,
                    count, influences);
    const std::size_t first = std::size_t(i) * influences;
    std::uint32_t e = 0;
    if (i > 0) {
      const std::uint32_t back = in.bits(Bits::reference) + 1;
      if (back > i)
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "vertex %u refers to a vertex before the first one; bake the file again", i);
      const std::uint16_t* const other = &model.influence[std::size_t(i - back) * influences];
      for (std::uint32_t o = 0; o < counts[(i - back) % max_references]; ++o) {
        if (!in.bits(1)) continue;
        if (e == count)
          throw Failure(NOOK_ERROR_BAD_FILE,
                        "vertex %u copies more key points from an earlier vertex than it has in total (%u); "
                        "bake the file again",
                        i, count);
        model.influence[first + e++] = other[o];
      }
    }
    counts[i % max_references] = count;
    for (; e < count; ++e) model.influence[first + e] = static_cast<std::uint16_t>(in.bits(key_point_bits));
    for (e = 0; e < count; ++e) model.alpha[first + e] = decode_alpha(in.bits(Bits::alpha), max_alpha);
    float left = 1;  // all values are multiples of 1/16, so the arithmetic is exact
    for (e = 1; e < count; ++e) left -= model.blend[first + e] = decode_blend(in.bits(Bits::blend));
    model.blend[first] = left;
    model.bias.push_back(bias.decode(in.bits(Bits::bias), Bits::bias));
  }
  in.check_end();
}

void read_level(ByteReader& in, const CharacterModel& model, CharacterLevel& level) {
  const auto key_points = static_cast<std::uint32_t>(model.key_points.size());
  level.error_rms = in.f32();
  read_spheres(in, level.spheres, index_bits(model.bone_count()));
  const Range scale = read_range(in, max_coefficient);
  const Range offset = read_range(in, max_coefficient);
  in.check_count(key_points, 1 + Bits::level_scale + Bits::level_offset, "key points");
  for (std::uint32_t k = 0; k < key_points; ++k)
    if (in.bits(1)) level.evaluated.push_back(static_cast<std::uint16_t>(k));
  const int source_bits = index_bits(level.evaluated.size());
  level.source.reserve(key_points);
  level.scale.reserve(key_points);
  level.offset.reserve(key_points);
  for (std::uint32_t k = 0; k < key_points; ++k) {
    level.source.push_back(static_cast<std::uint16_t>(in.bits(source_bits)));
    level.scale.push_back(scale.decode(in.bits(Bits::level_scale), Bits::level_scale));
    level.offset.push_back(offset.decode(in.bits(Bits::level_offset), Bits::level_offset));
  }
  in.align();
}

void read_levels(ByteReader in, CharacterModel& model) {
  const std::uint32_t count = in.u8();
  if (count > CharacterModel::max_levels)
    throw Failure(NOOK_ERROR_BAD_FILE, "the file has too many levels of detail (got %u, need at most %zu)",
                  count, CharacterModel::max_levels);
  model.levels.reserve(count);
  for (std::uint32_t l = 0; l < count; ++l) read_level(in, model, model.levels.emplace_back());
  in.check_end();
}

void read_static_ao(ByteReader in, CharacterModel& model) {
  model.static_ao.reserve(in.remaining());
  while (in.remaining()) model.static_ao.push_back(Range{0, 1}.decode(in.u8(), 8));
}

void read_file_order(ByteReader in, CharacterModel& model) {
  const std::uint32_t count = in.varint();
  const std::uint32_t mode = in.u8();
  if (mode > 1)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section FMAP has an unknown mode (got %u, need 0 or 1); bake the file again", mode);
  in.check_count(count, 1, "file vertices");
  model.file_to_welded.reserve(count);
  const int welded_bits = std::max(1, index_bits(model.vertex_count()));
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (mode == 1)
      model.file_to_welded.push_back(in.bits(welded_bits));
    else if (in.bits(1) == 0)
      model.file_to_welded.push_back(next++);
    else
      model.file_to_welded.push_back(in.bits(index_bits(next)));
  }
  in.check_end();
}

void read_primitives(ByteReader in, CharacterModel& model) {
  const std::uint32_t count = in.check_count(in.varint(), 8, "primitives");
  model.primitives.reserve(count);
  std::uint64_t first = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t vertices = in.varint();
    model.primitives.push_back({static_cast<std::uint32_t>(first), vertices});
    first += vertices;
    if (first > model.file_to_welded.size())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "primitive %u lies outside the file vertices (ends at %llu, need at most %zu)", i,
                    static_cast<unsigned long long>(first), model.file_to_welded.size());
  }
  in.check_end();
}

Mat3x4 read_matrix(ByteReader& in) {
  Mat3x4 matrix;
  for (float& element : matrix.m) element = in.f32();
  return matrix;
}

void read_skin(ByteReader& in, BindData& bind, int bone_bits) {
  SkinBind skin;
  skin.file_index = in.varint();
  skin.space = static_cast<std::uint16_t>(std::min(in.varint(), 0xffffu));
  skin.first_joint = static_cast<std::uint32_t>(bind.bone_of_joint.size());
  // In a model with one bone, a joint takes 0 bits in the file, so the file's size does not limit
  // joint_count. Only this check limits it.
  skin.joint_count = in.varint();
  if (skin.joint_count > bind.bones.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "a skin has more joints than the model has bones (got %u, need at most %zu); bake the file "
                  "again",
                  skin.joint_count, bind.bones.size());
  for (std::uint32_t j = 0; j < skin.joint_count; ++j)
    bind.bone_of_joint.push_back(static_cast<std::uint16_t>(in.bits(bone_bits)));
  in.align();
  bind.skins.push_back(skin);
}

RestVertex read_rest_vertex(ByteReader& in) {
  RestVertex vertex;
  vertex.file_vertex = in.varint();
  vertex.position.x = in.f32();
  vertex.position.y = in.f32();
  vertex.position.z = in.f32();
  vertex.bone_count = in.u8();
  if (vertex.bone_count > RestVertex::max_bones)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "a rest vertex has too many bones (got %u, need at most %u); bake the file again",
                  vertex.bone_count, RestVertex::max_bones);
  for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
    vertex.bone[b] = static_cast<std::uint16_t>(in.u16());
    vertex.weight[b] = in.f32();
  }
  return vertex;
}

void read_bind_data(ByteReader in, CharacterModel& model) {
  constexpr std::size_t matrix_bits = 12 * 32;
  BindData& bind = model.bind;
  in.check_count(static_cast<std::uint32_t>(model.bone_count()), matrix_bits, "bones");
  bind.bones.reserve(model.bone_count());
  for (std::size_t b = 0; b < model.bone_count(); ++b) {
    BoneBind& bone = bind.bones.emplace_back();
    bone.node_from_rest = read_matrix(in);
    bone.first_of_joint = static_cast<std::uint16_t>(in.u16());
  }
  const std::uint32_t spaces = in.check_count(in.varint(), matrix_bits, "spaces of meshes");
  bind.rest_from_mesh.reserve(spaces);
  for (std::uint32_t s = 0; s < spaces; ++s) bind.rest_from_mesh.push_back(read_matrix(in));
  bind.primitive_space.reserve(model.primitives.size());
  const int space_bits = index_bits(spaces);
  for (std::size_t p = 0; p < model.primitives.size(); ++p)
    bind.primitive_space.push_back(static_cast<std::uint16_t>(in.bits(space_bits)));
  in.align();
  const std::uint32_t skins = in.check_count(in.varint(), 24, "skins");
  bind.skins.reserve(skins);
  for (std::uint32_t s = 0; s < skins; ++s) read_skin(in, bind, index_bits(model.bone_count()));
  const std::uint32_t vertices = in.check_count(in.varint(), 8 + 3 * 32 + 8, "rest vertices");
  bind.vertices.reserve(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) bind.vertices.push_back(read_rest_vertex(in));
  in.check_end();
}

float read_changed_bits(ByteReader& in, float before) {
  const int count = static_cast<int>(in.bits(Bits::float_bits));
  if (count > 32)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s stores a float with %d changed bits (need at most 32); bake the file again",
                  in.name(), count);
  return bit_cast<float>(bit_cast<std::uint32_t>(before) ^ in.bits(count));
}

BoneWeights read_close_weights(ByteReader& in, std::uint32_t welded, int bone_bits) {
  BoneWeights weights;
  weights.count = in.bits(Bits::close_bones);
  std::uint32_t left = Range::last_code(Bits::close_weight);
  if (weights.count > BoneWeights::max_bones)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "close vertex %u has too many bones (got %u, need at most %u); bake the file again", welded,
                  weights.count, BoneWeights::max_bones);
  for (std::uint32_t b = 0; b < weights.count; ++b) {
    weights.bone[b] = static_cast<std::uint16_t>(in.bits(bone_bits));
    const std::uint32_t code = b + 1 < weights.count ? in.bits(Bits::close_weight) : left;
    if (code > left)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the bone weights of close vertex %u do not sum to 1; bake the file again", welded);
    weights.weight[b] = Range{0, 1}.decode(code, Bits::close_weight);
    left -= code;
  }
  return weights;
}

void read_close_vertices(ByteReader in, CharacterModel& model) {
  const int welded_bits = index_bits(model.vertex_count());
  const int space_bits = index_bits(model.bind.rest_from_mesh.size());
  const int least_bits = welded_bits + space_bits + 3 * Bits::float_bits + Bits::close_bones;
  const std::uint32_t count =
      in.check_count(in.varint(), static_cast<std::size_t>(least_bits), "close vertices");
  model.bind.close.reserve(count);
  Vec3 before;
  for (std::uint32_t i = 0; i < count; ++i) {
    CloseVertex& vertex = model.bind.close.emplace_back();
    vertex.welded = in.bits(welded_bits);
    vertex.space = static_cast<std::uint16_t>(in.bits(space_bits));
    vertex.mesh_position.x = read_changed_bits(in, before.x);
    vertex.mesh_position.y = read_changed_bits(in, before.y);
    vertex.mesh_position.z = read_changed_bits(in, before.z);
    vertex.weights = read_close_weights(in, vertex.welded, index_bits(model.bone_count()));
    before = vertex.mesh_position;
  }
  in.check_end();
}

void read_rest_surface(ByteReader in, CharacterModel& model) {
  const Box box = read_box(in, max_box_metres);
  const std::size_t vertices = model.vertex_count();
  in.check_count(static_cast<std::uint32_t>(vertices), 3 * Bits::rest_position + 2 * Bits::rest_normal,
                 "vertices");
  model.rest.position.reserve(vertices);
  model.rest.normal.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    model.rest.position.push_back(read_point(in, box, Bits::rest_position));
    model.rest.normal.push_back(read_normal(in, Bits::rest_normal));
  }
  in.check_end();
}

void read_world_casters(ByteReader in, CharacterModel& model) {
  const int bone_bits = index_bits(model.bone_count());
  const std::uint32_t count = in.varint();
  const Box box = read_box(in, max_box_metres);
  const Range radius = read_range(in, max_box_metres);
  const Range scale = read_range(in, max_coefficient);
  in.check_count(count, 6 * Bits::world_caster_end + 2 * Bits::world_caster_radius + Bits::world_caster_scale,
                 "world casters");
  model.world_casters.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    WorldCaster& caster = model.world_casters.emplace_back();
    caster.capsule.a = read_point(in, box, Bits::world_caster_end);
    caster.capsule.b = read_point(in, box, Bits::world_caster_end);
    caster.capsule.radius_a = radius.decode(in.bits(Bits::world_caster_radius), Bits::world_caster_radius);
    caster.capsule.radius_b = radius.decode(in.bits(Bits::world_caster_radius), Bits::world_caster_radius);
    caster.ao_scale = scale.decode(in.bits(Bits::world_caster_scale), Bits::world_caster_scale);
    caster.bone = static_cast<std::uint16_t>(in.bits(bone_bits));
  }
  in.check_end();
}

void read_occluded(ByteReader in, CharacterModel& model) {
  const std::size_t vertices = model.vertex_count();
  in.check_count(static_cast<std::uint32_t>(vertices), 6 * 8, "vertices");
  model.occluded.reserve(vertices);
  const auto coordinate = [&] {
    return decode_coordinate(static_cast<std::int8_t>(static_cast<std::uint8_t>(in.u8())));
  };
  const auto vector = [&] {
    const float x = coordinate(), y = coordinate();
    return Vec3{x, y, coordinate()};
  };
  for (std::size_t i = 0; i < vertices; ++i) {
    const Vec3 dark = vector();
    model.occluded.push_back({dark, vector()});
  }
  in.check_end();
}

}  // namespace

CharacterModel read_character_model(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, character_kind);
  CharacterModel model(memory);
  read_head(file.section("HEAD"), model);
  read_bone_names(file.section("BONE"), model);
  ByteReader spheres = file.section("SPHR");
  read_spheres(spheres, model.spheres, index_bits(model.bone_count()));
  spheres.check_end();
  read_key_points(file.section("KEYP"), model);
  read_linear_layer(file.section("LINR"), model);
  if (file.has("STAO")) read_static_ao(file.section("STAO"), model);
  read_file_order(file.section("FMAP"), model);
  read_primitives(file.section("PRIM"), model);
  if (file.has("LODS")) read_levels(file.section("LODS"), model);
  if (file.has("BIND")) read_bind_data(file.section("BIND"), model);
  if (file.has("NEAR")) read_close_vertices(file.section("NEAR"), model);
  if (file.has("REST")) read_rest_surface(file.section("REST"), model);
  if (file.has("WCAS")) read_world_casters(file.section("WCAS"), model);
  if (file.has("BENT")) read_occluded(file.section("BENT"), model);
  if (file.has("SATU")) read_saturations(file.section("SATU"), model);
  ByteReader recipe = file.section("RECP");
  model.recipe = recipe.text(recipe.remaining());
  check_model(model, NOOK_ERROR_BAD_FILE);
  return model;
}

}  // namespace nook
