// Describes a bake instead of performing it. `nook plan` parses the options of a bake with the bake's own
// command. Through this struct, it learns which files the bake reads and what the bake's key is.
#pragma once

#include <functional>

namespace nook::tool {

struct BakeCommand;
struct PreparedBake;

struct BakeSurvey {
  // Called once, after the options were parsed and checked. `prepare` reads the inputs; call it only during
  // this call. If `found` is empty, the options are parsed and nothing else happens.
  std::function<void(const BakeCommand& command, const std::function<PreparedBake()>& prepare)> found;
};

}  // namespace nook::tool
