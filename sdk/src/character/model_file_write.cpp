#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/model_file_packing.h"

namespace nook {
namespace {

using Bits = CharacterBits;

ByteWriter write_head(const CharacterModel& model) {
  ByteWriter out;
  out.u8(static_cast<std::uint32_t>(model.kernel.form));
  out.f32(model.kernel.gamma);
  out.f32(model.bounding_centre.x);
  out.f32(model.bounding_centre.y);
  out.f32(model.bounding_centre.z);
  out.f32(model.bounding_radius);
  out.u16(model.root_bone);
  return out;
}

// Uses front coding: for each name, writes how many leading bytes it shares with the previous name, then the
// remaining bytes. Bone names often share long prefixes.
ByteWriter write_bone_names(const CharacterModel& model) {
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.bone_count()));
  std::string_view before;
  for (const String& text : model.bone_names) {
    const std::string_view name = text;
    const std::string_view front = before.substr(0, max_shared_name);
    const auto shared =
        std::mismatch(front.begin(), front.end(), name.begin(), name.end()).second - name.begin();
    out.varint(static_cast<std::uint32_t>(shared));
    out.varint(static_cast<std::uint32_t>(name.size() - shared));
    out.text(name.substr(shared));
    before = name;
  }
  return out;
}

void write_spheres(ByteWriter& out, const Vector<ProxySphere>& spheres, std::size_t bones) {
  const ProxySphere& first = spheres.front();
  Box box = Box::around(first.centre);
  Range radius{first.radius, first.radius}, weight{0, 0};
  for (const ProxySphere& sphere : spheres) {
    box.include(sphere.centre);
    radius.include(sphere.radius);
    weight.include(sphere.caster_weight);
  }
  out.varint(static_cast<std::uint32_t>(spheres.size()));
  write_box(out, box);
  write_range(out, radius);
  write_range(out, weight);
  for (const ProxySphere& sphere : spheres) {
    write_point(out, box, sphere.centre, Bits::sphere_centre);
    out.bits(radius.encode(sphere.radius, Bits::sphere_radius), Bits::sphere_radius);
    out.bits(weight.encode(sphere.caster_weight, Bits::caster_weight), Bits::caster_weight);
    out.bits(sphere.bone, index_bits(bones));
  }
}

ByteWriter write_key_points(const CharacterModel& model) {
  const KeyPoint& first = model.key_points.front();
  Box box = Box::around(first.position);
  Box offsets = Box::around(first.surface_position - first.position);
  for (const KeyPoint& point : model.key_points) {
    box.include(point.position);
    offsets.include(point.surface_position - point.position);
  }
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.key_points.size()));
  write_box(out, box);
  write_box(out, offsets);
  for (const KeyPoint& point : model.key_points) {
    write_point(out, box, point.position, Bits::key_position);
    write_normal(out, point.normal, Bits::key_normal);
    write_point(out, offsets, point.surface_position - point.position, Bits::surface_offset);
    write_normal(out, point.surface_normal, Bits::surface_normal);

    const auto codes = weight_codes(point.weight);
    std::uint32_t used = 4 - static_cast<std::uint32_t>(std::count(codes.begin(), codes.end(), 0u));
    out.bits(used - 1, Bits::bone_count);
    for (int b = 0; b < KeyPoint::max_bones; ++b) {
      if (codes[b] == 0) continue;
      out.bits(point.bone[b], index_bits(model.bone_count()));
      // The last weight is not written, because the weights sum to 256.
      if (--used > 0) out.bits(codes[b], Bits::bone_weight);
    }
  }
  return out;
}

// Quantises the square root of the saturations in equal steps, so that steps are fine for small saturations.
ByteWriter write_saturations(const CharacterModel& model) {
  const Range root{0, std::sqrt(max_saturation_of(model))};
  ByteWriter out;
  out.f32(root.high);
  for (const KeyPoint& point : model.key_points)
    out.u8(root.encode(std::sqrt(point.saturation), Bits::saturation));
  return out;
}

// The entries of a vertex whose alpha is above 0. The file contains only these entries.
struct CodedEntry {
  std::uint16_t key_point = 0;
  std::uint32_t alpha = 0, blend = 0;  // codes
};
struct CodedEntries {
  std::array<CodedEntry, CharacterModel::max_influences> entry{};
  std::uint32_t count = 0;
};

// Encodes the alphas in descending order. The rounding error of each alpha is added to the next alpha, which
// has finer steps. In this way, the sum of the alphas stays accurate. The sum is what matters most, because
// neighbouring key points have similar shadows.
CodedEntries code_entries(const CharacterModel& model, std::size_t vertex, float max_alpha) {
  const float* const alpha = model.alpha.data() + vertex * model.influences;
  std::array<std::uint32_t, CharacterModel::max_influences> order{};
  CodedEntries out;
  for (std::uint32_t e = 0; e < model.influences; ++e)
    if (alpha[e] > 0) order[out.count++] = e;
  std::stable_sort(order.begin(), order.begin() + out.count,
                   [&](std::uint32_t a, std::uint32_t b) { return alpha[a] > alpha[b]; });
  double error = 0;
  for (std::uint32_t e = 0; e < out.count; ++e) {
    const double wanted = alpha[order[e]] + error;
    const std::uint32_t code = encode_alpha(static_cast<float>(wanted), max_alpha);
    const std::size_t place = vertex * model.influences + order[e];
    out.entry[e] = {model.influence[place], code, encode_blend(model.blend[place])};
    error = wanted - decode_alpha(code, max_alpha);
  }
  return out;
}

// Moves the entries of `own` whose key points also occur in `other` to the front, in the order of `other`.
// Returns their number. Bit e of `kept` is set if entry e of `other` is shared.
std::uint32_t gather_shared(CodedEntries& own, const CodedEntries& other, std::uint32_t& kept) {
  std::uint32_t shared = 0;
  kept = 0;
  for (std::uint32_t e = 0; e < other.count; ++e)
    for (std::uint32_t s = shared; s < own.count; ++s) {
      if (own.entry[s].key_point != other.entry[e].key_point) continue;
      std::swap(own.entry[s], own.entry[shared++]);
      kept |= 1u << e;
      break;
    }
  return shared;
}

// Consecutive vertices are mostly neighbours and share key points. So for each vertex, writes a reference to
// an earlier vertex, and a bit mask of the key points that are shared with it. Only the remaining key points
// are written as indices.
void write_key_points_of(ByteWriter& out, CodedEntries& own, std::span<const CodedEntries> before,
                         int key_point_bits) {
  std::uint32_t shared = 0, kept = 0;
  if (!before.empty()) {
    std::uint32_t reference = 0, most = 0;
    for (std::uint32_t r = 0; r < before.size(); ++r) {
      const std::uint32_t found = gather_shared(own, before[before.size() - 1 - r], kept);
      if (found > most) {
        most = found;
        reference = r;
      }
    }
    const CodedEntries& other = before[before.size() - 1 - reference];
    shared = gather_shared(own, other, kept);
    out.bits(reference, Bits::reference);
    out.bits(kept, static_cast<int>(other.count));
  }
  std::sort(own.entry.begin() + shared, own.entry.begin() + own.count,
            [](const CodedEntry& a, const CodedEntry& b) { return a.key_point < b.key_point; });
  for (std::uint32_t e = shared; e < own.count; ++e) out.bits(own.entry[e].key_point, key_point_bits);
}

ByteWriter write_linear_layer(const CharacterModel& model) {
  const float max_alpha = *std::max_element(model.alpha.begin(), model.alpha.end());
  Range bias{model.bias.front(), model.bias.front()};
  for (const float b : model.bias) bias.include(b);
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.vertex_count()));
  out.u8(model.influences);
  out.f32(max_alpha);
  write_range(out, bias);

  std::vector<CodedEntries> vertices;
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    vertices.push_back(code_entries(model, i, max_alpha));
    CodedEntries& own = vertices.back();
    out.bits(own.count - 1, Bits::entry_count);
    const std::size_t first = i - std::min(i, max_references);
    write_key_points_of(out, own, std::span(vertices).subspan(first, i - first),
                        index_bits(model.key_points.size()));
    for (std::uint32_t e = 0; e < own.count; ++e) out.bits(own.entry[e].alpha, Bits::alpha);
    // The first weight is not written, because the weights sum to 1.
    for (std::uint32_t e = 1; e < own.count; ++e) out.bits(own.entry[e].blend, Bits::blend);
    out.bits(bias.encode(model.bias[i], Bits::bias), Bits::bias);
  }
  return out;
}

// For each key point, writes one bit, which is set if the key point is evaluated. For key points that are not
// evaluated, also writes source, scale and offset.
void write_level(ByteWriter& out, const CharacterLevel& level, std::size_t bones) {
  out.f32(level.error_rms);
  write_spheres(out, level.spheres, bones);
  out.align();
  Range scale{level.scale[0], level.scale[0]}, offset{level.offset[0], level.offset[0]};
  for (const float s : level.scale) scale.include(s);
  for (const float o : level.offset) offset.include(o);
  write_range(out, scale);
  write_range(out, offset);
  std::size_t next = 0;
  for (std::size_t k = 0; k < level.source.size(); ++k) {
    const bool evaluated = next < level.evaluated.size() && level.evaluated[next] == k;
    out.bits(evaluated, 1);
    next += evaluated;
  }
  for (std::size_t k = 0; k < level.source.size(); ++k) {
    out.bits(level.source[k], index_bits(level.evaluated.size()));
    out.bits(scale.encode(level.scale[k], Bits::level_scale), Bits::level_scale);
    out.bits(offset.encode(level.offset[k], Bits::level_offset), Bits::level_offset);
  }
  out.align();
}

ByteWriter write_static_ao(const CharacterModel& model) {
  ByteWriter out;
  for (const float ao : model.static_ao) out.u8(Range{0, 1}.encode(ao, 8));
  return out;
}

// Mode 0 is used if the welded vertices are numbered in the order of their first occurrence. In this mode, a
// 0 bit stands for the next new vertex, and a 1 bit is followed by the index of an earlier vertex. In mode 1,
// every index is written.
ByteWriter write_file_order(const CharacterModel& model) {
  std::uint32_t next = 0;
  const bool in_order =
      std::all_of(model.file_to_welded.begin(), model.file_to_welded.end(), [&](std::uint32_t welded) {
        if (welded == next) ++next;
        return welded < next;
      });
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.file_to_welded.size()));
  out.u8(in_order ? 0 : 1);
  next = 0;
  for (const std::uint32_t welded : model.file_to_welded) {
    if (!in_order) {
      out.bits(welded, std::max(1, index_bits(model.vertex_count())));
    } else if (welded == next) {
      out.bits(0, 1);
      ++next;
    } else {
      out.bits(1, 1);
      out.bits(welded, index_bits(next));
    }
  }
  return out;
}

ByteWriter write_primitives(const CharacterModel& model) {
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.primitives.size()));
  for (const PrimitiveRange& primitive : model.primitives) out.varint(primitive.vertex_count);
  return out;
}

void write_matrix(ByteWriter& out, const Mat3x4& matrix) {
  for (const float element : matrix.m) out.f32(element);
}

ByteWriter write_bind_data(const CharacterModel& model) {
  const BindData& bind = model.bind;
  const int bone_bits = index_bits(model.bone_count()), space_bits = index_bits(bind.rest_from_mesh.size());
  ByteWriter out;
  for (const BoneBind& bone : bind.bones) {
    write_matrix(out, bone.node_from_rest);
    out.u16(bone.first_of_joint);
  }
  out.varint(static_cast<std::uint32_t>(bind.rest_from_mesh.size()));
  for (const Mat3x4& matrix : bind.rest_from_mesh) write_matrix(out, matrix);
  for (const std::uint16_t space : bind.primitive_space) out.bits(space, space_bits);
  out.align();
  out.varint(static_cast<std::uint32_t>(bind.skins.size()));
  for (const SkinBind& skin : bind.skins) {
    out.varint(skin.file_index);
    out.varint(skin.space);
    out.varint(skin.joint_count);
    for (std::uint32_t j = 0; j < skin.joint_count; ++j)
      out.bits(bind.bone_of_joint[skin.first_joint + j], bone_bits);
    out.align();
  }
  out.varint(static_cast<std::uint32_t>(bind.vertices.size()));
  for (const RestVertex& vertex : bind.vertices) {
    out.varint(vertex.file_vertex);
    out.f32(vertex.position.x);
    out.f32(vertex.position.y);
    out.f32(vertex.position.z);
    out.u8(vertex.bone_count);
    for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
      out.u16(vertex.bone[b]);
      out.f32(vertex.weight[b]);
    }
  }
  return out;
}

// Vertices that are near each other are stored one after another, so consecutive floats differ only in a few
// low bits. Writes these bits.
void write_changed_bits(ByteWriter& out, float value, float before) {
  const std::uint32_t changed = bit_cast<std::uint32_t>(value) ^ bit_cast<std::uint32_t>(before);
  const int count = std::bit_width(changed);
  out.bits(static_cast<std::uint32_t>(count), Bits::float_bits);
  out.bits(changed, count);
}

// The last weight is not written, because the weights sum to 1.
void write_close_weights(ByteWriter& out, const BoneWeights& weights, int bone_bits) {
  out.bits(weights.count, Bits::close_bones);
  std::uint32_t left = Range::last_code(Bits::close_weight);
  for (std::uint32_t b = 0; b < weights.count; ++b) {
    out.bits(weights.bone[b], bone_bits);
    if (b + 1 == weights.count) break;
    const std::uint32_t code = std::min(left, Range{0, 1}.encode(weights.weight[b], Bits::close_weight));
    out.bits(code, Bits::close_weight);
    left -= code;
  }
}

ByteWriter write_close_vertices(const CharacterModel& model) {
  const BindData& bind = model.bind;
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(bind.close.size()));
  Vec3 before;
  for (const CloseVertex& vertex : bind.close) {
    out.bits(vertex.welded, index_bits(model.vertex_count()));
    out.bits(vertex.space, index_bits(bind.rest_from_mesh.size()));
    write_changed_bits(out, vertex.mesh_position.x, before.x);
    write_changed_bits(out, vertex.mesh_position.y, before.y);
    write_changed_bits(out, vertex.mesh_position.z, before.z);
    write_close_weights(out, vertex.weights, index_bits(model.bone_count()));
    before = vertex.mesh_position;
  }
  return out;
}

ByteWriter write_rest_surface(const RestSurface& rest) {
  Box box = Box::around(rest.position.front());
  for (const Vec3 p : rest.position) box.include(p);
  ByteWriter out;
  write_box(out, box);
  for (std::size_t i = 0; i < rest.position.size(); ++i) {
    write_point(out, box, rest.position[i], Bits::rest_position);
    write_normal(out, rest.normal[i], Bits::rest_normal);
  }
  return out;
}

ByteWriter write_world_casters(const CharacterModel& model) {
  const Capsule& first = model.world_casters.front().capsule;
  Box box = Box::around(first.a);
  Range radius{first.radius_a, first.radius_a};
  Range scale{model.world_casters.front().ao_scale, model.world_casters.front().ao_scale};
  for (const WorldCaster& caster : model.world_casters) {
    box.include(caster.capsule.a);
    box.include(caster.capsule.b);
    radius.include(caster.capsule.radius_a);
    radius.include(caster.capsule.radius_b);
    scale.include(caster.ao_scale);
  }
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(model.world_casters.size()));
  write_box(out, box);
  write_range(out, radius);
  write_range(out, scale);
  for (const WorldCaster& caster : model.world_casters) {
    write_point(out, box, caster.capsule.a, Bits::world_caster_end);
    write_point(out, box, caster.capsule.b, Bits::world_caster_end);
    out.bits(radius.encode(caster.capsule.radius_a, Bits::world_caster_radius), Bits::world_caster_radius);
    out.bits(radius.encode(caster.capsule.radius_b, Bits::world_caster_radius), Bits::world_caster_radius);
    out.bits(scale.encode(caster.ao_scale, Bits::world_caster_scale), Bits::world_caster_scale);
    out.bits(caster.bone, index_bits(model.bone_count()));
  }
  return out;
}

ByteWriter write_occluded(const CharacterModel& model) {
  ByteWriter out;
  for (const OccludedEnds& ends : model.occluded)
    for (const Vec3 end : {ends.dark, ends.open})
      for (const float coordinate : {end.x, end.y, end.z})
        out.u8(static_cast<std::uint8_t>(encode_coordinate(coordinate)));
  return out;
}

}  // namespace

std::vector<std::byte> write_character_model(const CharacterModel& model) {
  check_model(model, NOOK_ERROR_INVALID_ARGUMENT);
  std::vector<ContainerSection> sections;
  const auto add = [&](const char(&name)[5], const ByteWriter& out) {
    sections.push_back({four_letters(name), out.bytes()});
  };
  add("HEAD", write_head(model));
  add("BONE", write_bone_names(model));
  ByteWriter spheres;
  write_spheres(spheres, model.spheres, model.bone_count());
  add("SPHR", spheres);
  add("KEYP", write_key_points(model));
  add("LINR", write_linear_layer(model));
  if (!model.static_ao.empty()) add("STAO", write_static_ao(model));
  add("FMAP", write_file_order(model));
  add("PRIM", write_primitives(model));
  if (!model.levels.empty()) {
    ByteWriter levels;
    levels.u8(static_cast<std::uint32_t>(model.levels.size()));
    for (const CharacterLevel& level : model.levels) write_level(levels, level, model.bone_count());
    add("LODS", levels);
  }
  if (!model.bind.empty()) add("BIND", write_bind_data(model));
  if (!model.bind.close.empty()) add("NEAR", write_close_vertices(model));
  if (!model.rest.position.empty()) add("REST", write_rest_surface(model.rest));
  if (!model.world_casters.empty()) add("WCAS", write_world_casters(model));
  if (!model.occluded.empty()) add("BENT", write_occluded(model));
  if (max_saturation_of(model) > 0) add("SATU", write_saturations(model));
  ByteWriter recipe;
  recipe.text(model.recipe);
  add("RECP", recipe);
  return write_container(character_kind, sections);
}

CharacterModel quantise(const CharacterModel& model) {
  return read_character_model(write_character_model(model));
}

}  // namespace nook
