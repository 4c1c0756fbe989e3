#include "bakers/images/image_files.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& path) {
  static const std::set<std::string> endings{".png",  ".jpg", ".jpeg", ".exr", ".tif",
                                             ".tiff", ".bmp", ".hdr",  ".ppm", ".tga"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return endings.count(ending) != 0;
}

template <class Iterator>
std::vector<fs::path> images_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (Iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file() && is_image(at->path())) found.push_back(at->path());
  if (error)
    throw Failure(NOOK_ERROR_BAD_FILE, "%.300s: cannot be read (%s)", folder.c_str(),
                  error.message().c_str());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<fs::path> images_in(const fs::path& folder) {
  return images_of<fs::directory_iterator>(folder);
}

std::vector<fs::path> images_below(const fs::path& folder) {
  return images_of<fs::recursive_directory_iterator>(folder);
}

}  // namespace nook::bake
