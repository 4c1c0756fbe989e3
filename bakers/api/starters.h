// The functions behind nook_bake_start(), one for each descriptor of a bake.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>

namespace nook::bake::api {

// Reads the descriptor, whose type is checked already, and starts its job. Throws Failure.
nook_bake_job_s* start_character(const void* desc);
nook_bake_job_s* start_bent(const void* desc);
nook_bake_job_s* start_clips(const void* desc);
nook_bake_job_s* start_material(const void* desc);
nook_bake_job_s* start_synthesis(const void* desc);
nook_bake_job_s* start_transfer(const void* desc);

using Starter = nook_bake_job_s* (*)(const void* desc);

// Returns nullptr for a type that is no bake. all_starters.cpp knows every bake; a library of characters
// alone links character_starters.cpp instead, and with it none of the other bakers.
Starter starter_of(std::uint32_t type);

}  // namespace nook::bake::api
