#include "api/bake_job.h"

namespace nook::bake {

BakeJob::BakeJob(std::shared_ptr<const ImportedCharacter> character, Recipe recipe,
                 std::vector<Pose> extra_poses, std::size_t threads, Listener listener)
    : listener_(std::move(listener)),
      thread_([this, character = std::move(character), recipe = std::move(recipe),
               extra_poses = std::move(extra_poses),
               threads] { run(*character, recipe, extra_poses, threads); }) {}

BakeJob::~BakeJob() {
  cancel();
  thread_.join();
}

void BakeJob::run(const ImportedCharacter& character, const Recipe& recipe,
                  const std::vector<Pose>& extra_poses, std::size_t threads) {
  BakedFile file;
  api::Outcome outcome;
  try {
    run_with_threads(threads, [&] {
      file = bake_by_recipe(character, recipe, extra_poses,
                            [this](BakeStage stage, std::size_t done, std::size_t total) {
                              return report(stage, done, total);
                            });
    });
    // A request that came after the last chance to stop still holds: whoever cancels does not want the file.
    if (cancelled_) throw Failure(NOOK_ERROR_CANCELLED, "cancelled when the bake was nearly done");
  } catch (...) {
    outcome = api::outcome_of(std::current_exception());
  }
  const std::lock_guard lock(mutex_);
  file_ = std::move(file);
  outcome_ = outcome;
  progress_.finished = true;
  changed_.notify_all();
}

bool BakeJob::report(BakeStage stage, std::size_t done, std::size_t total) {
  JobProgress now{true, false, stage, done, total};
  {
    const std::lock_guard lock(mutex_);
    progress_ = now;
  }
  if (cancelled_) return false;
  if (listener_ && !listener_(now)) cancelled_ = true;
  return !cancelled_;
}

JobProgress BakeJob::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void BakeJob::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return progress_.finished; });
}

const BakedFile& BakeJob::file() const {
  if (!progress().finished)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the job is still running; call nook_bake_job_wait first");
  if (outcome_.result != NOOK_OK) throw Failure(outcome_.result, "%s", outcome_.text);
  return file_;
}

}  // namespace nook::bake
