// Remembers the sets of host images that a pass has checked, so that it need not query OpenGL about them
// again.
#pragma once

#include <cstddef>

#include "sdk/src/gl/nnao/host_images.h"

namespace nook::gl {

// The last four different sets, since names rotate in a swap chain. A host may delete a texture and get its
// name again for another format while other sets are in use. So a set that returns for the first time is
// checked once more before it counts as known.
class CheckedImages {
 public:
  static constexpr std::size_t most_sets = 4;

  // Returns what is known about the set, and makes it the newest one. If it returns null, check the images,
  // then call add.
  const ImageFacts* find(const HostImages& images);
  void add(const HostImages& images, const ImageFacts& facts);
  // Forgets all sets, as after a failed check.
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
