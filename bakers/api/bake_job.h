// One bake on a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "api/bake_pipeline.h"
#include "api/entry.h"
#include "api/worker_arena.h"

namespace nook::bake {

// What a job is at; finished once its result is known.
struct JobProgress {
  bool started = false, finished = false;
  BakeStage stage = BakeStage::raytrace;
  std::size_t done = 0, total = 0;
};

class BakeJob {
 public:
  using Listener =
      std::function<bool(const JobProgress&)>;  // false cancels; never called once the job has finished

  BakeJob(std::shared_ptr<const ImportedCharacter> character, Recipe recipe, std::vector<Pose> extra_poses,
          std::size_t threads, Listener listener);
  ~BakeJob();  // cancels and waits

  JobProgress progress() const;
  void cancel() { cancelled_ = true; }
  void wait() const;
  // The file of a job that has succeeded. Throws Failure: INVALID_ARGUMENT while it runs, what it failed with
  // otherwise.
  const BakedFile& file() const;
  // Of a finished job.
  const api::Outcome& outcome() const { return outcome_; }

 private:
  void run(const ImportedCharacter& character, const Recipe& recipe, const std::vector<Pose>& extra_poses,
           std::size_t threads);
  bool report(BakeStage stage, std::size_t done, std::size_t total);

  Listener listener_;
  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;  // of what follows
  mutable std::condition_variable changed_;
  JobProgress progress_;
  BakedFile file_;
  api::Outcome outcome_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace nook::bake
