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

// Reads a .nook file. Before reading the rest, compares the size in the first bytes with the memory of the
// machine. If the file does not begin like a .nook file, returns only the first bytes. They are enough for a
// reader to reject the file. Throws ToolError (bad input) that names the file, and platform::Stopped.
std::vector<std::byte> read_file(const std::filesystem::path& path);

// Reads a file of any kind, up to the size of the largest file that a command accepts.
std::vector<std::byte> read_any_file(const std::filesystem::path& path);

// Runs `body`. Converts a Failure inside to a ToolError. Puts the file's name in front of the text, unless
// the text already contains it.
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

// A path and the option that it came from. An empty path means that the option was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

struct CommandFiles {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  std::filesystem::path images;  // --images: a folder where the command writes .png and .svg files
};

// Throws ToolError (bad arguments) that names both options if an output is the same file as an input or
// another output. Files are compared by device and inode, so different names for one file are found. Inputs
// include files that a .gltf refers to, and files in a folder that is read. Several outputs may go to one
// character device.
void require_distinct_files(const CommandFiles& files);

// Makes the folder before the work begins. Does nothing for an empty path. Throws ToolError.
void make_image_folder(const std::filesystem::path& folder);

// Converts a name from inside a file to the beginning of a file name. Slashes and control characters become
// underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::tool
