#include "bakers/tensor/empty_clusters.h"

#include <algorithm>

namespace nook::bake::tensor {
namespace {

// Entries of the membership by cluster.
std::vector<std::vector<std::size_t>> entries_of(const std::vector<std::uint32_t>& membership,
                                                 std::size_t clusters) {
  std::vector<std::vector<std::size_t>> entries(clusters);
  for (std::size_t e = 0; e < membership.size(); ++e) entries[membership[e]].push_back(e);
  return entries;
}

}  // namespace

std::vector<std::size_t> split_into_empty(std::vector<std::uint32_t>& membership, std::size_t mixture,
                                          std::size_t clusters, const std::vector<double>& error) {
  std::vector<std::vector<std::size_t>> entries = entries_of(membership, clusters);
  std::vector<std::size_t> changed;
  const auto error_of = [&](std::size_t entry) { return error[entry / mixture]; };
  for (std::size_t empty = 0; empty < clusters; ++empty) {
    if (!entries[empty].empty()) continue;
    std::size_t worst = clusters;
    double greatest = -1;
    for (std::size_t c = 0; c < clusters; ++c) {
      double sum = 0;
      for (std::size_t e : entries[c]) sum += error_of(e);
      if (entries[c].size() < 2 || sum <= greatest) continue;
      greatest = sum;
      worst = c;
    }
    if (worst == clusters) break;
    std::vector<std::size_t>& from = entries[worst];
    std::stable_sort(from.begin(), from.end(),
                     [&](std::size_t a, std::size_t b) { return error_of(a) < error_of(b); });
    const auto half = from.begin() + std::ptrdiff_t((from.size() + 1) / 2);
    entries[empty].assign(half, from.end());
    from.erase(half, from.end());
    for (std::size_t e : entries[empty]) membership[e] = std::uint32_t(empty);
    changed.insert(changed.end(), entries[empty].begin(), entries[empty].end());
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

}  // namespace nook::bake::tensor
