#include "sdk/src/character/clip_texels.h"

#include <cstring>

#include "sdk/src/core/half.h"

namespace nook {

ClipTexels mode_texels(const LoadedClips& clips) {
  return {std::uint64_t(clips.model->model.file_to_welded.size()) * (clips.set.ao.modes / 4), 4};
}

ClipTexels weight_texels(const LoadedClips& clips) {
  return {std::uint64_t(clips.set.frame_count) * (clips.set.ao.modes / 4), 8};
}

void write_mode_texels(const LoadedClips& clips, void* texels) noexcept {
  constexpr std::uint32_t block_slots = LoadedClips::block_slots;
  const std::uint32_t modes = clips.set.ao.modes;
  auto* const out = static_cast<std::int8_t*>(texels);
  std::memset(out, 0, mode_texels(clips).bytes());
  const auto& slot_of = clips.model->linear.file_to_slot();
  for (std::size_t i = 0; i < slot_of.size(); ++i) {
    const std::int8_t* const block = clips.block_modes(slot_of[i] / block_slots) + slot_of[i] % block_slots;
    for (std::uint32_t k = 0; k < modes; ++k) out[i * modes + k] = block[std::size_t(k) * block_slots];
  }
}

void write_weight_texels(const LoadedClips& clips, void* texels) noexcept {
  const ClipSet& set = clips.set;
  auto* const out = static_cast<unsigned char*>(texels);
  std::memset(out, 0, weight_texels(clips).bytes());
  for (std::size_t f = 0; f < set.frame_count; ++f)
    for (std::size_t k = 0; k < set.ao.modes; ++k) {
      const std::uint16_t half = to_half(set.ao.frame_weight(f, k));
      std::memcpy(out + 2 * (f * set.ao.modes + k), &half, sizeof half);
    }
}

}  // namespace nook
