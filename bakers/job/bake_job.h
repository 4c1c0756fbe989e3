// Runs one bake on its own thread. Provides the outcome and the progress of the bake in the form that the C
// interface uses.
#pragma once

#include <nook/nook.h>
#include <nook/nook_bake.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "bakers/job/baked_file.h"
#include "bakers/raytrace/worker_arena.h"

namespace nook::bake {

// The result code and the text that the C interface returns for an exception.

struct Outcome {
  nook_result result = NOOK_OK;
  char text[480] = "";
};

Outcome outcome_of(const std::exception_ptr& exception) noexcept;

// The progress of a job. A job counts as finished as soon as its result is known.
struct JobProgress {
  bool finished = false;
  JobStage stage = JobStage::waiting;
  std::size_t done = 0, total = 0;
};

class BakeJob {
 public:
  using Listener = std::function<bool(const JobProgress&)>;  // return false to cancel; never called after the
                                                             // job has finished

  // The job calls this function once and lets it use `threads` threads (0: all cores). The function object is
  // destroyed together with the job.
  using Bake = std::function<BakedFile(const StageReport&)>;

  BakeJob(Bake bake, std::size_t threads, Listener listener);
  ~BakeJob();  // cancels and waits

  JobProgress progress() const;
  void cancel() { cancelled_ = true; }
  void wait() const;
  // Returns the file of a job that succeeded. Throws Failure: INVALID_ARGUMENT while the job runs, or the
  // failure of the job.
  const BakedFile& file() const;
  // Returns the outcome of a finished job.
  const Outcome& outcome() const { return outcome_; }

 private:
  void run(const Bake& bake, std::size_t threads);
  bool report(JobStage stage, std::size_t done, std::size_t total);

  Listener listener_;
  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;  // guards the members below
  mutable std::condition_variable changed_;
  JobProgress progress_;
  BakedFile file_;
  Outcome outcome_;
  std::thread thread_;  // must be the last member, because the thread uses all members above
};

inline nook_bake_progress public_progress(const JobProgress& p) {
  const nook_bake_state state = p.finished                     ? NOOK_BAKE_DONE
                                : p.stage == JobStage::waiting ? NOOK_BAKE_WAITING
                                                               : NOOK_BAKE_RUNNING;
  return {std::uint32_t(sizeof(nook_bake_progress)), state, text_of(p.stage), p.done, p.total};
}

// Returns an empty listener if there is no callback.
inline BakeJob::Listener listener_of(nook_bake_progress_fn call, void* user) {
  if (!call) return {};
  return [call, user](const JobProgress& p) {
    const nook_bake_progress now = public_progress(p);
    return call(user, &now) != 0;
  };
}

}  // namespace nook::bake
