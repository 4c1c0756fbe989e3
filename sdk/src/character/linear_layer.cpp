#include "sdk/src/character/linear_layer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sdk/src/core/failure.h"

namespace nook {
namespace {

void check_influences(const CharacterModel& model) {
  const std::size_t entries = model.vertex_count() * model.influences;
  if (model.alpha.size() != entries || model.blend.size() != entries || model.influence.size() != entries)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the linear layer has %zu indices, %zu alphas and %zu blend weights (need %zu of each)",
                  model.influence.size(), model.alpha.size(), model.blend.size(), entries);
  for (std::size_t e = 0; e < entries; ++e)
    if (model.alpha[e] != 0 && model.influence[e] >= model.key_points.size())
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "vertex %zu is shaded by key point %u, which the model does not have (need less than %zu)",
          e / model.influences, static_cast<unsigned>(model.influence[e]), model.key_points.size());
}

std::uint32_t block_count_of(std::size_t vertices) {
  return static_cast<std::uint32_t>((vertices + linear_block_vertices - 1) / linear_block_vertices);
}

// The columns of all blocks, one block after another. A block has a column for each key point that its
// vertices use, in ascending order. If the number of columns is odd, the last one is repeated.
struct Columns {
  Vector<std::uint16_t> key_point;
  Vector<std::uint32_t> first;  // first column of each block, then the number of columns

  Columns(const CharacterModel& model, const Vector<std::uint32_t>& order, Memory* memory)
      : key_point(memory), first(memory) {
    first.push_back(0);
    for (std::size_t begin = 0; begin < order.size(); begin += linear_block_vertices) {
      const std::size_t end = std::min<std::size_t>(begin + linear_block_vertices, order.size());
      for (std::size_t slot = begin; slot < end; ++slot)
        for (std::size_t e = std::size_t{order[slot]} * model.influences;
             e < (order[slot] + 1ull) * model.influences; ++e)
          if (model.alpha[e] != 0) key_point.push_back(model.influence[e]);
      const auto own = key_point.begin() + first.back();
      std::sort(own, key_point.end());
      key_point.erase(std::unique(own, key_point.end()), key_point.end());
      if (key_point.size() % 2) key_point.push_back(key_point.back());
      first.push_back(static_cast<std::uint32_t>(key_point.size()));
    }
  }

  std::size_t find(std::size_t block, std::uint16_t k) const {
    const auto begin = key_point.begin();
    return static_cast<std::size_t>(std::lower_bound(begin + first[block], begin + first[block + 1], k) -
                                    begin);
  }
  // Returns the index of the weight of a slot in a column of its block.
  std::size_t place(std::size_t column, std::size_t slot) const {
    return column / 2 * linear_pair_weights + slot % linear_block_vertices * 2 + column % 2;
  }
};

float largest_of(const Vector<float>& weights) {
  float largest = 0;
  for (const float weight : weights) largest = std::max(largest, std::abs(weight));
  return largest;
}

// Alphas in a file are max_alpha * (c / 127)^2 with an integer c, so they are integer multiples of this step.
float alpha_step_of(const Vector<float>& alpha) {
  const float largest = largest_of(alpha);
  return largest > 0 ? largest / (2 * 127 * 127) : 1;
}

// Returns the step of the stored blend weights. It is a power of two, so the blend weights of a file, which
// are multiples of 1/16, are also integer multiples of the step.
float blend_step_of(const Vector<float>& blend) {
  return std::exp2(std::ceil(std::log2(std::max(largest_of(blend), 1.0f)))) / 16384;
}

AlignedArray<std::int16_t> in_steps(const Vector<float>& weights, float step, Memory* memory) {
  AlignedArray<std::int16_t> out(weights.size(), memory);
  for (std::size_t i = 0; i < weights.size(); ++i)
    out[i] = static_cast<std::int16_t>(std::lround(weights[i] / step));
  return out;
}

// Returns the largest sum of absolute weights that any vertex has, in steps.
double largest_sum(const AlignedArray<LinearBlock>& blocks, const AlignedArray<std::int16_t>& weights) {
  double largest = 1;
  for (const LinearBlock& block : blocks)
    for (std::size_t v = 0; v < linear_pair_weights; v += 2) {
      double sum = 0;
      for (std::size_t pair = block.first_pair; pair < block.first_pair + block.pairs; ++pair)
        for (std::size_t c = v; c < v + 2; ++c) sum += std::abs(weights[pair * linear_pair_weights + c]);
      largest = std::max(largest, sum);
    }
  return largest;
}

float code_limit(const AlignedArray<LinearBlock>& blocks, const AlignedArray<std::int16_t>& weights) {
  constexpr double largest_word = 2147483647;
  return static_cast<float>(
      std::min(std::floor(largest_word / largest_sum(blocks, weights)), double(max_code_limit)));
}

}  // namespace

LinearLayer::LinearLayer(const CharacterModel& model, Memory* memory)
    : blocks_(block_count_of(model.vertex_count()), memory),
      open_bias_(blocks_.size() * linear_block_vertices, memory),
      file_to_slot_(model.file_to_welded.size(), memory) {
  check_influences(model);
  const Vector<std::uint32_t> order = linear_layer_order(model, linear_block_vertices, memory);
  const Columns columns(model, order, memory);

  for (std::size_t b = 0; b < blocks_.size(); ++b)
    blocks_[b] = {columns.first[b] / 2, (columns.first[b + 1] - columns.first[b]) / 2};
  key_points_ = AlignedArray<std::uint32_t>(columns.key_point.size() / 2, memory);
  for (std::size_t pair = 0; pair < key_points_.size(); ++pair)
    key_points_[pair] =
        columns.key_point[2 * pair] | static_cast<std::uint32_t>(columns.key_point[2 * pair + 1]) << 16;
  Vector<float> alpha(columns.key_point.size() * linear_block_vertices, 0.0f, memory);
  Vector<float> blend(alpha.size(), 0.0f, memory);

  AlignedArray<std::uint32_t> welded_to_slot(model.vertex_count(), memory);
  for (std::uint32_t slot = 0; slot < order.size(); ++slot) {
    const std::size_t vertex = order[slot];
    welded_to_slot[vertex] = slot;
    float gain = 0;
    for (std::size_t e = vertex * model.influences; e < (vertex + 1) * model.influences; ++e) {
      if (model.alpha[e] == 0) continue;
      const std::size_t column = columns.find(slot / linear_block_vertices, model.influence[e]);
      const std::size_t place = columns.place(column, slot);
      alpha[place] += model.alpha[e];
      blend[place] += model.blend[e];
      gain += std::abs(model.blend[e]);
    }
    open_bias_[slot] = 1 - model.bias[vertex];
    max_blend_gain_ = std::max(max_blend_gain_, gain);
  }
  for (std::size_t i = 0; i < file_to_slot_.size(); ++i) {
    if (model.file_to_welded[i] >= order.size())
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "file vertex %zu refers to welded vertex %u, which the model does not have (need less than %zu)", i,
          static_cast<unsigned>(model.file_to_welded[i]), order.size());
    file_to_slot_[i] = welded_to_slot[model.file_to_welded[i]];
  }
  const float alpha_step = alpha_step_of(alpha), blend_step = blend_step_of(blend);
  alpha_ = in_steps(alpha, alpha_step, memory);
  blend_ = in_steps(blend, blend_step, memory);
  view_ = {blocks_.data(),
           static_cast<std::uint32_t>(blocks_.size()),
           key_points_.data(),
           alpha_.data(),
           blend_.data(),
           alpha_step,
           blend_step,
           open_bias_.data(),
           code_limit(blocks_, alpha_),
           code_limit(blocks_, blend_)};
}

}  // namespace nook
