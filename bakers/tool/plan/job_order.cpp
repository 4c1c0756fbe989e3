#include "bakers/tool/plan/job_order.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

std::string normal(const fs::path& path) {
  return path.lexically_normal().generic_string();
}

void require_inside(const Manifest& m, const Job& job, const std::string& option, const std::string& path) {
  const bool is_outside = path.starts_with("/") || path == ".." || path.starts_with("../");
  if (is_outside)
    refuse(m, job.place,
           option + " of " + job.source + " lies outside the manifest's folder (got " + path +
               "); move the file or the manifest");
}

// The job that writes each file.
using Writers = std::map<std::string, std::size_t>;

void add_writer(const Manifest& m, const std::vector<Job>& jobs, std::size_t job, const std::string& file,
                Writers& writers) {
  const auto [known, is_new] = writers.emplace(file, job);
  if (is_new) return;
  const Job &one = jobs[known->second], &other = jobs[job];
  refuse(m, other.place + ".output",
         one.source + " (" + one.kind + ") and " + other.source + " (" + other.kind +
             ") would have the same output, " + file +
             "; use {dir} and {stem} in the pattern, or skip one of them");
}

Writers writers_of(const Manifest& m, const std::vector<Job>& jobs) {
  Writers writers;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    add_writer(m, jobs, i, jobs[i].output, writers);
    add_writer(m, jobs, i, report_of(jobs[i].output), writers);
    for (const NamedFile& file : jobs[i].outline.files.outputs)
      if (!file.path.empty()) add_writer(m, jobs, i, normal(file.path), writers);
  }
  const auto manifest = writers.find(m.file.filename().string());
  if (manifest != writers.end())
    refuse(
        m, jobs[manifest->second].place + ".output",
        "the report of " + jobs[manifest->second].output + " would replace the manifest; use another folder");
  return writers;
}

void find_needs(const Manifest& m, std::vector<Job>& jobs, const Writers& writers) {
  for (std::size_t i = 0; i < jobs.size(); ++i)
    for (const NamedFile& input : jobs[i].outline.files.inputs) {
      if (input.path.empty()) continue;
      const std::string path = normal(input.path);
      require_inside(m, jobs[i], input.option, path);
      const auto writer = writers.find(path);
      if (writer != writers.end()) jobs[i].needs.push_back(writer->second);
    }
}

[[noreturn]] void refuse_circle(const Manifest& m, const std::vector<Job>& jobs, std::size_t job,
                                const std::vector<std::size_t>& open) {
  std::string text;
  for (auto at = std::find(open.begin(), open.end(), job); at != open.end(); ++at)
    text += jobs[*at].output + " needs ";
  refuse(m, jobs[job].place,
         "bakes depend on each other in a circle: " + text + jobs[job].output +
             "; give one of them another input or output");
}

struct Order {
  const Manifest& manifest;
  const std::vector<Job>& jobs;
  std::vector<std::size_t> done, open;  // indices of jobs
  std::vector<char> state;              // 0 new, 1 open, 2 done

  void visit(std::size_t job) {
    if (state[job] == 2) return;
    if (state[job] == 1) refuse_circle(manifest, jobs, job, open);
    state[job] = 1;
    open.push_back(job);
    for (const std::size_t need : jobs[job].needs) visit(need);
    open.pop_back();
    state[job] = 2;
    done.push_back(job);
  }
};

// Jobs that `needs` connects form a group. The number of a group is the smallest index of its jobs.
void find_groups(std::vector<Job>& jobs) {
  std::vector<std::size_t> parent(jobs.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](std::size_t job) {
    while (parent[job] != job) job = parent[job] = parent[parent[job]];
    return job;
  };
  for (std::size_t i = 0; i < jobs.size(); ++i)
    for (const std::size_t need : jobs[i].needs) {
      const std::size_t a = root_of(i), b = root_of(need);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t i = 0; i < jobs.size(); ++i) jobs[i].group = root_of(i);
}

}  // namespace

std::vector<Job> ordered_jobs(const Manifest& manifest, std::vector<Job> jobs) {
  find_needs(manifest, jobs, writers_of(manifest, jobs));
  Order order{manifest, jobs, {}, {}, std::vector<char>(jobs.size(), 0)};
  for (std::size_t i = 0; i < jobs.size(); ++i) order.visit(i);
  std::vector<std::size_t> place(jobs.size());
  for (std::size_t i = 0; i < order.done.size(); ++i) place[order.done[i]] = i;
  std::vector<Job> sorted;
  for (const std::size_t job : order.done) {
    sorted.push_back(std::move(jobs[job]));
    for (std::size_t& need : sorted.back().needs) need = place[need];
  }
  find_groups(sorted);
  return sorted;
}

}  // namespace nook::tool::plan
