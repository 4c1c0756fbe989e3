// For `nook evaluate world --composite`: combines the darkening by characters with the screen pass, and
// compares the result with ray tracing of a room with characters in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/composite/room_view.h"
#include "bakers/measure/world/split_light.h"
#include "platform/platform.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

struct CompositeStudy {
  std::uint32_t width = 960, height = 540;
  std::size_t figures = 5, views = 8;  // per room
  int taps = 9;                        // taps of the screen pass
  RoomTruth truth;
  std::filesystem::path images;  // folder for a picture of each room; empty: none
};

struct MeasuredRoom {
  std::string name;
  bake::TriangleSoup soup;  // world space, metres, +y up
};

using CompositeProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns two rows for each room and each way to combine both passes. Also returns two such rows for all
// rooms together. The first row is for the pixels of the room whose traced AO changes by more than 0.01 when
// the characters are added. The second row is for all other pixels of the room. Throws Failure
// (INVALID_ARGUMENT: a model without casters, a room without a place to stand in; CANCELLED).
nlohmann::ordered_json composite_rows(platform::Context& context, std::span<const MeasuredRoom> rooms,
                                      const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                      std::span<const std::byte> model_bytes,
                                      std::span<const bake::Pose> poses, const CompositeStudy& study,
                                      const CompositeProgress& progress);

// Draws a room with characters in the light of a map.
struct LitRoomSettings {
  std::uint32_t width = 480, height = 270;  // pixels of each panel
  std::size_t figures = 5;
  std::uint32_t rays = 64;  // paths per pixel
  std::uint64_t seed = 1;
};

// Draws four panels from left to right:
//   1. ray tracing;
//   2. Nook's open share of the light in each channel, where the sun is a cone;
//   3. AO times the light of the probe, with the same cone;
//   4. one capsule for each bone, lit in the same way as panel 3, with the best scale of radii.
// The room does not block the light of the map. Only the figures block light. Throws Failure
// (INVALID_ARGUMENT: a model without casters, a room without a place to stand in) and std::runtime_error.
void write_lit_room(const std::filesystem::path& file, const MeasuredRoom& measured,
                    const bake::SkinnedMesh& mesh, const CharacterModel& model,
                    std::span<const bake::Pose> poses, const SplitLight& light,
                    const LitRoomSettings& settings);

}  // namespace nook::measure
