// A view of a room with figures: its G-buffer, the truth at some of its pixels, and a picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "bakers/measure/composite/populated_room.h"

namespace nook::measure {

struct RoomTruth {
  std::uint32_t rays = 256;
  float radius = 0.5f;       // metres; the room occludes within it, figures at any distance
  std::uint32_t every = 11;  // one pixel of so many is traced
  std::uint64_t seed = 1;
};

// Pixels of the room that are traced. The room hides a direction by a hit within the radius, a figure by a
// hit at any distance that nothing of the room stands before.
struct RoomPixels {
  std::vector<std::uint32_t> pixel;
  std::vector<Vec3> position, normal;       // world space
  std::vector<float> room[2], together[2];  // AO without the figures and with them, each by half of the rays
};

struct RoomView {
  bake::nnao::TracedView view;
  std::vector<std::uint8_t> is_figure;  // of each pixel
  RoomPixels pixels;
};

RoomView trace_room_view(const PopulatedRoom& room, const bake::RayScene& all,
                         const bake::nnao::Camera& camera, const RoomTruth& truth);

// A picture of the view: ray tracing, Nook and the screen pass alone, side by side.
// panels: AO of every pixel of the view, one image each; characters are blue. Half the view's size. Throws
// std::runtime_error.
void write_room_picture(const std::filesystem::path& file, const RoomView& view,
                        std::span<const std::vector<float>> panels);

}  // namespace nook::measure
