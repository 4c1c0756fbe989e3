// A picture of a room with characters in the light of a map.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "bakers/measure/composite/composite.h"
#include "bakers/measure/world/split_light.h"

namespace nook::measure {

struct LitRoomSettings {
  std::uint32_t width = 480, height = 270;  // pixels of each panel
  std::size_t figures = 5;
  std::uint32_t rays = 64;  // paths of a pixel
  std::uint64_t seed = 1;
};

// Four panels from left to right: ray tracing; Nook's share by channel with the sun as a cone; AO times the
// probe with the same cone; one capsule for each bone, its AO times the probe and its cone, with the scale of
// radii that suits the picture best. The room does not hide the map: what the figures take of its light is
// the only darkness. Throws Failure (INVALID_ARGUMENT: a model without casters, a room without a place to
// stand in) and std::runtime_error.
void write_lit_room(const std::filesystem::path& file, const MeasuredRoom& measured,
                    const bake::SkinnedMesh& mesh, const CharacterModel& model,
                    std::span<const bake::Pose> poses, const SplitLight& light,
                    const LitRoomSettings& settings);

}  // namespace nook::measure
