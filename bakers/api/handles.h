// The objects behind the public handles.
#pragma once

#include <nook/nook_bake.h>

#include <memory>

#include "bakers/import/gltf.h"
#include "bakers/job/bake_job.h"

struct nook_bake_character_s {
  std::shared_ptr<const nook::bake::ImportedCharacter> character;  // shared with jobs
};

struct nook_bake_job_s {
  nook::bake::BakeJob job;
};
