// A view of a room with characters: ray tracing, Nook and the screen pass alone, side by side.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "bakers/measure/composite/room_view.h"

namespace nook::measure {

// panels: AO of every pixel of the view, one image each; characters are blue. Half the view's size. Throws
// std::runtime_error.
void write_room_picture(const std::filesystem::path& file, const RoomView& view,
                        std::span<const std::vector<float>> panels);

}  // namespace nook::measure
