// Lists the descriptors of the bakers' library, one per line: the part of the type's name after NOOK_DESC_,
// and the struct.
#pragma once

#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include "sdk/src/core/descriptors.h"

#define NOOK_BAKE_DESCRIPTORS(X)                \
  X(BAKE_SOURCE, nook_bake_source_desc)         \
  X(BAKE_CHARACTER, nook_bake_character_desc)   \
  X(BAKE_BENT, nook_bake_bent_desc)             \
  X(BAKE_CLIPS, nook_bake_clips_desc)           \
  X(BAKE_MATERIAL, nook_bake_material_desc)     \
  X(BAKE_SYNTHESIS, nook_bake_synthesis_desc)   \
  X(BAKE_TRANSFER, nook_bake_transfer_desc)     \
  X(BAKE_TRACE, nook_bake_trace_desc)           \
  X(BAKE_IRRADIANCE, nook_bake_irradiance_desc) \
  X(BAKE_CHARACTER_STUDY, nook_bake_character_study_desc)

namespace nook {

#define NOOK_DECLARE_DESCRIPTOR(name, desc)                                \
  template <>                                                              \
  inline constexpr std::uint32_t descriptor_type<desc> = NOOK_DESC_##name; \
  template <>                                                              \
  inline constexpr const char* descriptor_init<desc> = #desc "_init";      \
  template <>                                                              \
  desc default_desc<desc>();
NOOK_BAKE_DESCRIPTORS(NOOK_DECLARE_DESCRIPTOR)
#undef NOOK_DECLARE_DESCRIPTOR

// A struct that has grown since its first release.
template <>
inline constexpr std::size_t first_size<nook_bake_character_study_desc> = 32;

}  // namespace nook
