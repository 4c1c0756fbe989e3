// Decides which bakes are up to date, which come from the cache, and which have to run, and why.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/tool/bake_cache.h"
#include "bakers/tool/plan/jobs.h"
#include "bakers/tool/plan/memory.h"

namespace nook::tool::plan {

enum class State : std::uint8_t {
  up_to_date,  // the output's recipe has the key of the bake
  from_cache,  // the cache has the result; it is copied, except in a dry run
  missing,     // the output has to be baked
  waits,       // the bake reads the output of another bake that must run first, so its key is not known yet
  unreadable   // the inputs cannot be read; the bake will fail with a message
};
const char* name_of(State state);
inline bool must_run(State state) {
  return state == State::missing || state == State::waits || state == State::unreadable;
}

struct JobState {
  State state = State::missing;
  std::string reason;     // why the bake must run; empty if it need not run
  std::string key;        // empty if it is not known
  double estimate_s = 0;  // duration of the bake, if it must run
  std::vector<StampedFile> read;
};

struct StateOptions {
  std::uint32_t threads = 0;  // 0: all cores
  bool writes = true;         // false: a dry run, which copies nothing
  std::optional<BakeCache> cache;
};

struct States {
  std::vector<JobState> jobs;
  Memory memory;  // what the next plan can reuse
};

// The working directory must be the manifest's folder, and the process must be pinned to the instruction set
// of the bakes. Jobs of one group are handled one after another, groups in parallel. Throws platform::Stopped
// at Ctrl-C.
States states_of(const std::vector<Job>& jobs, const Memory& known, const StateOptions& options);

}  // namespace nook::tool::plan
