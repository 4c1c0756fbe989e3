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

// Reads a .nook file. It checks the size from the first bytes against the memory of the machine before it
// reads the rest. If the file does not begin like a .nook file, it returns only the first bytes, which are
// enough for a reader to refuse it. Throws ToolError (bad input) that names the file; platform::Stopped.
std::vector<std::byte> read_file(const std::filesystem::path& path);

// Reads a file of any kind, up to the size of the largest that a command takes.
std::vector<std::byte> read_any_file(const std::filesystem::path& path);

// Runs body. A Failure inside becomes a ToolError whose text begins with the file's name, unless it has the
// name already.
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

// A path with its option. An empty path means that the option was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

struct CommandFiles {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  std::filesystem::path images;  // --images: a folder where the command writes .png and .svg files
};

// Throws ToolError (bad arguments) if an output is an input or another output under any name, and names both
// options. Files are compared by device and inode. This includes files that a .gltf refers to, and files in a
// folder that is read. Several outputs may go to one character device.
void require_distinct_files(const CommandFiles& files);

// Makes the folder before the work begins; an empty path means none. Throws ToolError.
void make_image_folder(const std::filesystem::path& folder);

// Makes the beginning of a file's name from a name in a file: slashes and control characters become
// underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::tool
