// The files that nook plan writes into its folder DIR:
//
//   build.ninja     every bake, for Ninja, which plans again when a file changed that the plan has read
//   keys/NAME.key   the key of a bake; newer than the output if the bake must run, else old
//   tasks.txt       one line for each character with bakes that must run, the longest first
//   plan.json       what the next plan remembers (memory.h)
//   logs/NAME.log   written by the tasks
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/tool/plan/jobs.h"
#include "bakers/tool/plan/states.h"

namespace nook::tool::plan {

struct PlanPlaces {
  std::filesystem::path program, manifest, root, build;  // absolute
  std::string cache;                                     // absolute; empty: none
  std::string isa;
  std::uint32_t ninja_threads = 0, task_threads = 1;  // of each bake
  std::string plan_command;                           // makes this plan again
};

// Returns the command of a bake for a shell in the manifest's folder. It ends with an option, so that words
// can follow.
std::string bake_command(const PlanPlaces& places, const Job& job, std::uint32_t threads);

// `read` are the files and folders that the plan depends on.
std::string ninja_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<std::filesystem::path>& read);
std::string tasks_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<JobState>& states);

// Writes the keys. After it, a key is newer than its output exactly if the bake must run.
void write_keys(const PlanPlaces& places, const std::vector<Job>& jobs, const std::vector<JobState>& states);

// Returns the bytes of a file; nothing if it cannot be read.
std::string text_in(const std::filesystem::path& path);

// Makes the folders of outputs and logs, which bakes need.
void make_folders(const PlanPlaces& places, const std::vector<Job>& jobs);

}  // namespace nook::tool::plan
