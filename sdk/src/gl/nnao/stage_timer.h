// Measures the GPU time of the stages of a frame. Times become available a few frames later. No call waits
// for the GPU.
#pragma once

#include <array>
#include <optional>

#include "sdk/src/gl/object.h"

namespace nook::gl {

class StageTimer {
 public:
  static constexpr int stage_count = 4;
  using Milliseconds = std::array<float, stage_count>;

  explicit StageTimer(Device& device);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

  // Call begin_frame once, then call end_stage after each of the stage_count stages. The last end_stage ends
  // the frame.
  void begin_frame();
  void end_stage();
  // Returns the times of the newest finished frame, or nothing if no frame has finished. Changes the
  // query-buffer binding.
  std::optional<Milliseconds> newest() const;

 private:
  static constexpr int kept_frames = 4;
  void mark(int stage);
  bool finished(std::uint64_t frame) const;

  Device& device_;
  std::array<std::array<Object, stage_count + 1>, kept_frames> marks_;
  // The fence after the last timestamp of each kept frame. It is null until the last timestamp is set.
  std::array<GLsync, kept_frames> fences_{};
  std::uint64_t frames_ = 0;  // number of frames that began
  int stage_ = 0;
};

}  // namespace nook::gl
