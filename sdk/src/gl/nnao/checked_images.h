// Remembers the sets of host images that a pass has checked, so that the pass does not query OpenGL again in
// every frame.
#pragma once

#include <cstddef>

#include "sdk/src/gl/nnao/host_images.h"

namespace nook::gl {

// Keeps the last four different sets, because a host may use several sets of textures in turn, as in a swap
// chain. While other sets are in use, a host may delete a texture, and OpenGL may reuse its name for a
// texture of another format. So the first time that a pass returns to a set after it used another set, the
// set is checked again. After this second check, the set is known.
class CheckedImages {
 public:
  static constexpr std::size_t most_sets = 4;

  // Returns the facts about a known set, and makes this set the newest one. If the result is null, check the
  // images and then call add.
  const ImageFacts* find(const HostImages& images);
  void add(const HostImages& images, const ImageFacts& facts);
  // Forgets all sets. Call this after a failed check.
  void clear() { *this = {}; }

 private:
  struct Set {
    HostImages images;
    ImageFacts facts;
    bool checked_again = false;
  };
  std::size_t place_of(const HostImages& images) const;
  void bring_forward(std::size_t place);

  Set sets_[most_sets];  // the newest first
  std::size_t count_ = 0;
};

}  // namespace nook::gl
