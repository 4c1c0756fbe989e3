#include "sdk/src/gl/nnao/stage_timer.h"

#include <algorithm>

namespace nook::gl {

StageTimer::StageTimer(Device& device) : device_(device) {
  for (auto& frame : marks_)
    for (Object& mark : frame) mark = Object::make(device, Object::Kind::query);
}

StageTimer::~StageTimer() {
  if (!device_.may_delete()) return;
  for (const GLsync fence : fences_) device_.gl.DeleteSync(fence);  // ignores null
}

void StageTimer::mark(int stage) {
  // Uses time stamps instead of an elapsed-time query, because the host may have such a query active.
  device_.gl.QueryCounter(marks_[frames_ % kept_frames][std::size_t(stage)].name(), GL_TIMESTAMP);
}

void StageTimer::begin_frame() {
  ++frames_;
  stage_ = 0;
  mark(0);
}

void StageTimer::end_stage() {
  mark(++stage_);
  if (stage_ < stage_count) return;
  GLsync& fence = fences_[frames_ % kept_frames];
  device_.gl.DeleteSync(fence);
  fence = device_.gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

// Uses a fence instead of GL_QUERY_RESULT_AVAILABLE. In Mesa's zink driver, GL_QUERY_RESULT_AVAILABLE itself
// records commands. So if the host reads times in every frame, the result would never become available. The
// timeout of the fence is a nanosecond, because with a timeout of zero, zink does not check whether the work
// has finished.
bool StageTimer::finished(std::uint64_t frame) const {
  const GLenum status = device_.gl.ClientWaitSync(fences_[frame % kept_frames], 0, 1);
  return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
}

std::optional<StageTimer::Milliseconds> StageTimer::newest() const {
  const Functions& gl = device_.gl;
  // If the host's query buffer stayed bound, the results would be written into it.
  if (gl.can.query_buffers) gl.BindBuffer(GL_QUERY_BUFFER, 0);
  const std::uint64_t oldest = frames_ > kept_frames ? frames_ - kept_frames : 0;
  for (std::uint64_t frame = frames_; frame > oldest; --frame) {
    const auto& marks = marks_[frame % kept_frames];
    if (!finished(frame)) continue;
    Milliseconds stages{};
    GLuint64 before = 0;
    gl.GetQueryObjectui64v(marks[0].name(), GL_QUERY_RESULT, &before);
    for (std::size_t i = 0; i < stage_count; ++i) {
      GLuint64 after = 0;
      gl.GetQueryObjectui64v(marks[i + 1].name(), GL_QUERY_RESULT, &after);
      stages[i] = after > before ? float(double(after - before) * 1e-6) : 0;
      before = std::max(before, after);
    }
    return stages;
  }
  return std::nullopt;
}

}  // namespace nook::gl
