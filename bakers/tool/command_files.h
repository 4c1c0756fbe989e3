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

// Reads a .nook file. Its first bytes contain its size, which is compared with the memory of the machine
// before the rest is read. If the file does not begin like a .nook file, returns only the first bytes, so
// that the code that parses them rejects the file. Throws ToolError (bad input) that names the file, and
// platform::Stopped.
std::vector<std::byte> read_file(const std::filesystem::path& path);

// Reads a file of any kind, up to the size of the largest file that a command accepts.
std::vector<std::byte> read_any_file(const std::filesystem::path& path);

// Runs `body`. If `body` throws a Failure, converts it to a ToolError, and puts the file's name in front of
// its text unless the text already contains the name.
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

// A path and the option that named it. An empty path means that the option was not given.
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
// another output. Files are compared by device and inode, so different names for one file are found. The
// inputs include the files that a .gltf refers to, and the files in an input folder. Several outputs may be
// written to the same character device.
void require_distinct_files(const CommandFiles& files);

// Makes the folder of --images. Call this before the work begins. Does nothing if the path is empty. Throws
// ToolError.
void make_image_folder(const std::filesystem::path& folder);

// Converts a name that was read from a file, such as a clip's name, to a part of a file name. Slashes and
// control characters become underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::tool
