#include "bakers/job/bake_job.h"

#include <cstdio>
#include <new>
#include <stdexcept>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

Outcome make_outcome(nook_result result, const char* text) noexcept {
  Outcome outcome;
  outcome.result = result;
  std::snprintf(outcome.text, sizeof outcome.text, "%s", text);
  return outcome;
}

}  // namespace

Outcome outcome_of(const std::exception_ptr& exception) noexcept {
  try {
    std::rethrow_exception(exception);
  } catch (const Failure& failure) {
    return make_outcome(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return make_outcome(
        NOOK_ERROR_OUT_OF_MEMORY,
        "not enough memory; use fewer poses, directions or texels, or free memory and call again");
  } catch (const std::length_error&) {
    return make_outcome(NOOK_ERROR_OUT_OF_MEMORY,
                        "more memory is needed than can be addressed; use smaller data");
  } catch (const std::exception& e) {
    return make_outcome(NOOK_ERROR_INTERNAL, e.what());
  } catch (...) {
    return make_outcome(NOOK_ERROR_INTERNAL, "an unknown exception; please report it");
  }
}

BakeJob::BakeJob(Bake bake, std::size_t threads, Listener listener)
    : listener_(std::move(listener)),
      thread_([this, bake = std::move(bake), threads] { run(bake, threads); }) {}

BakeJob::~BakeJob() {
  cancel();
  thread_.join();
}

void BakeJob::run(const Bake& bake, std::size_t threads) {
  BakedFile file;
  Outcome outcome;
  try {
    run_with_threads(threads, [&] {
      file = bake(
          [this](JobStage stage, std::size_t done, std::size_t total) { return report(stage, done, total); });
    });
    // A request to cancel has an effect even after the last progress callback, because the caller does not
    // need the file.
    if (cancelled_) throw Failure(NOOK_ERROR_CANCELLED, "cancelled shortly before the end of the bake");
  } catch (...) {
    outcome = outcome_of(std::current_exception());
  }
  const std::lock_guard lock(mutex_);
  file_ = std::move(file);
  outcome_ = outcome;
  progress_.finished = true;
  progress_.stage = JobStage::done;
  changed_.notify_all();
}

bool BakeJob::report(JobStage stage, std::size_t done, std::size_t total) {
  JobProgress now{false, stage, done, total};
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
