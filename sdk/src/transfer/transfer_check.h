// Checks baked transfer, and the mesh, material and light that it is used with.
#pragma once

#include <nook/nook.h>

#include <span>

#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

// Throws Failure(code) if there is no vertex, the number of lobes is out of range, or an array has the wrong
// length. Shares and frames need no check, because all their byte values are valid.
void check_transfer(const Transfer& transfer, nook_result code);

// Throws Failure(code) if a size or scale of the paper's form is out of range. The arrays are not read.
void check_paper_head(const PaperTransfer& paper, nook_result code);

// Throws Failure(code) unless min_lobes <= lobes <= max_lobes.
void check_lobes(std::uint32_t lobes, nook_result code);

std::uint64_t hash_floats(std::span<const float> values);

// The arrays of a mesh. Empty arrays are not compared.
struct MeshArrays {
  std::span<const float> position, normal, tangent, uv;
  std::uint32_t vertex_count = 0;
};
// Throws Failure(INVALID_ARGUMENT) if an array differs from the baked mesh. The message names the first such
// array.
void check_same_mesh(const Transfer& transfer, const MeshArrays& mesh);

// Throws Failure(INVALID_ARGUMENT) if the bake took the holes of surfaces from a VOTF that is not the
// material's VOTF.
void check_same_material(const Transfer& transfer, std::uint64_t votf_hash);
// Throws Failure(INVALID_ARGUMENT) if the transfer has the paper's form and was baked for the light modes of
// another material.
void check_same_light(const Transfer& transfer, std::uint32_t light_modes, std::uint64_t light_hash);
// Throws Failure(INVALID_ARGUMENT) unless the transfer has this many lobes.
void check_same_lobes(const Transfer& transfer, std::uint32_t lobes);
// Throws Failure(INVALID_ARGUMENT) if `got`, the number of RGB amplitudes, differs from the number of lobes,
// or if an amplitude is so large that vectors might overflow.
void check_amplitudes(const float* amplitudes, std::uint32_t got, std::uint32_t lobes);

}  // namespace nook::transfer
