// Makes the list of bakes that a manifest asks for. Every bake comes after the bakes that it needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/tool/plan/bake_words.h"
#include "bakers/tool/plan/glob.h"
#include "bakers/tool/plan/manifest.h"

namespace nook::tool::plan {

struct Job {
  std::string kind;    // kind of bake, as in `nook bake KIND`
  std::string source;  // the file that the rule matched; all paths are relative to the manifest's folder
  std::string output;  // ends in .nook; serves as the name of the job
  std::string place;   // place of its rule in the manifest
  std::string preset;  // preset of a character; otherwise empty
  Words words;         // the words of the bake, without the options that the plan adds
  BakeOutline outline;
  std::vector<std::size_t> needs;  // jobs whose outputs this one reads
  std::size_t group = 0;           // jobs that `needs` connects, directly or indirectly, have the same number
};

// Returns the report of an output: the same name with .json.
std::string report_of(const std::string& output);

// Throws ToolError (bad input) that names the place in the manifest. Causes are patterns that match nothing,
// two bakes with the same output, bakes that need each other in a cycle, and paths outside the folder.
std::vector<Job> jobs_of(const Manifest& manifest, FileTree& tree);

}  // namespace nook::tool::plan
