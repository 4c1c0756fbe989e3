// The objects behind the public handles. For each descriptor, also the functions behind nook_bake_start() and
// nook_bake_key().
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <memory>

#include "bakers/import/gltf.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/bake_job.h"

struct nook_bake_character_s {
  std::shared_ptr<const nook::bake::ImportedCharacter> character;  // shared with jobs
  nook::bake::MeshSelection meshes;                                // which meshes of its source it uses
};

struct nook_bake_job_s {
  nook::bake::BakeJob job;
};

namespace nook::bake::api {

// The functions that implement one kind of bake. Both read the descriptor, whose type the caller has checked.
// Both throw Failure.
struct Bake {
  nook_bake_job_s* (*start)(const void* desc) = nullptr;
  BakeIdentity (*identify)(const void* desc) = nullptr;
};

// Returns the bake of characters. Every library contains it.
Bake character_bake();

// Starts the bake with the thread count and the progress callback of its descriptor.
template <class Desc>
nook_bake_job_s* start_job(const Desc& d, BakeJob::Bake bake) {
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}

// Returns null pointers if `type` is not a bake. The definition in bake_starters.cpp supports every bake. A
// library that only bakes characters links the definition in character_starters.cpp instead, so that it does
// not link the other bakers.
Bake bake_of(std::uint32_t type);

}  // namespace nook::bake::api
