#include "sdk/src/gl/nnao/checked_images.h"

#include <algorithm>

namespace nook::gl {

std::size_t CheckedImages::place_of(const HostImages& images) const {
  const Set* const found =
      std::find_if(sets_, sets_ + count_, [&](const Set& set) { return set.images == images; });
  return std::size_t(found - sets_);
}

void CheckedImages::bring_forward(std::size_t place) {
  std::rotate(sets_, sets_ + place, sets_ + place + 1);
}

const ImageFacts* CheckedImages::find(const HostImages& images) {
  const std::size_t place = place_of(images);
  if (place == count_) return nullptr;
  if (place != 0 && !sets_[place].checked_again) return nullptr;
  bring_forward(place);
  return &sets_[0].facts;
}

void CheckedImages::add(const HostImages& images, const ImageFacts& facts) {
  const std::size_t place = place_of(images);
  const bool known = place < count_;
  if (known && sets_[place].facts == facts) {
    sets_[place].checked_again = true;
    bring_forward(place);
    return;
  }
  // If a known set now has other properties, the host has recreated its textures. Then all sets may be
  // outdated.
  if (known) clear();
  count_ = std::min(count_ + 1, most_sets);
  bring_forward(count_ - 1);
  sets_[0] = {images, facts, false};
}

}  // namespace nook::gl
