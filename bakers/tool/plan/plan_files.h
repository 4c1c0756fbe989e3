// Writes the files of `nook plan` in its folder DIR:
//
//   build.ninja     all bakes, for Ninja; Ninja plans again when a file that the plan has read changes
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
  std::uint32_t ninja_threads = 0, task_threads = 1;  // threads of each bake
  std::string plan_command;                           // the command that makes this plan again
};

// Returns the command of a bake for a shell in the manifest's folder. It ends with an option, so that more
// arguments can be appended.
std::string bake_command(const PlanPlaces& places, const Job& job, std::uint32_t threads);

// `read` are the files and folders that the plan depends on.
std::string ninja_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<std::filesystem::path>& read);
std::string tasks_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<JobState>& states);

// Writes the keys. Afterwards, a key is newer than its output if and only if the bake must run.
void write_keys(const PlanPlaces& places, const std::vector<Job>& jobs, const std::vector<JobState>& states);

// Returns the content of a file, or an empty text if it cannot be read.
std::string text_in(const std::filesystem::path& path);

// Makes the folders of outputs and logs. Bakes do not make them.
void make_folders(const PlanPlaces& places, const std::vector<Job>& jobs);

}  // namespace nook::tool::plan
