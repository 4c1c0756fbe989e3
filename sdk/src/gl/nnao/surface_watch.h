// If nook_gl_desc.debug is set, logs a message when a frame cannot show AO. There are three reasons: its
// depth shows no surface, the host's mask covers all surfaces, or the radius does not fit the depth. A mask
// or radius that was right in an earlier frame is not reported. The camera may just be close to a wall, or to
// a character that the mask covers. The results of the queries, and so the message, may arrive some frames
// later.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/object.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {

class SurfaceWatch {
 public:
  // The pixels that a query counts. surface.frag draws them.
  static constexpr int questions = NOOK_WATCH_COUNT;

  // A pass without a radius never asks about it.
  SurfaceWatch(Device& device, bool has_radius);

  // Checks the queries of an earlier frame. Returns true if their results are all there, so that this frame
  // can be watched.
  bool begin_frame(const Device& device, const NnaoFrame& frame);
  // If the function returns true, draw the pixels of the question, and then call end.
  bool begin(const Device& device, int question);
  void end(const Device& device);

 private:
  struct Query {
    Object object;
    bool pending = false;
    GLuint pixels = 0;  // of the last frame with a result; OpenGL ES only tells whether there are any
  };

  bool asks(int question) const;
  bool read(const Device& device);
  void forget_changed(const NnaoFrame& next);
  void judge(const Device& device);
  bool looks_reversed(std::uint64_t seen) const;
  void report_reversed(const Device& device) const;
  void report(const Device& device, int question) const;

  std::array<Query, questions> queries_;
  std::array<bool, questions> was_wrong_{};  // in the last frame
  std::array<bool, questions> was_right_{};  // in a frame with the same mode of the mask, or the same radius
  bool has_radius_, is_watching_ = false;
  GLenum target_;
  NnaoFrame frame_{};  // the frame that the queries belong to; its pointers are not followed
};

}  // namespace nook::gl
