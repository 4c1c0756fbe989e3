// Clip names from the command line against those of a file.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Throws ToolError (bad arguments) that names the first unknown clip and lists all there are.
void require_clips(const std::vector<std::string>& wanted, const std::vector<std::string>& present);

}  // namespace nook::tool
