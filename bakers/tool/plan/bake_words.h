// The words of a bake: what stands behind `nook bake` on a command line. Options of a manifest are options of
// the command, so that the command's own definitions check them.
#pragma once

#include <string>
#include <vector>

#include "bakers/job/bake_identity.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/plan/manifest.h"

namespace nook::tool::plan {

using Words = std::vector<std::string>;

// The kinds of bakes that a rule may name; "lod", "bent" and "clips" come with a character.
bool is_kind(const std::string& name);
std::string names_of_kinds();

// Returns an option of a manifest as words: --name=text, once for each text of a list. False and null give
// none. {dir} and {stem} stand for the file. Throws ToolError (bad input).
Words option_words(const Manifest& manifest, const std::string& place, const Json& options,
                   const std::string& path);

// Checks each option by the definitions of `nook bake KIND`. Throws ToolError (bad input) that names the
// option's place.
void check_options(const Manifest& manifest, const std::string& place, const std::string& kind,
                   const Json& options);

// What a bake reads and whether it can be kept, from its words alone. Throws what the command throws.
struct BakeOutline {
  CommandFiles files;
  bool reads_images = false;
  bool is_cacheable = true;
};
BakeOutline outline_of(const Words& words);

// Reads the inputs of a bake and returns what decides about its result. Throws what the command throws.
bake::BakeIdentity identity_of(const Words& words);

// Quotes a word for a shell, if it needs that.
std::string quoted(const std::string& word);

}  // namespace nook::tool::plan
