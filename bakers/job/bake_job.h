// One bake on a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "bakers/job/baked_file.h"
#include "bakers/job/outcome.h"
#include "bakers/job/worker_arena.h"

namespace nook::bake {

// The stage of a job; it is finished once its result is known.
struct JobProgress {
  bool finished = false;
  JobStage stage = JobStage::waiting;
  std::size_t done = 0, total = 0;
};

class BakeJob {
 public:
  using Listener =
      std::function<bool(const JobProgress&)>;  // false cancels; never called once the job has finished

  // Runs once, on `threads` threads (0: all cores), and is destroyed with the job.
  using Bake = std::function<BakedFile(const StageReport&)>;

  BakeJob(Bake bake, std::size_t threads, Listener listener);
  ~BakeJob();  // cancels and waits

  JobProgress progress() const;
  void cancel() { cancelled_ = true; }
  void wait() const;
  // Returns the file of a job that succeeded. Throws Failure: INVALID_ARGUMENT while the job runs, else the
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
  std::thread thread_;  // the last member, because it uses all of the above
};

}  // namespace nook::bake
