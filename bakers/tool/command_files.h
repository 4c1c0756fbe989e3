// The files that a command reads and writes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bakers/tool/command_end.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {

// Reads a .nook file. Its size is checked by the first bytes and by the memory of the machine before the rest
// is read. Of a file that does not begin as a .nook file only the first bytes come, enough for a reader to
// refuse it. Throws ToolError (bad input) that names the file; platform::Stopped.
std::vector<std::byte> read_file(const std::filesystem::path& path);

// The same for a file of any kind, up to the size of the largest that a command takes.
std::vector<std::byte> read_any_file(const std::filesystem::path& path);

// Runs body; a Failure inside becomes a ToolError whose text begins with the file's name, unless it has it
// already.
template <class Body>
auto naming_file(const std::filesystem::path& path, Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const Failure& failure) {
    const std::string text = failure.what();
    if (text.find(path.string()) != std::string::npos) throw;
    throw ToolError(exit_code_of(failure.code()), path.string() + ": " + text);
  }
}

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

// Makes the folder before the work begins; an empty path stands for none. Throws ToolError.
void make_image_folder(const std::filesystem::path& folder);

// A name that stands in a file, as the beginning of a file's name: slashes and control characters become
// underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::tool
