#include <nook/experimental/nook_bake_materials.h>
#include "bakers/api/starters.h"

namespace nook::bake {

api::Starter api::starter_of(std::uint32_t type) {
  switch (type) {
    case NOOK_DESC_BAKE_CHARACTER:
      return start_character;
    case NOOK_DESC_BAKE_BENT:
      return start_bent;
    case NOOK_DESC_BAKE_CLIPS:
      return start_clips;
    case NOOK_DESC_BAKE_MATERIAL:
      return start_material;
    case NOOK_DESC_BAKE_SYNTHESIS:
      return start_synthesis;
    case NOOK_DESC_BAKE_TRANSFER:
      return start_transfer;
    default:
      return nullptr;
  }
}

}  // namespace nook::bake
