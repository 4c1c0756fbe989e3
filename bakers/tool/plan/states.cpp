#include "bakers/tool/plan/states.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/depfile.h"
#include "bakers/tool/plan/reasons.h"
#include "platform/file_waits.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

// What one job adds to the memory of the next plan.
struct Learned {
  std::optional<KnownBake> bake;
  std::optional<KnownOutput> output;
};

struct Work {
  const std::vector<Job>& jobs;
  const Memory& known;
  const StateOptions& options;
  std::vector<JobState>& states;
  std::vector<Learned>& learned;
};

std::vector<StampedFile> stamped(const std::vector<fs::path>& files) {
  std::vector<StampedFile> all;
  for (const fs::path& file : files) all.push_back({file.string(), stamp_of(file)});
  return all;
}

// Returns the text of the identity. It comes from the memory if nothing that the identity depends on has
// changed.
std::string identity_text(const Work& work, std::size_t i) {
  const Job& job = work.jobs[i];
  const auto known = work.known.bakes.find(job.output);
  if (known != work.known.bakes.end() && known->second.words == job.words &&
      is_unchanged(known->second.read)) {
    work.learned[i].bake = known->second;
    work.states[i].read = known->second.read;
    return known->second.identity;
  }
  const std::int64_t began_ns = now_ns();
  work.states[i].read = stamped(files_read(job.outline.files, job.outline.reads_images));
  const std::vector<StampedFile>& read = work.states[i].read;
  std::string text = identity_of(job.words).text;
  if (is_unchanged(read) && !is_too_young(read, began_ns))
    work.learned[i].bake = KnownBake{job.words, read, text};
  return text;
}

std::string output_identity(const Work& work, std::size_t i) {
  const std::string& output = work.jobs[i].output;
  const Stamp stamp = stamp_of(output);
  if (stamp.bytes < 0) return "";
  const auto known = work.known.outputs.find(output);
  if (known != work.known.outputs.end() && known->second.stamp == stamp) {
    work.learned[i].output = known->second;
    return known->second.identity;
  }
  std::string text = identity_in(output);
  if (stamp_of(output) == stamp) work.learned[i].output = KnownOutput{stamp, text};
  return text;
}

// Returns true if the cache has the result. Copies it in the same order as a bake writes it, with the report
// first.
bool take_from_cache(const Work& work, std::size_t i, const std::string& identity) {
  const Job& job = work.jobs[i];
  if (!work.options.cache || !job.outline.is_cacheable) return false;
  const std::optional<BakeOutput> hit = work.options.cache->find(work.states[i].key, true);
  if (!hit || !work.options.writes) return hit.has_value();
  if (job.output.find('/') != std::string::npos) fs::create_directories(fs::path(job.output).parent_path());
  platform::OutputFile report(report_of(job.output), file_events(true)), model(job.output, file_events(true));
  report.commit(hit->report);
  model.commit(hit->file);
  work.learned[i].output = KnownOutput{stamp_of(job.output), identity};
  return true;
}

void decide(const Work& work, std::size_t i) {
  const Job& job = work.jobs[i];
  JobState& state = work.states[i];
  const std::string identity = identity_text(work, i);
  state.key = bake::BakeIdentity{identity}.key();
  const std::string there = output_identity(work, i);
  if (there == identity) {
    state.state = State::up_to_date;
  } else if (take_from_cache(work, i, identity)) {
    state.state = State::from_cache;
  } else {
    state.reason = reason_of(job, identity, there, stamp_of(job.output).bytes >= 0,
                             work.known.outputs.contains(job.output));
  }
}

// Finds the job that a job waits for. That job must run first, or a dry run has not copied its result.
const Job* first_unready(const Work& work, std::size_t i) {
  for (const std::size_t need : work.jobs[i].needs) {
    const State state = work.states[need].state;
    if (must_run(state) || (state == State::from_cache && !work.options.writes)) return &work.jobs[need];
  }
  return nullptr;
}

void examine(const Work& work, std::size_t i) {
  JobState& state = work.states[i];
  if (interrupted()) throw platform::Stopped("plan: stopped; nothing was written");
  if (const Job* const need = first_unready(work, i)) {
    state.state = State::waits;
    state.reason = "after " + need->output;
    // The next plan will try again. The files that cannot be read stay in the list of files that the plan
    // depends on.
    state.read = stamped(files_read(work.jobs[i].outline.files, work.jobs[i].outline.reads_images));
    output_identity(work, i);
    const auto known = work.known.bakes.find(work.jobs[i].output);
    if (known != work.known.bakes.end()) work.learned[i].bake = known->second;
  } else {
    try {
      decide(work, i);
    } catch (const platform::Stopped&) {
      throw;
    } catch (const ToolError& error) {
      state = {State::unreadable, error.what(), "", 0, state.read};
    } catch (const Failure& failure) {
      state = {State::unreadable, failure.what(), "", 0, state.read};
    } catch (const std::runtime_error& error) {  // a result from the cache could not be written
      state = {State::missing, error.what(), state.key, 0, state.read};
    }
  }
  if (must_run(state.state)) state.estimate_s = estimate_s(work.jobs[i], state.read);
}

}  // namespace

const char* name_of(State state) {
  constexpr const char* names[] = {"up to date", "from the cache", "missing", "waits", "unreadable"};
  return names[std::size_t(state)];
}

States states_of(const std::vector<Job>& jobs, const Memory& known, const StateOptions& options) {
  States states;
  states.jobs.resize(jobs.size());
  std::vector<Learned> learned(jobs.size());
  std::map<std::size_t, std::vector<std::size_t>> by_group;
  for (std::size_t i = 0; i < jobs.size(); ++i) by_group[jobs[i].group].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [number, members] : by_group) groups.push_back(std::move(members));
  const Work work{jobs, known, options, states.jobs, learned};
  bake::run_with_threads(options.threads, [&] {
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
      for (const std::size_t i : groups[g]) examine(work, i);
    });
  });
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (learned[i].bake) states.memory.bakes[jobs[i].output] = std::move(*learned[i].bake);
    if (learned[i].output) states.memory.outputs[jobs[i].output] = std::move(*learned[i].output);
  }
  return states;
}

}  // namespace nook::tool::plan
