// The host's OpenGL state, made as odd as it can be, and read back to be compared.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "platform/platform.h"

namespace nook::test {

// By name of the item in gl/touched_state.h, or for state that Nook must never touch by OpenGL's own name.
using StateValues = std::map<std::string, std::vector<std::int64_t>>;

class Poison {
 public:
  // Sets every item of the list, and much beside it, to odd values; `users` are those of touched_state.h that
  // may touch their items.
  Poison(platform::Context& context, unsigned users);
  // Puts OpenGL's defaults back.
  ~Poison();
  Poison(const Poison&) = delete;
  Poison& operator=(const Poison&) = delete;

  // The users' items of the list; the other items, and the state beside the list.
  StateValues touched() const;
  StateValues untouched() const;
  // The initial state of OpenGL, for the users' items.
  StateValues defaults() const;
  // Pretends the host never changed anything: the state of the list at its defaults.
  void reset_touched();

 private:
  const GladGLContext& gl_;
  unsigned users_;
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

// The users of evaluating characters on a tier.
unsigned users_of_tier(int tier);

}  // namespace nook::test
