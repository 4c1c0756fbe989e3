// The objects behind the public handles, and the functions behind nook_bake_start(), one for each descriptor.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <memory>

#include "bakers/import/gltf.h"
#include "bakers/job/bake_job.h"

struct nook_bake_character_s {
  std::shared_ptr<const nook::bake::ImportedCharacter> character;  // shared with jobs
};

struct nook_bake_job_s {
  nook::bake::BakeJob job;
};

namespace nook::bake::api {

// Reads the descriptor, whose type is checked already, and starts its job. Throws Failure.
nook_bake_job_s* start_character(const void* desc);
nook_bake_job_s* start_bent(const void* desc);
nook_bake_job_s* start_clips(const void* desc);
nook_bake_job_s* start_material(const void* desc);
nook_bake_job_s* start_synthesis(const void* desc);
nook_bake_job_s* start_transfer(const void* desc);

// Starts the bake with the threads and the progress of its descriptor.
template <class Desc>
nook_bake_job_s* start_job(const Desc& d, BakeJob::Bake bake) {
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}

using Starter = nook_bake_job_s* (*)(const void* desc);

// Returns nullptr for a type that is not a bake. bake_starters.cpp knows every bake. A library of characters
// alone links character_starters.cpp instead, and with it none of the other bakers.
Starter starter_of(std::uint32_t type);

}  // namespace nook::bake::api
