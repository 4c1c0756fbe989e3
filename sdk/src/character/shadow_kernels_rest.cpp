#include "sdk/src/character/shadow_kernels_rest.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook {
namespace {

void check_bone(const CharacterModel& model, std::uint16_t bone, const char* owner, std::size_t index) {
  if (bone >= model.bone_count())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s %zu follows bone %u, which the model does not have (need less than %zu)", owner, index,
                  static_cast<unsigned>(bone), model.bone_count());
}

// Returns six consecutive arrays of `stride` elements each.
KeyPointSoa six_arrays(const float* first, std::uint32_t stride) {
  return {
      first, first + stride, first + 2 * stride, first + 3 * stride, first + 4 * stride, first + 5 * stride,
      stride};
}

void write_six(float* first, std::uint32_t stride, std::uint32_t index, Vec3 position, Vec3 normal) {
  const float value[6] = {position.x, position.y, position.z, normal.x, normal.y, normal.z};
  for (std::uint32_t a = 0; a < 6; ++a) first[a * stride + index] = value[a];
}

}  // namespace

RestSpheres::RestSpheres(const CharacterModel& model, Memory* memory)
    : numbers_(5 * padded_count(model.spheres.size()), memory),
      bone_(padded_count(model.spheres.size()), memory) {
  const std::size_t stride = padded_count(model.spheres.size());
  float* numbers = numbers_.data();
  for (std::size_t i = 0; i < model.spheres.size(); ++i) {
    const ProxySphere& sphere = model.spheres[i];
    check_bone(model, sphere.bone, "proxy sphere", i);
    const float value[5] = {sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius,
                            sphere.caster_weight};
    for (std::size_t a = 0; a < 5; ++a) numbers[a * stride + i] = value[a];
    bone_[i] = sphere.bone;
  }
  view_ = {numbers,
           numbers + stride,
           numbers + 2 * stride,
           numbers + 3 * stride,
           bone_.data(),
           static_cast<std::uint32_t>(model.spheres.size())};
  caster_weight_ = numbers + 4 * stride;
}

RestKeyPoints::RestKeyPoints(const CharacterModel& model, Memory* memory)
    : numbers_(13 * padded_key_points(static_cast<std::uint32_t>(model.key_points.size())), memory),
      bone_(4 * padded_key_points(static_cast<std::uint32_t>(model.key_points.size())), memory),
      weight_(4 * padded_key_points(static_cast<std::uint32_t>(model.key_points.size())), memory) {
  const std::uint32_t count = static_cast<std::uint32_t>(model.key_points.size());
  const std::uint32_t stride = padded_key_points(count);
  float* numbers = numbers_.data();
  for (std::uint32_t k = 0; k < stride; ++k) {
    const KeyPoint& point = model.key_points[std::min(k, count - 1)];
    write_six(numbers, stride, k, point.position, point.normal);
    write_six(numbers + 6 * stride, stride, k, point.surface_position, point.surface_normal);
    numbers[12 * stride + k] = point.saturation;
    for (std::size_t b = 0; b < KeyPoint::max_bones; ++b) {
      check_bone(model, point.bone[b], "key point", k);
      bone_[4 * k + b] = point.bone[b];
      weight_[4 * k + b] = point.weight[b];
    }
  }
  view_ = {six_arrays(numbers, stride),
           six_arrays(numbers + 6 * stride, stride),
           bone_.data(),
           weight_.data(),
           numbers + 12 * stride,
           stride};
}

}  // namespace nook
