// A bake of the hero's model in the background, which reports its progress.
#pragma once

#include <memory>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

class ModelBake {
 public:
  // gamma is the exponent of the norm that adds up shadows; 0 takes the preset's.
  ModelBake(const Hero& hero, nook_bake_preset preset, float gamma);

  nook_bake_progress progress() const;
  bool is_done() const { return progress().state == NOOK_BAKE_DONE; }
  void cancel();
  // Waits for the bytes of the .nook file. Throws BakeError, also if the bake was cancelled.
  std::vector<unsigned char> model() const;

 private:
  struct Release {
    void operator()(nook_bake_job job) const { nook_bake_job_destroy(&job); }
  };
  std::unique_ptr<nook_bake_job_s, Release> job_;
};

}  // namespace crowd
