// Handles the words of a bake. These are the arguments that follow `nook bake` on a command line. A manifest
// has the same options as the command, so the command's own definitions check them.
#pragma once

#include <string>
#include <vector>

#include "bakers/job/bake_identity.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/plan/manifest.h"

namespace nook::tool::plan {

using Words = std::vector<std::string>;

// Returns true for the kinds of bakes that a rule may name. Bakes of the kinds "lod", "bent" and "clips" are
// added by a character.
bool is_kind(const std::string& name);
std::string names_of_kinds();

// Converts an option of a manifest to words of the form --name=text. A list gives one word for each of its
// texts. The values false and null give no words. Replaces {dir} and {stem} by the folder and the name of the
// file. Throws ToolError (bad input).
Words option_words(const Manifest& manifest, const std::string& place, const Json& options,
                   const std::string& path);

// Checks each option with the definitions of `nook bake KIND`. Throws ToolError (bad input) that names the
// option's place.
void check_options(const Manifest& manifest, const std::string& place, const std::string& kind,
                   const Json& options);

// Facts about a bake that follow from its words alone: which files it reads, and whether its result can be
// cached. outline_of() throws what the command throws.
struct BakeOutline {
  CommandFiles files;
  bool reads_images = false;
  bool is_cacheable = true;
};
BakeOutline outline_of(const Words& words);

// Reads the inputs of a bake and returns its identity. Throws what the command throws.
bake::BakeIdentity identity_of(const Words& words);

// Quotes a word for a shell if necessary.
std::string quoted(const std::string& word);

}  // namespace nook::tool::plan
