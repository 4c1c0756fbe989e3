// The bakes that a manifest asks for, in an order in which every bake comes after those that it needs.
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
  std::string kind;    // of `nook bake`
  std::string source;  // the file that the rule matched; paths are relative to the manifest's folder
  std::string output;  // ends in .nook; it names the job
  std::string place;   // of its rule in the manifest
  std::string preset;  // of a character, else empty
  Words words;         // without what the plan adds
  BakeOutline outline;
  std::vector<std::size_t> needs;  // jobs whose outputs this one reads
  std::size_t group = 0;           // jobs that need each other, directly or not, have one number
};

// Returns the report of an output: the same name with .json.
std::string report_of(const std::string& output);

// Throws ToolError (bad input) that names the place in the manifest. It refuses patterns that match nothing,
// two bakes with one output, bakes that need each other in a circle, and paths outside the folder.
std::vector<Job> jobs_of(const Manifest& manifest, FileTree& tree);

}  // namespace nook::tool::plan
