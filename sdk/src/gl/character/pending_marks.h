// Marks the instances that an update in streaming mode leaves out.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook::gl {

// While an object of this type exists, pending instances are in the far form: they are not evaluated, and
// they darken no other instance. Does nothing if the scene is not in streaming mode.
template <class Placed>
class PendingMarks {
 public:
  PendingMarks(const Placed& placed, Scene& scene) : scene_(scene) {
    if (!placed.streaming.is_used) return;
    for (std::uint32_t slot = 0; slot < placed.placements.size(); ++slot)
      if (placed.placements[slot].id && !placed.is_ready(slot)) {
        scene.instances[slot].plan.is_far = true;
        ++count_;
      }
  }
  ~PendingMarks() {
    if (count_ == 0) return;
    for (Instance& instance : scene_.instances) instance.plan.is_far = false;
  }
  PendingMarks(const PendingMarks&) = delete;
  PendingMarks& operator=(const PendingMarks&) = delete;

 private:
  Scene& scene_;
  std::uint32_t count_ = 0;
};

}  // namespace nook::gl
