#include "sdk/src/gl/character/pose_batch.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::gl {
namespace {

bool is_bound(const nook_gl_instance_pose& pose) {
  const auto is_near = [](float metres) { return std::abs(metres) <= max_pose_metres; };
  return std::all_of(pose.bound_centre_ws, pose.bound_centre_ws + 3, is_near) && pose.bound_radius >= 0 &&
         is_near(pose.bound_radius);
}

}  // namespace

void check_instance_pose(const PoseBatch& batch, std::size_t index) {
  const nook_gl_instance_pose& pose = batch.instances[index];
  if (!is_bound(pose))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the sphere of instances[%zu] is out of range (got centre %g %g %g and radius %g, need "
                  "finite metres)",
                  index, double(pose.bound_centre_ws[0]), double(pose.bound_centre_ws[1]),
                  double(pose.bound_centre_ws[2]), double(pose.bound_radius));
  if (!(pose.scale > 0 && pose.scale <= max_pose_scale))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "instances[%zu].scale is out of range (got %g, need a scale above 0)", index,
                  double(pose.scale));
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(pose.place_3x4[i]) <= (i % 4 == 3 ? max_pose_metres : max_pose_scale)))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "instances[%zu].place_3x4 is not finite or far too large (element %d is %g)", index, i,
                    double(pose.place_3x4[i]));
  const std::uint64_t end =
      pose.first_transform * std::uint64_t{batch.source.stride} + batch.instance_bytes();
  if (end > batch.size)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "poses.size is too small for instances[%zu] (got %llu bytes, but its transforms end at byte %llu)",
        index, static_cast<unsigned long long>(batch.size), static_cast<unsigned long long>(end));
}

PoseWindows::PoseWindows(const Device& device, const PoseBatch& batch)
    : buffer_(batch.buffer),
      begin_(batch.offset / device.storage_alignment * device.storage_alignment),
      head_(batch.offset - begin_),
      end_(head_ + batch.size),
      stride_(batch.source.stride),
      step_(end_),
      limit_(device.max_piece_bytes) {
  if (end_ <= limit_) return;
  const std::uint64_t one = batch.instance_bytes();
  step_ = one < limit_ ? (limit_ - one) / device.storage_alignment * device.storage_alignment : 0;
  if (step_ == 0)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the transforms of one instance span %llu bytes, but this OpenGL allows %llu; use a smaller stride",
        static_cast<unsigned long long>(one), static_cast<unsigned long long>(limit_));
  count_ = static_cast<std::uint32_t>((end_ + step_ - 1) / step_);
}

std::uint32_t PoseWindows::window_of(std::uint32_t first_transform) const {
  return count_ == 1 ? 0 : static_cast<std::uint32_t>(place_of(first_transform) / step_);
}

std::uint32_t PoseWindows::word_of(std::uint32_t first_transform) const {
  const std::uint64_t place = place_of(first_transform);
  return static_cast<std::uint32_t>((count_ == 1 ? place : place % step_) / sizeof(std::uint32_t));
}

void PoseWindows::bind(const Device& device, GLuint binding, std::uint32_t window) const {
  const std::uint64_t first = window * step_;
  device.gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer_, static_cast<GLintptr>(begin_ + first),
                            static_cast<GLsizeiptr>(std::min(limit_, end_ - first)));
}

}  // namespace nook::gl
