// The check that a command never writes a file that it reads, or one file twice.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nook::tool {

// Each path with the option that names it; empty paths stand for options that were not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

struct CommandFiles {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  std::filesystem::path images;  // --images: a folder where the command writes .png and .svg files
};

// Throws ToolError (bad arguments), naming both options, where an output is an input or another output under
// any name: files are compared by device and inode, also those that a .gltf refers to and those in a folder
// that is read. Several outputs may go to one character device.
void require_distinct_files(const CommandFiles& files);

}  // namespace nook::tool
