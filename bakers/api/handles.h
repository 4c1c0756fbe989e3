// The objects behind the public handles.
#pragma once

#include <nook/nook_bake.h>

#include <memory>

#include "api/bake_job.h"
#include "import/gltf.h"

struct nook_bake_character_s {
  std::shared_ptr<const nook::bake::ImportedCharacter> character;  // shared with jobs
};

struct nook_bake_job_s {
  nook::bake::BakeJob job;
};
