// Describes a bake in place of performing it. `nook plan` parses the options of a bake with the bake's own
// command, and learns here which files it reads and what its key is.
#pragma once

#include <functional>

namespace nook::tool {

struct BakeCommand;
struct PreparedBake;

struct BakeSurvey {
  // Called once, after the options were parsed and checked. `prepare` reads the inputs; it can be called only
  // during this call. If this is empty, the options are parsed and nothing else happens.
  std::function<void(const BakeCommand& command, const std::function<PreparedBake()>& prepare)> found;
};

}  // namespace nook::tool
