// Converts a host's transforms to bone matrices, which map rest space to world space.
#pragma once

#include <nook/nook_character.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/memory.h"

namespace nook {

// A host's transforms, with everything that is needed to interpret them. The host owns the memory that the
// pointers point to.
struct PoseSource {
  nook_pose_kind kind = NOOK_POSE_REST_TO_WORLD;
  nook_transform_layout layout = NOOK_TRANSFORM_ROWS_3X4;
  const float* transforms = nullptr;
  std::size_t stride = 0;                           // bytes, never 0 after check_pose_source
  std::uint32_t transform_count = 0;                // after check_pose_source: without surplus transforms
  std::uint32_t given_count = 0;                    // set by check_pose_source: the host's original
                                                    // transform_count
  std::uint32_t file_skin = 0;                      // for NOOK_POSE_SKINNING: index of the skin in the file
  std::uint32_t skin = 0;                           // index of the same skin in BindData::skins
  std::span<const std::int32_t> transform_of_bone;  // if empty, the transforms are in the order of the bones
                                                    // or of the skin's joints
  bool is_partial = false;
  bool is_strict = false;
  bool allows_surplus = false;  // ignores transforms after the ones that the model needs
  Affine place;
};

// Throws Failure if a value or index is out of range, or if the kind of transforms needs bind data and the
// model has none. Sets `skin` and given_count, sets `stride` if it is 0, and subtracts surplus transforms
// from transform_count. If transform_of_bone is not empty, it must have one entry for each bone of the model.
void check_pose_source(const CharacterModel& model, PoseSource& source, bool needs_bind_data = false);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless the host's array has one entry for each bone.
void check_bone_count(std::size_t got, std::size_t of_model);

// Throws Failure(NOOK_ERROR_UNSUPPORTED) if the model has no bind data.
void need_bind_data(const CharacterModel& model);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for a matrix that is not finite or far too large.
void check_size(const CharacterModel& model, std::size_t bone, const Mat3x4& matrix);

std::size_t floats_of_layout(nook_transform_layout layout);

// Reads one transform in the layout of the source, and returns it as a matrix. Quaternions need not have unit
// length.
Affine read_transform(const PoseSource& source, std::uint32_t index);

// Both throw Failure with INVALID_ARGUMENT.
[[noreturn]] void fail_without_transform(const CharacterModel& model, std::size_t bone);
[[noreturn]] void fail_without_joint(const CharacterModel& model, const SkinBind& skin);

// Calls body(bone, index) for each bone, with the index of the bone's transform. For a bone without a
// transform, throws Failure, or skips the bone if the source is partial.
template <class Body>
void for_each_transform(const CharacterModel& model, const PoseSource& source, Body&& body) {
  if (!source.transform_of_bone.empty()) {
    for (std::size_t b = 0; b < model.bone_count(); ++b) {
      if (source.transform_of_bone[b] >= 0)
        body(b, static_cast<std::uint32_t>(source.transform_of_bone[b]));
      else if (!source.is_partial)
        fail_without_transform(model, b);
    }
  } else if (source.kind == NOOK_POSE_SKINNING) {
    const SkinBind& skin = model.bind.skins[source.skin];
    // Different joints of a skin belong to different bones, so a skin with fewer joints than the model has
    // bones leaves bones without a transform.
    if (!source.is_partial && skin.joint_count < model.bone_count()) fail_without_joint(model, skin);
    for (std::uint32_t j = 0; j < skin.joint_count; ++j)
      body(std::size_t(model.bind.bone_of_joint[skin.first_joint + j]), j);
  } else {
    for (std::size_t b = 0; b < model.bone_count(); ++b) body(b, static_cast<std::uint32_t>(b));
  }
}

// Returns the matrix of a bone from its transform: place * transform * the bind matrix that transforms of
// this kind need.
Affine bone_matrix(const CharacterModel& model, const PoseSource& source, std::size_t bone,
                   const Affine& transform);

// Returns the joint's origin in rest space. When an uneven matrix is projected, this point does not move.
std::array<double, 3> joint_origin(const CharacterModel& model, std::size_t bone);

// Returns the similarity that is nearest to the matrix. It consists of a rotation, possibly a mirroring, and
// one scale above 0. It maps the point `fixed` to the same point as `matrix` does. A matrix that is already a
// similarity within 1e-4 is returned unchanged.
Affine projected(const Affine& matrix, const std::array<double, 3>& fixed);

// Facts for the log about a pose that was accepted. A bone is uneven if its matrix is sheared, scaled
// unevenly or has a zero axis; then it is projected.
struct PoseNotes {
  std::uint32_t bones = 0;   // number of bones that the pose set
  std::uint32_t uneven = 0;  // uneven bones among them
  std::uint32_t zero = 0;    // uneven bones whose axes are all zero
  std::uint32_t first = 0;   // the first uneven bone
  BoneAxes<double> axes;     // of the first uneven bone
  bool is_place_uneven = false;
  std::uint32_t transforms_given = 0, transforms_used = 0;  // they differ if the host gave surplus transforms

  // The messages that can be logged about a pose, as bits of a mask. The mask records which were already
  // logged, so that each is logged only once. If all matrices of the pose are zero, as in a buffer that was
  // not filled, only topic_zero is logged.
  enum Topic : std::uint32_t { topic_uneven = 1, topic_zero = 2, topic_surplus = 4 };
  std::uint32_t topics() const {
    const bool is_all_zero = bones > 0 && zero == bones;
    return (is_all_zero  ? topic_zero
            : uneven > 0 ? topic_uneven
                         : 0u) |
           (transforms_given > transforms_used ? topic_surplus : 0u);
  }
};

void note_uneven(PoseNotes& notes, std::size_t bone, const BoneAxes<double>& axes);
// Returns the notes of a pose in which only `place` can be uneven: before the multiplication by `place`, the
// bone matrices are similarities.
PoseNotes notes_of_place(const CharacterModel& model, const Mat3x4& place);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT). Call it for a bone with uneven axes in a strict scene.
[[noreturn]] void fail_uneven(const CharacterModel& model, std::size_t bone, const BoneAxes<double>& axes);

// A bit for each bone of an instance, set if its matrix was projected.
using UnevenBones = Vector<bool>;

// Converts all bones. Throws Failure for a transform that is not finite or far too large. Also throws for a
// missing transform unless the source is partial, and for an uneven transform if the source is strict.
// `bones` must have one entry for each bone of the model. `uneven` must have the same length, unless it is
// null. Only the entries of bones with a transform change. After a failure, some entries may have changed.
PoseNotes convert_pose(const CharacterModel& model, const PoseSource& source, std::span<Mat3x4> bones,
                       UnevenBones* uneven = nullptr);

// Finds a host's transforms by the names of bones.

// For each bone, writes the index of the first name in the host's list that matches, or -1. Returns the
// number of bones with -1. A bone whose own name has no match takes the transform of the first bone of its
// joint.
std::size_t map_bones(const CharacterModel& model, const nook_bone_map_desc& names,
                      std::span<std::int32_t> transform_of_bone, Memory* memory);

}  // namespace nook
