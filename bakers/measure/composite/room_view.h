// A view of a room with figures: its G-buffer, the traced AO at some pixels, and a picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "bakers/measure/composite/populated_room.h"

namespace nook::measure {

struct RoomTruth {
  std::uint32_t rays = 256;
  float radius = 0.5f;  // metres; the room occludes only within this radius, figures occlude at any distance
  std::uint32_t every = 11;  // traces every n-th pixel
  std::uint64_t seed = 1;
};

// The traced pixels of the room. The room occludes a direction if the ray hits the room within the radius. A
// figure occludes a direction if the ray hits the figure at any distance, unless the room is in front of the
// figure.
struct RoomPixels {
  std::vector<std::uint32_t> pixel;
  std::vector<Vec3> position, normal;       // world space
  std::vector<float> room[2], together[2];  // AO without and with the figures, each from half of the rays
};

struct RoomView {
  bake::nnao::TracedView view;
  std::vector<std::uint8_t> is_figure;  // per pixel
  RoomPixels pixels;
};

RoomView trace_room_view(const PopulatedRoom& room, const bake::RayScene& all,
                         const bake::nnao::Camera& camera, const RoomTruth& truth);

// Draws three panels side by side, at half the view's size: ray tracing, Nook, and the screen pass alone.
// `panels` has one image per panel, with the AO of every pixel. Characters are drawn in blue. Throws
// std::runtime_error.
void write_room_picture(const std::filesystem::path& file, const RoomView& view,
                        std::span<const std::vector<float>> panels);

}  // namespace nook::measure
