// The tables of clips as texels of four numbers each, for the textures that shaders/clips/host.glsl reads.
#pragma once

#include <cstdint>

#include "sdk/src/character/loaded_clips.h"
#include "shaders/core/texel_layout.h"

namespace nook {

// A 2D texture whose rows follow one another.
struct ClipTexels {
  static constexpr std::uint32_t width = NOOK_TEXEL_ROW;
  std::uint64_t texels = 0;
  std::uint32_t texel_bytes = 0;

  std::uint32_t height() const { return static_cast<std::uint32_t>((texels + width - 1) / width); }
  std::uint64_t bytes() const { return std::uint64_t(height()) * width * texel_bytes; }
};

ClipTexels mode_texels(const LoadedClips& clips);
ClipTexels weight_texels(const LoadedClips& clips);

// Fill the bytes of the texture, with zeros behind the last texel.
void write_mode_texels(const LoadedClips& clips, void* texels) noexcept;
void write_weight_texels(const LoadedClips& clips, void* texels) noexcept;

}  // namespace nook
