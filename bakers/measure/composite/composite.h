// nook evaluate world --composite: the darkening by characters and the screen pass together, against ray
// tracing of a room with characters in it.
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
  std::size_t figures = 5, views = 8;  // of each room
  int taps = 9;                        // of the screen pass
  RoomTruth truth;
  std::filesystem::path images;  // empty, or where a picture of each room goes
};

struct MeasuredRoom {
  std::string name;
  bake::TriangleSoup soup;  // world space, metres, +y up
};

using CompositeProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Two rows for each room and each way to combine both, and for all rooms together: pixels of the room whose
// truth with characters and without differs by more than 0.01, and the others. Throws Failure
// (INVALID_ARGUMENT: a model without casters, a room without a place to stand in; CANCELLED).
nlohmann::ordered_json composite_rows(platform::Context& context, std::span<const MeasuredRoom> rooms,
                                      const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                      std::span<const std::byte> model_bytes,
                                      std::span<const bake::Pose> poses, const CompositeStudy& study,
                                      const CompositeProgress& progress);

// A picture of a room with characters in the light of a map.
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
