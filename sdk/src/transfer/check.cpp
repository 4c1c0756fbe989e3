#include "sdk/src/transfer/check.h"

#include <cmath>

#include "sdk/src/core/bit_cast.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/half.h"
#include "sdk/src/core/hash.h"

namespace nook::transfer {
namespace {

// A hemisphere of light of one band gives an irradiance up to pi times the harmonic's maximum, 0.64.
constexpr float max_indirect = 4;

void check_indirect(const Transfer& transfer, nook_result code) {
  if (transfer.bounces > max_bounces)
    throw Failure(code, "the number of reflections is out of range (got %u, need 0 to %u)", transfer.bounces,
                  max_bounces);
  const std::size_t need = transfer.frames.size() * transfer.bounces * band_count;
  if (transfer.indirect.size() != need)
    throw Failure(code, "the array of reflected light has the wrong length (got %zu, need %zu)",
                  transfer.indirect.size(), need);
  for (std::size_t i = 0; i < need; ++i)
    if (!(std::abs(from_half(transfer.indirect[i])) <= max_indirect))
      throw Failure(code, "the reflected light of vertex %zu is out of range (got %g, need -%g to %g)",
                    i / (transfer.bounces * band_count), double(from_half(transfer.indirect[i])),
                    double(max_indirect), double(max_indirect));
}

}  // namespace

void check_lobes(std::uint32_t lobes, nook_result code) {
  if (lobes < min_lobes || lobes > max_lobes)
    throw Failure(code, "the number of lobes is out of range (got %u, need %u to %u)", lobes, min_lobes,
                  max_lobes);
}

void check_transfer(const Transfer& transfer, nook_result code) {
  check_lobes(transfer.lobes, code);
  if (transfer.frames.empty() || transfer.frames.size() > max_vertices)
    throw Failure(code, "the number of vertices is out of range (got %zu, need 1 to %u)",
                  transfer.frames.size(), max_vertices);
  const std::size_t shares = transfer.frames.size() * transfer.lobes;
  if (transfer.shares.size() != shares)
    throw Failure(code, "the array of shares has the wrong length (got %zu, need %zu)",
                  transfer.shares.size(), shares);
  check_indirect(transfer, code);
}

std::uint64_t hash_floats(std::span<const float> values) {
  Hash64 hash;
  for (const float value : values) {
    const std::uint32_t bits = bit_cast<std::uint32_t>(value + 0.0f);
    const std::byte bytes[4] = {std::byte(bits), std::byte(bits >> 8), std::byte(bits >> 16),
                                std::byte(bits >> 24)};
    hash.add(bytes);
  }
  return hash.value();
}

void check_same_mesh(const Transfer& transfer, const MeshArrays& mesh) {
  if (mesh.vertex_count != transfer.vertex_count())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the mesh has another number of vertices than the baked one (got %u, need %u); bake the "
                  "transfer of this mesh",
                  mesh.vertex_count, transfer.vertex_count());
  const struct {
    const char* name;
    std::span<const float> values;
    std::uint64_t baked;
  } arrays[] = {{"positions", mesh.position, transfer.hashes.position},
                {"normals", mesh.normal, transfer.hashes.normal},
                {"tangents", mesh.tangent, transfer.hashes.tangent},
                {"texture coordinates", mesh.uv, transfer.hashes.uv}};
  for (const auto& array : arrays) {
    if (array.values.empty()) continue;
    const std::uint64_t hash = hash_floats(array.values);
    if (hash != array.baked)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the %s of the mesh are not those of the baked one (got the hash %016llx, need "
                    "%016llx); bake the transfer of this mesh",
                    array.name, static_cast<unsigned long long>(hash),
                    static_cast<unsigned long long>(array.baked));
  }
}

void check_same_material(const Transfer& transfer, std::uint64_t votf_hash) {
  if (transfer.votf_hash == 0 || transfer.votf_hash == votf_hash) return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the VOTF of the material is not the one whose holes were baked (got the hash %016llx, need "
                "%016llx); bake the transfer with this material",
                static_cast<unsigned long long>(votf_hash),
                static_cast<unsigned long long>(transfer.votf_hash));
}

}  // namespace nook::transfer
