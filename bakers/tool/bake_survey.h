// With a survey, a bake command describes its bake instead of performing it. `nook plan` uses this: it lets
// the bake's own command parse the options. Through this struct, `nook plan` then learns which files the bake
// reads and what the bake's key is.
#pragma once

#include <functional>

namespace nook::tool {

struct BakeCommand;
struct PreparedBake;

struct BakeSurvey {
  // The command calls this function once, after the options were parsed and checked. `prepare` reads the
  // inputs. You may only call `prepare` inside `found`. If `found` is empty, the command only parses the
  // options.
  std::function<void(const BakeCommand& command, const std::function<PreparedBake()>& prepare)> found;
};

}  // namespace nook::tool
