#include "bakers/tool/image_folder.h"

#include "bakers/tool/tool_error.h"

namespace nook::tool {

void make_image_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw ToolError(exit_other, "--images: " + folder.string() + " cannot be made (" +
                                    (error ? error.message() : "it is a file") + "); choose another folder");
}

std::string as_file_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe)
    if (c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  return safe;
}

}  // namespace nook::tool
