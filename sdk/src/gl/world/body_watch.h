// If nook_gl_desc.debug is set, logs a message when the bodies of the world pass are not where depth shows
// them. Then the view, or the unit of the bodies or of the camera, is not the one that drew the depth. Also
// logs a light that almost no surface faces. The message comes when the results of queries are available,
// which may be some frames later. A pass whose frames were right before is not judged again: bodies may be
// hidden, and a sun may set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sdk/src/gl/object.h"
#include "sdk/src/gl/world/world_frame.h"
#include "shaders/world/body_questions.h"

namespace nook::gl {

// Each body has two spheres in view space: one around it, and one inside its thickest capsule.
struct WatchedBodies {
  std::array<float, 8 * NOOK_WATCHED_BODIES> spheres{};
  std::size_t count = 0;
};

class BodyWatch {
 public:
  // The pixels that a query counts. bodies.frag draws them.
  static constexpr int questions = NOOK_BODIES_QUESTIONS;
  // The mistakes of a host that are tried in turn to explain the mask.
  static constexpr std::size_t mistake_count = 7;

  explicit BodyWatch(Device& device);

  // Checks the queries of an earlier frame. Returns true if their results are all there, so that this frame
  // can be watched. `frame` must have passed all checks.
  bool begin_frame(const Device& device, const WorldFrame& frame, const ReachingGroups& groups);

  // Return the uniforms of bodies.frag: the bodies of a question, and the light in view space with a
  // distance.
  const WatchedBodies& bodies(int question) const;
  std::array<float, 4> light() const;

  // If the function returns true, draw the pixels of the question, and then call end.
  bool begin(const Device& device, int question);
  void end(const Device& device);

 private:
  struct Query {
    Object object;
    bool pending = false;
    GLuint pixels = 0;  // OpenGL ES only tells whether there are any
  };
  // What is kept of the frame that the queries belong to.
  struct Watched {
    bool has_mask = false, has_bodies = false, has_identity = false, has_cone = false;
    Vec3 eye, light_ws, light_vs;  // the camera and the light in world space, and the light in view space
    float smallest_radius = 0;     // of the bodies that consist of several casters; 0: there are none
    std::size_t mistake = 0;       // for FOUND_OTHERWISE
    WatchedBodies given, otherwise;
  };
  struct Finding {
    const char* what = nullptr;  // null: nothing is wrong
    const char* advice = nullptr;
  };

  bool asks(int question) const;
  bool read(const Device& device);
  std::uint64_t pixels(int question) const { return queries_[std::size_t(question)].pixels; }
  void watch(const WorldFrame& frame, const ReachingGroups& groups);
  void judge(const Device& device);
  bool is_explained() const;
  Finding finding() const;
  const char* general_advice() const;
  void report(const Device& device, const Finding& found);
  void judge_bodies(const Device& device);
  void judge_light(const Device& device);

  std::array<Query, questions> queries_;
  GLenum target_;
  Watched watched_;
  bool is_watching_ = false;
  bool bodies_known_ = false, light_known_ = false;             // reported, or right in an earlier frame
  int wrong_frames_ = 0, right_frames_ = 0, unlit_frames_ = 0;  // wrong and unlit: one after another
  std::array<int, mistake_count> explained_frames_{};
  std::size_t next_mistake_ = 0;
};

}  // namespace nook::gl
