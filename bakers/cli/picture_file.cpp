#include "cli/picture_file.h"

#include "cli/output_file.h"
#include "cli/tool_error.h"

namespace nook::cli {

void make_image_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw ToolError(exit_other, "--images: " + folder.string() + " cannot be made (" +
                                    (error ? error.message() : "it is a file") + "); choose another folder");
}

void write_png(const std::filesystem::path& path, const bake::Picture& picture) {
  OutputFile(path).commit(bake::png_bytes(picture));
}

std::string as_file_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe)
    if (c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  return safe;
}

}  // namespace nook::cli
