// If nook_gl_desc.debug is set, logs a message when the depth of a frame shows no surface. The message is
// logged when the result of a query is available, which may be some frames later.
#pragma once

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

class SurfaceWatch {
 public:
  explicit SurfaceWatch(Device& device) : query_(Object::make(device, Object::Kind::query)) {}

  // Checks the query of an earlier frame. If it returns true, draw the pixels of this frame that show a
  // surface, and then call `end`.
  bool begin(const Device& device, const NnaoFrame& frame);
  void end(const Device& device);

 private:
  void report(const Device& device) const;

  Object query_;
  bool pending_ = false, told_ = false;
  nook_depth_kind depth_kind_ = 0;  // depth kind of the frame that the query belongs to
  nook_clip_space clip_space_ = 0;
  std::uint32_t depth_texture_ = 0;
};

}  // namespace nook::gl
