#include "sdk/src/character/pose_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/core/mirroring_similarity.h"

namespace nook {
namespace {

constexpr std::uint32_t max_transforms = 65536;

const char* name_of(const CharacterModel& model, std::size_t bone) {
  return model.bone_names[bone].c_str();
}

// Returns the index in BindData::skins of the skin that has the index file_index in the file.
std::uint32_t find_skin(const CharacterModel& model, std::uint32_t file_index) {
  const Vector<SkinBind>& skins = model.bind.skins;
  const auto found = std::find_if(skins.begin(), skins.end(),
                                  [&](const SkinBind& skin) { return skin.file_index == file_index; });
  if (found == skins.end())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.skin is not one of the model's %zu skins (got %u); nook_model_describe_skin lists "
                  "them. For a model without skins, use NOOK_POSE_JOINT_TO_WORLD",
                  skins.size(), file_index);
  return static_cast<std::uint32_t>(found - skins.begin());
}

// Kavan, Collins, Zara, O'Sullivan 2008, "Geometric Skinning with Approximate Dual Quaternion Blending",
// section 3: the translation is 2 * dual * conjugate(real).
Affine of_dual_quaternion(const float* q) {
  double real[4], dual[4], norm = 0;
  for (int i = 0; i < 4; ++i) norm += double(q[i]) * q[i];
  norm = std::sqrt(norm);
  for (int i = 0; i < 4; ++i) {
    real[i] = q[i] / norm;
    dual[i] = q[4 + i] / norm;
  }
  Trs trs;
  trs.rotation = {real[0], real[1], real[2], real[3]};
  trs.translation = {2 * (-dual[3] * real[0] + dual[0] * real[3] - dual[1] * real[2] + dual[2] * real[1]),
                     2 * (-dual[3] * real[1] + dual[0] * real[2] + dual[1] * real[3] - dual[2] * real[0]),
                     2 * (-dual[3] * real[2] - dual[0] * real[1] + dual[1] * real[0] + dual[2] * real[3])};
  return to_affine(trs);
}

Affine of_trs(const float* v) {
  double norm = 0;
  for (int i = 3; i < 7; ++i) norm += double(v[i]) * v[i];
  norm = std::sqrt(norm);
  Trs trs;
  for (int i = 0; i < 3; ++i) {
    trs.translation[i] = v[i];
    trs.scale[i] = v[7 + i];
  }
  for (int i = 0; i < 4; ++i) trs.rotation[i] = v[3 + i] / norm;
  return to_affine(trs);
}

// Without a map of the bones, only the first `expected` transforms are used.
void take_surplus_off(const CharacterModel& model, PoseSource& source, std::size_t expected) {
  const std::uint32_t got = source.transform_count;
  if (got == expected) return;
  const char* const what = source.kind == NOOK_POSE_SKINNING ? "joints of the skin" : "bones of the model";
  if (got < expected)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.transform_count is less than the number of %s (got %u, need %zu); set "
                  "desc.transform_of_bone if the transforms have another order. If your character never has "
                  "%zu, the model was baked for another one, with %zu bones and %zu vertices: load its own",
                  what, got, expected, expected, model.bone_count(), model.file_to_welded.size());
  if (!source.allows_surplus)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.transform_count is more than the number of %s (got %u, need %zu); set NOOK_POSE_FLAG_SURPLUS "
        "to use only the first %zu, or set desc.transform_of_bone if the transforms have another order. If "
        "your character always has %u, the model was baked for another one, with %zu bones and %zu vertices: "
        "load its own",
        what, got, expected, expected, got, model.bone_count(), model.file_to_welded.size());
  source.transform_count = static_cast<std::uint32_t>(expected);
}

}  // namespace

void need_bind_data(const CharacterModel& model) {
  if (model.bind.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model has no bind data; bake it again from the glTF file, or pass "
                  "NOOK_POSE_REST_TO_WORLD matrices");
}

void check_size(const CharacterModel& model, std::size_t bone, const Mat3x4& matrix) {
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(matrix.m[i]) <= (i % 4 == 3 ? max_pose_metres : max_pose_scale)))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the matrix of bone %zu (\"%s\") is not finite or far too large (element %d is %g)", bone,
                    name_of(model, bone), i, double(matrix.m[i]));
}

std::size_t floats_of_layout(nook_transform_layout layout) {
  constexpr std::size_t floats[] = {12, 16, 16, 12, 8, 10};
  return floats[layout];
}

void check_bone_count(std::size_t got, std::size_t of_model) {
  if (got != of_model)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "bone_count differs from the model's bone count (got %zu, need %zu)", got, of_model);
}

void check_pose_source(const CharacterModel& model, PoseSource& source, bool needs_bind_data) {
  check_known("desc.kind", source.kind, NOOK_POSE_SKINNING);
  check_known("desc.layout", source.layout, NOOK_TRANSFORM_TRS);
  need(source.transforms, "desc.transforms");
  const std::size_t bytes = floats_of_layout(source.layout) * sizeof(float);
  if (source.stride == 0) source.stride = bytes;
  if (source.stride < bytes || source.stride % sizeof(float))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.stride is out of range (got %zu bytes, need 0, or a multiple of 4 that is at least %zu)",
        source.stride, bytes);
  check_range("desc.transform_count", source.transform_count, 1, max_transforms);
  checked_stride("desc.stride", source.stride, source.transform_count, bytes);
  if (needs_bind_data || source.kind != NOOK_POSE_REST_TO_WORLD) need_bind_data(model);
  const bool is_skinning = source.kind == NOOK_POSE_SKINNING;
  if (is_skinning) source.skin = find_skin(model, source.file_skin);
  source.given_count = source.transform_count;
  if (source.transform_of_bone.empty())
    take_surplus_off(model, source,
                     is_skinning ? model.bind.skins[source.skin].joint_count : model.bone_count());
  for (std::size_t b = 0; b < source.transform_of_bone.size(); ++b)
    if (source.transform_of_bone[b] < -1 ||
        (source.transform_of_bone[b] >= 0 &&
         static_cast<std::uint32_t>(source.transform_of_bone[b]) >= source.transform_count))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.transform_of_bone[%zu] is out of range (got %d, need -1 to %u)", b,
                    source.transform_of_bone[b], source.transform_count - 1);
}

Affine read_transform(const PoseSource& source, std::uint32_t index) {
  float v[16] = {};
  std::memcpy(v, reinterpret_cast<const unsigned char*>(source.transforms) + index * source.stride,
              floats_of_layout(source.layout) * sizeof(float));
  Affine out;
  switch (source.layout) {
    case NOOK_TRANSFORM_ROWS_3X4:
    case NOOK_TRANSFORM_ROWS_4X4:
      std::copy_n(v, 12, out.m.begin());
      break;
    case NOOK_TRANSFORM_COLUMNS_4X4:
    case NOOK_TRANSFORM_COLUMNS_4X3: {
      const int rows = source.layout == NOOK_TRANSFORM_COLUMNS_4X4 ? 4 : 3;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) out.m[4 * i + j] = v[rows * j + i];
      break;
    }
    case NOOK_TRANSFORM_DUAL_QUATERNION:
      return of_dual_quaternion(v);
    default:
      return of_trs(v);
  }
  return out;
}

Affine bone_matrix(const CharacterModel& model, const PoseSource& source, std::size_t bone,
                   const Affine& transform) {
  const Affine placed = source.place * transform;
  if (source.kind == NOOK_POSE_JOINT_TO_WORLD)
    return placed * to_double(model.bind.bones[bone].node_from_rest);
  if (source.kind == NOOK_POSE_SKINNING)
    return placed * inverse(to_double(model.bind.rest_from_mesh[model.bind.skins[source.skin].space]));
  return placed;
}

std::array<double, 3> joint_origin(const CharacterModel& model, std::size_t bone) {
  if (model.bind.empty()) return {0, 0, 0};
  const Affine frame = inverse(to_double(model.bind.bones[bone].node_from_rest));
  return {frame.m[3], frame.m[7], frame.m[11]};
}

namespace {

// Returns true if the caller should use the matrix unchanged, because its scale is almost uniform and it has
// almost no shear. Exporters and rounding to float cause such small deviations.
bool is_kept(const BoneAxes<double>& axes) {
  constexpr double kept = 1e-4;
  const double shortest = std::min({axes.squared[0], axes.squared[1], axes.squared[2]});
  return shortest > 0 && 0.5 * (axes.longest_squared / shortest - 1) <= kept &&
         axes.shear <= kept * axes.longest_squared;
}

Affine nearest_with_one_scale(const Affine& matrix, const std::array<double, 3>& fixed) {
  return nearest_mirroring_similarity(matrix, fixed).matrix;
}

// Converts one bone. Returns true if its matrix has shear or an uneven scale.
bool convert_bone(const CharacterModel& model, const PoseSource& source, std::size_t bone,
                  std::uint32_t index, std::span<Mat3x4> bones, PoseNotes& notes) {
  const Affine matrix = bone_matrix(model, source, bone, read_transform(source, index));
  const Mat3x4 as_given = to_float(matrix);
  check_size(model, bone, as_given);
  ++notes.bones;
  const BoneAxes<double> axes = axes_of(matrix);
  const bool is_uneven = !axes.is_even();
  if (is_uneven && source.is_strict) fail_uneven(model, bone, axes);
  if (is_uneven) note_uneven(notes, bone, axes);
  bones[bone] =
      is_kept(axes) ? as_given : to_float(nearest_with_one_scale(matrix, joint_origin(model, bone)));
  return is_uneven;
}

}  // namespace

Affine projected(const Affine& matrix, const std::array<double, 3>& fixed) {
  return is_kept(axes_of(matrix)) ? matrix : nearest_with_one_scale(matrix, fixed);
}

void note_uneven(PoseNotes& notes, std::size_t bone, const BoneAxes<double>& axes) {
  if (notes.uneven++ == 0) {
    notes.first = static_cast<std::uint32_t>(bone);
    notes.axes = axes;
  }
  notes.zero += axes.longest_squared == 0;
}

PoseNotes notes_of_place(const CharacterModel& model, const Mat3x4& place) {
  PoseNotes notes;
  notes.bones = static_cast<std::uint32_t>(model.bone_count());
  const BoneAxes<double> axes = axes_of(to_double(place));
  notes.is_place_uneven = !axes.is_even();
  for (std::size_t b = 0; notes.is_place_uneven && b < model.bone_count(); ++b) note_uneven(notes, b, axes);
  return notes;
}

void fail_uneven(const CharacterModel& model, std::size_t bone, const BoneAxes<double>& axes) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the matrix of bone %zu (\"%s\") is not a rotation with one scale (its axes have lengths %g "
                "%g %g, and the largest cosine between them is %g; need lengths that agree within 1 %% and a "
                "cosine of at most 0.01); check desc.layout, because a transposed matrix looks like this. "
                "Without strict_poses and NOOK_POSE_FLAG_STRICT, Nook projects the matrix",
                bone, name_of(model, bone), axes.length(0), axes.length(1), axes.length(2), axes.cosine());
}

void fail_without_transform(const CharacterModel& model, std::size_t bone) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "bone %zu (\"%s\") has no transform; map the bone, or set NOOK_POSE_FLAG_PARTIAL and pose "
                "the other skins and rigid parts in separate calls. If your character has no such bone, the "
                "model was baked for another one, with %zu bones and %zu vertices: load its own",
                bone, name_of(model, bone), model.bone_count(), model.file_to_welded.size());
}

void fail_without_joint(const CharacterModel& model, const SkinBind& skin) {
  const auto first = model.bind.bone_of_joint.begin() + skin.first_joint;
  std::size_t bone = 0;
  while (std::find(first, first + skin.joint_count, bone) != first + skin.joint_count) ++bone;
  fail_without_transform(model, bone);
}

PoseNotes convert_pose(const CharacterModel& model, const PoseSource& source, std::span<Mat3x4> bones,
                       UnevenBones* uneven) {
  PoseNotes notes;
  notes.transforms_given = source.given_count;
  notes.transforms_used = source.transform_count;
  for_each_transform(model, source, [&](std::size_t bone, std::uint32_t index) {
    const bool is_uneven = convert_bone(model, source, bone, index, bones, notes);
    if (uneven) (*uneven)[bone] = is_uneven;
  });
  if (notes.uneven > 0) notes.is_place_uneven = !axes_of(source.place).is_even();
  return notes;
}

namespace {

constexpr std::string_view separators = "._-:|";

std::string_view text_of(const char* text) {
  return text ? std::string_view(text) : std::string_view();
}

std::string_view without(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  if (name.ends_with(suffix)) name.remove_suffix(suffix.size());
  return name;
}

// Returns the length of the prefix that all names share, up to and including its last separator. For a single
// name, returns 0.
std::size_t shared_prefix(std::span<const std::string_view> names) {
  if (names.size() < 2) return 0;
  std::string_view shared = names[0];
  for (const std::string_view name : names) {
    const auto differs = std::mismatch(shared.begin(), shared.end(), name.begin(), name.end()).first;
    shared = shared.substr(0, static_cast<std::size_t>(differs - shared.begin()));
  }
  const std::size_t last = shared.find_last_of(separators);
  return last == std::string_view::npos ? 0 : last + 1;
}

using Names = Vector<std::string_view>;

void drop_shared_prefix(Names& names, Memory* memory) {
  Names given(memory);
  for (const std::string_view name : names)
    if (!name.empty()) given.push_back(name);
  const std::size_t shared = shared_prefix(given);
  for (std::string_view& name : names)
    if (!name.empty()) name.remove_prefix(shared);
}

// Returns the normalised form of a name. Names are equal if their normalised forms are equal.
String key_of(std::string_view name, bool is_loose, Memory* memory) {
  String key(memory);
  for (const char c : name) {
    if (is_loose && (c == ' ' || separators.find(c) != std::string_view::npos)) continue;
    key += is_loose && c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return key;
}

struct KeyedIndex {
  String key;
  std::int32_t index;
};

}  // namespace

std::size_t map_bones(const CharacterModel& model, const nook_bone_map_desc& names,
                      std::span<std::int32_t> transform_of_bone, Memory* memory) {
  Names host(memory), own(memory);
  for (std::uint32_t i = 0; i < names.name_count; ++i)
    host.push_back(without(text_of(names.names[i]), text_of(names.host_prefix), text_of(names.host_suffix)));
  for (const String& name : model.bone_names)
    own.push_back(without(name, text_of(names.model_prefix), text_of(names.model_suffix)));
  if (names.flags & NOOK_BONE_MAP_DROP_SHARED_PREFIX) {
    drop_shared_prefix(host, memory);
    drop_shared_prefix(own, memory);
  }
  const bool is_loose = names.flags & NOOK_BONE_MAP_LOOSE;
  Vector<KeyedIndex> index_of(memory);
  for (std::size_t i = 0; i < host.size(); ++i)
    if (!host[i].empty())
      index_of.push_back({key_of(host[i], is_loose, memory), static_cast<std::int32_t>(i)});
  // If several host names have the same key, the first one is used.
  std::sort(index_of.begin(), index_of.end(), [](const KeyedIndex& a, const KeyedIndex& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  std::size_t unmatched = 0;
  for (std::size_t b = 0; b < own.size(); ++b) {
    const String key = key_of(own[b], is_loose, memory);
    const auto found =
        std::lower_bound(index_of.begin(), index_of.end(), key,
                         [](const KeyedIndex& entry, const String& wanted) { return entry.key < wanted; });
    std::int32_t index = found == index_of.end() || found->key != key ? -1 : found->index;
    if (index < 0 && !model.bind.empty() && model.bind.bones[b].first_of_joint < b)
      index = transform_of_bone[model.bind.bones[b].first_of_joint];
    transform_of_bone[b] = index;
    unmatched += index < 0;
  }
  return unmatched;
}

}  // namespace nook
