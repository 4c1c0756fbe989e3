#include "bakers/tool/character/clip_names.h"

#include <algorithm>

#include "bakers/tool/tool_error.h"
#include "platform/printable.h"

namespace nook::tool {

void require_clips(const std::vector<std::string>& wanted, const std::vector<std::string>& present) {
  for (const std::string& name : wanted) {
    if (std::find(present.begin(), present.end(), name) != present.end()) continue;
    if (present.empty())
      throw ToolError(exit_bad_arguments,
                      "--clips: there is no clip \"" + name + "\"; the file has no clips at all");
    std::string text = "--clips: there is no clip \"" + name + "\"; the file has these:";
    std::vector<std::string> sorted = present;
    std::sort(sorted.begin(), sorted.end());
    for (const std::string& there : sorted) text += "\n  " + platform::printable(there);
    throw ToolError(exit_bad_arguments, text);
  }
}

}  // namespace nook::tool
