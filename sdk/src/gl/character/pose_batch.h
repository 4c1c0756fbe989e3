// Poses of a crowd that are in the host's buffer, and the windows through which OpenGL reads a large range of
// this buffer.
#pragma once

#include <nook/experimental/nook_gl_poses.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

// The arguments of nook_gl_scene_set_poses, after check_pose_source. `source` has no pointer to transforms.
struct PoseBatch {
  PoseSource source;
  bool is_half = false;
  GLuint buffer = 0;
  std::uint64_t offset = 0, size = 0;  // range of the buffer, in bytes
  std::span<const nook_gl_instance_pose> instances;

  // Returns the size of one instance's transforms in bytes.
  std::uint64_t instance_bytes() const {
    return std::uint64_t{source.transform_count - 1} * source.stride +
           floats_of_layout(source.layout) * (is_half ? 2 : 4);
  }
};

// Throws Failure if a value of a pose descriptor is invalid, or if the transforms of the pose are not
// completely inside the range.
void check_instance_pose(const PoseBatch& batch, std::size_t index);

// Shaders cannot read a range that is larger than a storage block at once. So they read it through windows.
// Windows overlap by the size of an instance, so that each instance is completely in one window.
class PoseWindows {
 public:
  // Throws Failure if an instance does not fit into a storage block.
  PoseWindows(const Device& device, const PoseBatch& batch);

  std::uint32_t count() const { return count_; }
  std::uint32_t window_of(std::uint32_t first_transform) const;
  // Returns the index of the first word of a transform, counted from the start of its window.
  std::uint32_t word_of(std::uint32_t first_transform) const;
  // Binds a window to the storage binding `binding`.
  void bind(const Device& device, GLuint binding, std::uint32_t window) const;

 private:
  std::uint64_t place_of(std::uint32_t first_transform) const { return head_ + first_transform * stride_; }

  GLuint buffer_;
  // In bytes. A bound range must start at a multiple of an alignment, so the first window may start before
  // the range.
  std::uint64_t begin_, head_, end_, stride_, step_, limit_;
  std::uint32_t count_ = 1;
};

}  // namespace nook::gl
