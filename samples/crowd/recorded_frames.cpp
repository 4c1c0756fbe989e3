#include "samples/crowd/recorded_frames.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace crowd {

void write_recorded_frame(ScreenSpaceAo& screen_space, const std::filesystem::path& folder, unsigned number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04u.nook", number);
  const std::string note = "crowd, frame " + std::to_string(number);
  std::filesystem::create_directories(folder);
  screen_space.record(note.c_str()).write(folder / name);
}

unsigned next_frame_number(const std::filesystem::path& folder) {
  unsigned next = 0;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
    unsigned number = 0;
    if (std::sscanf(entry.path().filename().string().c_str(), "frame_%u.nook", &number) == 1)
      next = std::max(next, number + 1);
  }
  return next;
}

}  // namespace crowd
