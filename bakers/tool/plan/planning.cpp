#include "bakers/tool/plan/planning.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <thread>

#include "bakers/raytrace/instruction_set.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/depfile.h"
#include "bakers/tool/pinned_process.h"
#include "bakers/tool/plan/plan_files.h"
#include "bakers/tool/plan/states.h"
#include "platform/output_file.h"
#include "platform/output_stream.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_build = "nook-build";

fs::path absolute_path(const fs::path& path) {
  return path.empty() ? path : fs::absolute(path).lexically_normal();
}

// Returns the number of threads for each bake. If many bakes run, they share the cores. A single bake gets
// all cores.
std::uint32_t shared_threads(std::size_t bakes) {
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  return std::uint32_t(std::max<std::size_t>(1, cores / std::clamp<std::size_t>(bakes, 1, cores)));
}

std::string plan_command(const PlanOptions& o, const PlanPlaces& places) {
  std::string command = quoted(places.program.string()) + " plan " + quoted(places.manifest.string()) +
                        " --build=" + quoted(places.build.string()) + " --isa=" + quoted(places.isa);
  if (!places.cache.empty()) command += " --cache=" + quoted(places.cache);
  if (o.threads > 0) command += " --threads=" + std::to_string(o.threads);
  if (o.bake_threads > 0) command += " --bake-threads=" + std::to_string(o.bake_threads);
  return command + " --quiet";
}

PlanPlaces places_of(const PlanOptions& o, const Manifest& manifest) {
  PlanPlaces places;
  std::error_code error;
  places.program = fs::read_symlink("/proc/self/exe", error);
  if (error)
    throw ToolError(exit_other, "plan: /proc/self/exe cannot be read (" + error.message() + "); mount /proc");
  places.manifest = manifest.root / manifest.file.filename();
  places.root = manifest.root;
  places.build = o.build.empty() ? manifest.root / default_build : absolute_path(o.build);
  places.cache = absolute_path(cache_folder(o.cache)).string();
  places.isa = pinned_isa();
  places.task_threads = o.bake_threads > 0 ? o.bake_threads : 1;
  for (const std::string& path : {places.root.string(), places.build.string(), places.cache})
    if (path.find_first_of("\n\r") != std::string::npos)
      throw ToolError(exit_bad_arguments,
                      "plan: a folder's name has a line break (got " + path + "); rename it");
  return places;
}

// Returns everything that could change the plan: the manifest, this program, the folders that patterns
// search, and the files that bakes read, except files that other bakes write.
std::vector<fs::path> read_by_plan(const PlanPlaces& places, const std::vector<Job>& jobs,
                                   const States& states, const FileTree& tree) {
  std::set<std::string> written, files;
  for (const Job& job : jobs) written.insert((places.root / job.output).string());
  for (const std::string& folder : tree.folders())
    files.insert(folder.empty() ? places.root.string() : (places.root / folder).string());
  for (const JobState& state : states.jobs)
    for (const StampedFile& file : state.read)
      files.insert((places.root / file.path).lexically_normal().string());
  std::vector<fs::path> read{places.manifest, places.program};
  for (const std::string& file : files)
    if (!written.contains(file)) read.emplace_back(file);
  return read;
}

void write(const fs::path& path, const std::string& text) {
  platform::OutputFile(path, file_events(true)).commit(text);
}

// Writes the text. If the file already has this content, only sets the file's time to now, which is faster
// because it does not wait for the disk.
void renew(const fs::path& path, const std::string& text) {
  std::error_code error;
  if (text_in(path) != text)
    write(path, text);
  else
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
}

void write_plan(const PlanPlaces& places, const std::vector<Job>& jobs, const States& states,
                const FileTree& tree) {
  write_keys(places, jobs, states.jobs);
  renew(places.build / "tasks.txt", tasks_text(places, jobs, states.jobs));
  renew(places.build / "plan.json", memory_text(states.memory, this_tool()));
  // build.ninja is written last. If the program is stopped before this, the plan is made again.
  renew(places.build / "build.ninja", ninja_text(places, jobs, read_by_plan(places, jobs, states, tree)));
}

// If a file changed while the plan read it, marks the plan as outdated.
void recheck(const PlanPlaces& places, const States& states, std::int64_t began_ns) {
  const bool same = std::all_of(states.jobs.begin(), states.jobs.end(), [](const JobState& state) {
    return must_run(state.state) || is_unchanged(state.read);
  });
  if (same) return;
  const fs::path ninja = places.build / "build.ninja";
  fs::last_write_time(ninja, fs::last_write_time(ninja) - std::chrono::nanoseconds(now_ns() - began_ns));
  std::fprintf(stderr, "nook: files changed while the plan read them; run the command again\n");
}

struct Counts {
  std::array<std::size_t, 5> of_state{};
  double estimate_s = 0;

  std::size_t of(State state) const { return of_state[std::size_t(state)]; }
  std::size_t to_run() const { return of(State::missing) + of(State::waits) + of(State::unreadable); }
};

Counts counts_of(const std::vector<JobState>& states) {
  Counts counts;
  for (const JobState& state : states) {
    ++counts.of_state[std::size_t(state.state)];
    counts.estimate_s += state.estimate_s;
  }
  return counts;
}

std::string summary_of(const std::vector<Job>& jobs, const States& states, const PlanOptions& options) {
  std::string lines;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (must_run(states.jobs[i].state))
      lines += "bake " + jobs[i].kind + " " + jobs[i].output + ": " + states.jobs[i].reason + "\n";
  const Counts counts = counts_of(states.jobs);
  lines += std::to_string(jobs.size()) + " bakes: " + std::to_string(counts.of(State::up_to_date)) +
           " up to date, " + std::to_string(counts.of(State::from_cache)) + " from the cache, " +
           std::to_string(counts.to_run()) + " to run";
  if (counts.to_run() > 0)
    lines += " (about " + platform::duration_text(counts.estimate_s) + " one after another)";
  return lines + (options.dry_run ? "; nothing was written\n" : "\n");
}

std::string report_text(const std::vector<Job>& jobs, const States& states) {
  using Ordered = nlohmann::ordered_json;
  Ordered rows = Ordered::array();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const JobState& state = states.jobs[i];
    rows.push_back({{"output", jobs[i].output},
                    {"kind", jobs[i].kind},
                    {"source", jobs[i].source},
                    {"state", name_of(state.state)},
                    {"reason", state.reason},
                    {"key", state.key},
                    {"estimate_s", state.estimate_s}});
  }
  return Ordered{{"rows", rows}}.dump(2, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

}  // namespace

void add_plan_options(Command command, PlanOptions& o) {
  command
      .add_option("manifest", o.manifest,
                  "the manifest: a JSON file with the rules for all bakes, such as nook.json "
                  "(docs/guide/pipeline.md)")
      .required();
  command.add_option("--build", o.build,
                     "write build.ninja, tasks.txt, keys and logs into this folder. Default: nook-build, "
                     "beside the manifest");
  command.add_option(
      "--cache", o.cache,
      "use this folder as the cache: results that it contains are copied, and new bakes store their results "
      "in it. Default: the folder in the environment variable NOOK_CACHE; no cache if it is not set");
  command
      .add_option("--isa", o.isa,
                  "processor instruction set of all bakes: x86-64-v2, x86-64-v3 (default on x86-64 "
                  "processors) or native (the best set of this processor). Another instruction set gives "
                  "other keys, so everything is baked again")
      .check(one_of({"native", "x86-64-v2", "x86-64-v3"}));
  command
      .add_option("--threads", o.threads,
                  "number of assets that are read at the same time; 0 means one asset per core")
      .check(in_range(0, 1024))
      .capture_default_str();
  command
      .add_option("--bake-threads", o.bake_threads,
                  "number of threads of each bake. 0 means one thread in tasks.txt; in build.ninja, it means "
                  "the number of cores divided by the number of bakes to run")
      .check(in_range(0, 1024))
      .capture_default_str();
  command.add_option("--report", o.report, "write the state of every bake to this JSON file");
  command.add_flag("--quiet", o.quiet, "print errors only");
}

PlanResult make_plan(const PlanOptions& options) {
  const std::int64_t began_ns = now_ns();
  bake::isa_level();
  const Manifest manifest = read_manifest(options.manifest);
  PlanPlaces places = places_of(options, manifest);
  const fs::path report = absolute_path(options.report);
  fs::current_path(manifest.root);
  FileTree tree(manifest.root, places.build);
  const std::vector<Job> jobs = jobs_of(manifest, tree);
  StateOptions how{options.threads, !options.dry_run, {}};
  std::error_code error;
  if (!places.cache.empty() && (!options.dry_run || fs::is_directory(places.cache, error)))
    how.cache.emplace(places.cache);
  if (!options.dry_run) make_folders(places, jobs);
  const States states = states_of(jobs, read_memory(places.build / "plan.json", this_tool()), how);
  const std::size_t to_run = counts_of(states.jobs).to_run();
  places.ninja_threads = options.bake_threads > 0 ? options.bake_threads : shared_threads(to_run);
  places.plan_command = plan_command(options, places);
  if (!options.dry_run) {
    write_plan(places, jobs, states, tree);
    recheck(places, states, began_ns);
  }
  if (!report.empty()) write(report, report_text(jobs, states));
  if (!options.quiet) platform::print(platform::printable_lines(summary_of(jobs, states, options)));
  return {places.build, to_run};
}

}  // namespace nook::tool::plan
