// Files of recorded frames of the screen-space pass, for reports of wrong pictures: FOLDER/frame_0000.nook
// and so on, which `nook evaluate nnao --frame` replays.
#pragma once

#include <filesystem>

#include "samples/crowd/screen_space.h"

namespace crowd {

// Writes the frame that was drawn last. The folder is made if it is absent.
void write_recorded_frame(ScreenSpaceAo& screen_space, const std::filesystem::path& folder, unsigned number);

// The number after the highest one in the folder; 0 if there is none.
unsigned next_frame_number(const std::filesystem::path& folder);

}  // namespace crowd
