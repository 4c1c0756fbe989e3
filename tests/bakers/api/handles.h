// Handles that release themselves, and the message a failing call leaves.
#pragma once

#include <nook/nook_bake.h>

#include <memory>
#include <string>

#include "tests/bakers/api/tube.h"

struct CharacterRelease {
  void operator()(nook_bake_character c) const { nook_bake_character_destroy(&c); }
};
struct JobRelease {
  void operator()(nook_bake_job j) const { nook_bake_job_destroy(&j); }
};
using Character = std::unique_ptr<nook_bake_character_s, CharacterRelease>;
using Job = std::unique_ptr<nook_bake_job_s, JobRelease>;

inline Character tube_character() {
  tube t;
  make_tube(&t);
  const nook_bake_source_desc desc = describe_tube(&t);
  nook_bake_character character = nullptr;
  nook_bake_character_create(&desc, &character);
  return Character(character);
}

inline bool message_has(const char* text) {
  return std::string(nook_bake_last_message()).find(text) != std::string::npos;
}
