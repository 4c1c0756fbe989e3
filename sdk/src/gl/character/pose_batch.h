// Poses of a crowd in the host's buffer, and how OpenGL reads a range of it in pieces.
#pragma once

#include <nook/experimental/nook_gl_poses.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

// What nook_gl_scene_set_poses was given, after check_pose_source. `source` has no transforms.
struct PoseBatch {
  PoseSource source;
  bool is_half = false;
  GLuint buffer = 0;
  std::uint64_t offset = 0, size = 0;  // bytes
  std::span<const nook_gl_instance_pose> instances;

  // The bytes of one instance's transforms.
  std::uint64_t instance_bytes() const {
    return std::uint64_t{source.transform_count - 1} * source.stride +
           floats_of_layout(source.layout) * (is_half ? 2 : 4);
  }
};

// Throws Failure unless the numbers of a pose are usable and its transforms lie in the range.
void check_instance_pose(const PoseBatch& batch, std::size_t index);

// The windows through which shaders see a range that may be larger than a storage block. Each instance lies
// in one window, because windows overlap by an instance's bytes.
class PoseWindows {
 public:
  // Throws Failure if an instance does not fit a storage block.
  PoseWindows(const Device& device, const PoseBatch& batch);

  std::uint32_t count() const { return count_; }
  std::uint32_t window_of(std::uint32_t first_transform) const;
  // The first word of a transform, from the start of its window.
  std::uint32_t word_of(std::uint32_t first_transform) const;
  // Binds a window to a storage binding.
  void bind(const Device& device, GLuint binding, std::uint32_t window) const;

 private:
  std::uint64_t place_of(std::uint32_t first_transform) const { return head_ + first_transform * stride_; }

  GLuint buffer_;
  // Ranges of storage buffers begin at multiples of an alignment, so the first window begins before the
  // range. Bytes.
  std::uint64_t begin_, head_, end_, stride_, step_, limit_;
  std::uint32_t count_ = 1;
};

}  // namespace nook::gl
