#include "bakers/api/bake_handles.h"

namespace nook::bake {

api::Starter api::starter_of(std::uint32_t type) {
  return type == NOOK_DESC_BAKE_CHARACTER ? start_character : nullptr;
}

}  // namespace nook::bake
