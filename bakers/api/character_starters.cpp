#include "bakers/api/bake_handles.h"

namespace nook::bake {

api::Bake api::bake_of(std::uint32_t type) {
  return type == NOOK_DESC_BAKE_CHARACTER ? character_bake() : Bake();
}

}  // namespace nook::bake
