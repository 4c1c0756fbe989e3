#include "character/linear_layer.h"

#include <algorithm>
#include <vector>

#include "core/failure.h"

namespace nook {
namespace {

// Number of entries with alpha > 0 of each vertex; throws where the model contradicts itself.
std::pmr::vector<std::uint32_t> used_entries(const CharacterModel& model, std::pmr::memory_resource* memory) {
  const std::size_t vertices = model.vertex_count(), influences = model.influences;
  if (model.alpha.size() != vertices * influences || model.influence.size() != vertices * influences)
    throw Failure(NOOK_ERROR_BAD_FILE, "linear layer has %zu indices and %zu weights (need %zu of each)",
                  model.influence.size(), model.alpha.size(), vertices * influences);
  std::pmr::vector<std::uint32_t> used(vertices, 0, memory);
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::size_t s = 0; s < influences; ++s) {
      if (model.alpha[v * influences + s] == 0) continue;
      const std::uint16_t key_point = model.influence[v * influences + s];
      if (key_point >= model.key_points.size())
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "vertex %zu is shaded by key point %u, which is not one of the model's (need < %zu)", v,
                      static_cast<unsigned>(key_point), model.key_points.size());
      ++used[v];
    }
  return used;
}

// Vertices by falling number of entries; those with equally many keep their order and with it their
// neighbourhood.
std::pmr::vector<std::uint32_t> slot_order(const std::pmr::vector<std::uint32_t>& used,
                                           std::pmr::memory_resource* memory) {
  std::uint32_t most = 0;
  for (const std::uint32_t n : used) most = std::max(most, n);
  std::pmr::vector<std::uint32_t> order(memory);
  order.reserve(used.size());
  for (std::uint32_t n = most + 1; n-- > 0;)
    for (std::uint32_t v = 0; v < used.size(); ++v)
      if (used[v] == n) order.push_back(v);
  return order;
}

std::uint32_t block_count_of(std::size_t vertices) {
  return static_cast<std::uint32_t>((vertices + linear_block_vertices - 1) / linear_block_vertices);
}

}  // namespace

LinearLayer::LinearLayer(const CharacterModel& model, std::pmr::memory_resource* memory)
    : blocks_(block_count_of(model.vertex_count()), memory),
      open_bias_(blocks_.size() * linear_block_vertices, memory),
      inverse_alpha_sum_(blocks_.size() * linear_block_vertices, memory),
      welded_to_slot_(model.vertex_count(), memory),
      file_to_slot_(model.file_to_welded.size(), memory) {
  const std::pmr::vector<std::uint32_t> used = used_entries(model, memory);
  const std::pmr::vector<std::uint32_t> order = slot_order(used, memory);

  std::uint32_t entries = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    blocks_[b] = {entries, used[order[b * linear_block_vertices]]};
    entries += blocks_[b].entries * linear_block_vertices;
  }
  key_point_ = AlignedArray<std::uint16_t>(entries, memory);
  alpha_ = AlignedArray<float>(entries, memory);

  for (std::uint32_t slot = 0; slot < order.size(); ++slot) {
    const std::size_t vertex = order[slot];
    welded_to_slot_[vertex] = slot;
    std::uint32_t next = blocks_[slot / linear_block_vertices].first_entry + slot % linear_block_vertices;
    float alpha_sum = 0;
    for (std::size_t s = vertex * model.influences; s < (vertex + 1) * model.influences; ++s) {
      if (model.alpha[s] == 0) continue;
      key_point_[next] = model.influence[s];
      alpha_[next] = model.alpha[s];
      alpha_sum += model.alpha[s];
      next += linear_block_vertices;
    }
    open_bias_[slot] = 1 - model.bias[vertex];
    inverse_alpha_sum_[slot] = alpha_sum > 0 ? 1 / alpha_sum : 0;
  }
  for (std::size_t i = 0; i < file_to_slot_.size(); ++i) {
    if (model.file_to_welded[i] >= order.size())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "file vertex %zu is welded vertex %u, which is not one of the model's (need < %zu)", i,
                    static_cast<unsigned>(model.file_to_welded[i]), order.size());
    file_to_slot_[i] = welded_to_slot_[model.file_to_welded[i]];
  }
  view_ = {blocks_.data(),    static_cast<std::uint32_t>(blocks_.size()),
           key_point_.data(), alpha_.data(),
           open_bias_.data(), inverse_alpha_sum_.data()};
}

}  // namespace nook
