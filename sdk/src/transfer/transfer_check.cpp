#include "sdk/src/transfer/transfer_check.h"

#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/hash.h"

namespace nook::transfer {
namespace {

// The limit for reflected light. Light that equals one harmonic causes an irradiance of at most pi * 0.64 =
// 2.01. 0.64 is the maximum of the harmonics of bands 0 to 2.
constexpr float max_indirect = 4;

void need_size(std::size_t got, std::uint64_t need, const char* what, nook_result code) {
  if (got != need)
    throw Failure(code, "the array of %s has the wrong length (got %zu, need %llu)", what, got,
                  static_cast<unsigned long long>(need));
}

void check_halves(std::span<const std::uint16_t> halves, float limit, const char* what, nook_result code) {
  for (std::size_t i = 0; i < halves.size(); ++i)
    if (!(std::abs(from_half(halves[i])) <= limit))
      throw Failure(code, "element %zu of the %s is out of range (got %g, need -%g to %g)", i, what,
                    double(from_half(halves[i])), double(limit), double(limit));
}

void check_indirect(const Transfer& transfer, nook_result code) {
  check_range("the number of reflections", transfer.bounces, 0, max_bounces, code);
  const std::size_t need = std::size_t(transfer.vertex_count()) * transfer.bounces * band_count;
  need_size(transfer.indirect.size(), need, "reflected light", code);
  check_halves(transfer.indirect, max_indirect, "reflected light", code);
}

void check_arrays(const Transfer& transfer, nook_result code) {
  const std::uint64_t shares = std::uint64_t(transfer.frames.size()) * transfer.lobes;
  need_size(transfer.shares.size(), shares, "shares", code);
}

}  // namespace

void check_paper_head(const PaperTransfer& paper, nook_result code) {
  check_range("the number of light modes", paper.light_modes, 4, max_light_modes, code);
  if (paper.light_modes % 4 != 0)
    throw Failure(code, "the number of light modes is not a multiple of 4 (got %u)", paper.light_modes);
  check_range("the number of clusters", paper.clusters, 1, max_clusters, code);
  check_range("the number of lobe modes", paper.lobe_rank, 1, max_lobe_rank, code);
  check_range("the number of vertex modes", paper.vertex_rank, 1, max_vertex_rank, code);
  if (!(paper.scale > 0) || !(paper.scale <= max_core_scale))
    throw Failure(code, "the scale of the cores is out of range (got %g, need more than 0, up to %g)",
                  double(paper.scale), double(max_core_scale));
}

namespace {

void check_paper(const Transfer& transfer, nook_result code) {
  const PaperTransfer& p = transfer.paper;
  check_paper_head(p, code);
  const std::uint64_t vertices = p.cluster.size(), entries = std::uint64_t(3) * p.light_modes * p.vertex_rank;
  need_size(p.lobe_basis.size(), std::uint64_t(p.clusters) * transfer.lobes * p.lobe_rank, "lobe bases",
            code);
  need_size(p.cores.size(), p.clusters * entries * p.lobe_rank, "cores", code);
  need_size(p.coefficients.size(), vertices * p.vertex_rank, "coefficients", code);
  need_size(transfer.frames.size(), 0, "frames", code);
  need_size(transfer.shares.size(), 0, "shares", code);
  check_halves(p.lobe_basis, 1, "lobe bases", code);
  check_halves(p.cores, 65504, "cores", code);
  check_halves(p.coefficients, 1, "coefficients", code);
  for (std::size_t v = 0; v < vertices; ++v)
    if (p.cluster[v] >= p.clusters)
      throw Failure(code, "vertex %zu belongs to cluster %u, but there are only %u clusters", v,
                    std::uint32_t(p.cluster[v]), p.clusters);
}

}  // namespace

void check_lobes(std::uint32_t lobes, nook_result code) {
  check_range("the number of lobes", lobes, min_lobes, max_lobes, code);
}

void check_transfer(const Transfer& transfer, nook_result code) {
  check_lobes(transfer.lobes, code);
  check_range("the number of vertices", transfer.vertex_count(), 1, max_vertices, code);
  if (transfer.paper.is_used())
    check_paper(transfer, code);
  else
    check_arrays(transfer, code);
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
                  "the mesh has another number of vertices than the baked mesh (got %u, need %u); bake the "
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
                    "the %s of the mesh differ from the baked mesh (got the hash %016llx, need %016llx); "
                    "bake the transfer of this mesh",
                    array.name, static_cast<unsigned long long>(hash),
                    static_cast<unsigned long long>(array.baked));
  }
}

void check_same_material(const Transfer& transfer, std::uint64_t votf_hash) {
  if (transfer.votf_hash == 0 || transfer.votf_hash == votf_hash) return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the transfer was baked with the holes of another material, as its VOTF shows (got the hash "
                "%016llx, need %016llx); bake the transfer with this material",
                static_cast<unsigned long long>(votf_hash),
                static_cast<unsigned long long>(transfer.votf_hash));
}

void check_same_light(const Transfer& transfer, std::uint32_t light_modes, std::uint64_t light_hash) {
  const PaperTransfer& paper = transfer.paper;
  if (!paper.is_used() || (paper.light_modes == light_modes && paper.light_hash == light_hash)) return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the transfer has the paper's form and was baked with other light modes (got %u modes with "
                "the hash %016llx, need %u with %016llx); bake it with this material, or in the separated "
                "form, which works with any material",
                light_modes, static_cast<unsigned long long>(light_hash), paper.light_modes,
                static_cast<unsigned long long>(paper.light_hash));
}

void check_same_lobes(const Transfer& transfer, std::uint32_t lobes) {
  if (transfer.lobes == lobes) return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "lobe_count differs from the transfer's lobe count (got %u, need %u); create the response "
                "and the fit with the same number of lobes",
                lobes, transfer.lobes);
}

void check_amplitudes(const float* amplitudes, std::uint32_t got, std::uint32_t lobes) {
  constexpr float max_amplitude = 1e22f;
  if (got != lobes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "lobe_count differs from the response's lobe count (got %u, need %u)", got, lobes);
  for (std::uint32_t i = 0; i < 3 * lobes; ++i)
    if (!(std::abs(amplitudes[i]) <= max_amplitude))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the amplitude of lobe %u is out of range (got %g, need finite numbers up to 1e22)",
                    i / 3, double(amplitudes[i]));
}

}  // namespace nook::transfer
