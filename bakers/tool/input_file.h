// Files that a command reads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bakers/tool/tool_error.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {

// Throws ToolError (bad input) that names the file.
std::vector<std::byte> read_file(const std::filesystem::path& path);

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

}  // namespace nook::tool
