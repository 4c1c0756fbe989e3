#include "bakers/tool/plan/plan_files.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "bakers/tool/command_end.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

// The file time of a key whose output is up to date. It is older than any output. It is not 0, because Ninja
// treats a file with time 0 as missing.
constexpr std::int64_t old_ns = 1'000'000'000;

// Returns the path of a job's file below DIR. Outputs are below the manifest's folder, so their relative
// names can be used.
fs::path place_of(const PlanPlaces& places, const char* folder, const Job& job, const char* extension) {
  return places.build / folder / (job.output + extension);
}

// Escapes a path for Ninja.
std::string ninja_path(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) {
    if (c == '$' || c == ' ' || c == ':') text += '$';
    text += c;
  }
  return text;
}

// Escapes the value of a Ninja variable.
std::string ninja_value(const std::string& value) {
  std::string text;
  for (const char c : value) text += c == '$' ? "$$" : std::string(1, c);
  return text;
}

std::string cd(const PlanPlaces& places) {
  return "cd " + quoted(places.root.string()) + " && ";
}

[[noreturn]] void refuse_to_write(const fs::path& path, const std::string& why) {
  throw ToolError(exit_other,
                  path.string() + ": cannot be written (" + why + "); choose another folder for --build");
}

void set_time(const fs::path& path, std::int64_t ns) {
  const timespec time{time_t(ns / 1'000'000'000), long(ns % 1'000'000'000)}, times[] = {time, time};
  if (utimensat(AT_FDCWD, path.c_str(), times, 0) != 0) refuse_to_write(path, std::strerror(errno));
}

void write_key(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) refuse_to_write(path, std::strerror(errno));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_to_write(folder, error.message());
}

// If a bake waits for another bake, its key is not known yet. Its key file then contains a text that makes
// the bake run.
std::string key_text(const JobState& state) {
  return (state.key.empty() ? std::string(name_of(state.state)) : state.key) + "\n";
}

void write_one_key(const fs::path& path, const Job& job, const JobState& state) {
  const Stamp key = stamp_of(path), output = stamp_of(job.output);
  const std::string text = key_text(state);
  const bool runs = must_run(state.state);
  const bool is_new = key.bytes < 0 || text_in(path) != text;
  if (runs && !is_new && key.modified_ns > output.modified_ns) return;
  if (!runs && !is_new && key.modified_ns <= old_ns) return;
  if (is_new) write_key(path, text);
  // If the output was written on a machine whose clock runs ahead, it would look newer than its key.
  if (runs)
    set_time(path, std::max(now_ns(), output.modified_ns + 1));
  else
    set_time(path, old_ns);
}

struct Task {
  double estimate_s = 0;
  std::string line;
};

}  // namespace

std::string text_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string bake_command(const PlanPlaces& places, const Job& job, std::uint32_t threads) {
  std::string written = quoted(places.program.string()) + " task --log " +
                        quoted(place_of(places, "logs", job, ".log").string()) + " -- bake";
  Words words = job.words;
  words.insert(words.end(), {"--output=" + job.output, "--report=" + report_of(job.output)});
  if (!places.cache.empty()) words.push_back("--cache=" + places.cache);
  words.push_back("--isa=" + places.isa);
  if (threads > 0) words.push_back("--threads=" + std::to_string(threads));
  words.push_back("--quiet");
  for (const std::string& word : words) written += " " + quoted(word);
  return written;
}

// The inputs are listed here and not in a depfile, because Ninja cuts off names in depfiles at quotes. If an
// input has been removed, Ninja must not report an error. Each input is therefore also the output of a rule
// without a command.
std::string ninja_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<fs::path>& read) {
  std::string inputs;
  for (const fs::path& file : read) inputs += " " + ninja_path(file);
  std::string written =
      "# nook plan wrote this from " + places.manifest.string() +
      " and will replace it.\n"
      "# Keys decide what runs. With generator = 1, Ninja ignores changes of command lines, which "
      "differ only in the number of threads.\n\n"
      "rule bake\n  command = $run\n  description = $name\n  generator = 1\n\n"
      "rule plan\n  command = " +
      ninja_value(places.plan_command) +
      "\n  description = nook plan\n  generator = 1\n\n"
      "build build.ninja: plan |" +
      inputs + "\n\nbuild" + inputs + ": phony\n\n";
  for (const Job& job : jobs) {
    written += "build " + ninja_path(places.root / job.output) + ": bake | " +
               ninja_path(place_of(places, "keys", job, ".key"));
    if (!job.needs.empty()) written += " ||";
    for (const std::size_t need : job.needs) written += " " + ninja_path(places.root / jobs[need].output);
    written += "\n  name = " + ninja_value(job.output) +
               "\n  run = " + ninja_value(cd(places) + bake_command(places, job, places.ninja_threads)) +
               "\n";
  }
  return written;
}

std::string tasks_text(const PlanPlaces& places, const std::vector<Job>& jobs,
                       const std::vector<JobState>& states) {
  std::map<std::size_t, Task> tasks;  // the key is the group
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!must_run(states[i].state)) continue;
    Task& task = tasks[jobs[i].group];
    if (task.line.empty()) task.line = "cd " + quoted(places.root.string());
    task.line += " && " + bake_command(places, jobs[i], places.task_threads);
    task.estimate_s += states[i].estimate_s;
  }
  std::vector<Task> sorted;
  for (auto& [group, task] : tasks) sorted.push_back(std::move(task));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Task& a, const Task& b) { return a.estimate_s > b.estimate_s; });
  std::string text;
  for (const Task& task : sorted) text += task.line + "\n";
  return text;
}

void write_keys(const PlanPlaces& places, const std::vector<Job>& jobs, const std::vector<JobState>& states) {
  for (std::size_t i = 0; i < jobs.size(); ++i)
    write_one_key(place_of(places, "keys", jobs[i], ".key"), jobs[i], states[i]);
}

void make_folders(const PlanPlaces& places, const std::vector<Job>& jobs) {
  std::set<fs::path> folders{places.build};
  for (const Job& job : jobs) {
    folders.insert((places.root / job.output).parent_path());
    for (const char* folder : {"keys", "logs"})
      folders.insert(place_of(places, folder, job, "").parent_path());
  }
  for (const fs::path& folder : folders) make_folder(folder);
}

}  // namespace nook::tool::plan
