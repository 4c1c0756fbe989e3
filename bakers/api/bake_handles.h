// The objects behind the public handles, and the functions behind nook_bake_start() and nook_bake_key(), for
// each descriptor.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <memory>

#include "bakers/import/gltf.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/bake_job.h"

struct nook_bake_character_s {
  std::shared_ptr<const nook::bake::ImportedCharacter> character;  // shared with jobs
  nook::bake::MeshSelection meshes;                                // of its source
};

struct nook_bake_job_s {
  nook::bake::BakeJob job;
};

namespace nook::bake::api {

// The functions behind one kind of bake. Both read the descriptor, whose type is checked already, and throw
// Failure.
struct Bake {
  nook_bake_job_s* (*start)(const void* desc) = nullptr;
  BakeIdentity (*identify)(const void* desc) = nullptr;
};

// The bake of characters, which every library has.
Bake character_bake();

// Starts the bake with the threads and the progress of its descriptor.
template <class Desc>
nook_bake_job_s* start_job(const Desc& d, BakeJob::Bake bake) {
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}

// Returns null pointers for a type that is not a bake. bake_starters.cpp knows every bake. A library of
// characters alone links character_starters.cpp instead, and with it none of the other bakers.
Bake bake_of(std::uint32_t type);

}  // namespace nook::bake::api
