#include "sdk/src/character/linear_layer.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace nook {
namespace {

using Indices = Vector<std::uint32_t>;

// Calls body(key_point) for each key point that the vertex uses.
template <class Body>
void for_influences(const CharacterModel& model, std::size_t vertex, Body&& body) {
  for (std::size_t e = vertex * model.influences; e < (vertex + 1) * model.influences; ++e)
    if (model.alpha[e] != 0) body(model.influence[e]);
}

// Sorts welded vertices by their first occurrence in the file. Vertices that do not occur in the file come
// last.
Indices file_order(const CharacterModel& model, Memory* memory) {
  Indices first(model.vertex_count(), ~0u, memory);
  for (std::size_t i = model.file_to_welded.size(); i-- > 0;)
    if (model.file_to_welded[i] < first.size())
      first[model.file_to_welded[i]] = static_cast<std::uint32_t>(i);
  Indices order(first.size(), 0u, memory);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return first[a] < first[b]; });
  return order;
}

// Divides the vertices of a window into blocks. Vertex indices are relative to the window.
class Window {
 public:
  Window(const CharacterModel& model, std::span<const std::uint32_t> vertices, Memory* memory)
      : model_(model),
        vertices_(vertices),
        users_(model.key_points.size(), Indices(memory), memory),
        in_block_(model.key_points.size(), std::uint8_t{0}, memory),
        missing_(vertices.size(), 0u, memory),
        is_taken_(vertices.size(), std::uint8_t{0}, memory),
        is_candidate_(vertices.size(), std::uint8_t{0}, memory),
        block_key_points_(memory),
        candidates_(memory) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
      for_influences(model, vertices[v], [&](std::uint16_t k) {
        users_[k].push_back(v);
        ++missing_[v];
      });
  }

  // Appends the vertices of the next block to `order`. At least one vertex must be left. Returns the block's
  // number of key points.
  std::size_t append_block(std::uint32_t count, Indices& order) {
    while (is_taken_[first_left_]) ++first_left_;
    take(first_left_, order);
    for (std::uint32_t i = 1; i < count; ++i) take(next(), order);
    // Resets `missing_` to its values for an empty block.
    for (const std::uint16_t k : block_key_points_) {
      in_block_[k] = 0;
      for (const std::uint32_t user : users_[k]) ++missing_[user];
    }
    const std::size_t key_points = block_key_points_.size();
    block_key_points_.clear();
    for (const std::uint32_t v : candidates_) is_candidate_[v] = 0;
    candidates_.clear();
    return key_points;
  }

 private:
  std::uint32_t next() {
    std::uint32_t best = ~0u;
    for (const std::uint32_t v : candidates_)
      if (!is_taken_[v] && (best == ~0u || missing_[v] < missing_[best])) best = v;
    if (best != ~0u) return best;
    while (is_taken_[first_left_]) ++first_left_;
    return first_left_;
  }

  void take(std::uint32_t v, Indices& order) {
    is_taken_[v] = 1;
    order.push_back(vertices_[v]);
    for_influences(model_, vertices_[v], [&](std::uint16_t k) {
      if (in_block_[k]) return;
      in_block_[k] = 1;
      block_key_points_.push_back(k);
      for (const std::uint32_t user : users_[k]) {
        --missing_[user];
        if (is_taken_[user] || is_candidate_[user]) continue;
        is_candidate_[user] = 1;
        candidates_.push_back(user);
      }
    });
  }

  const CharacterModel& model_;
  std::span<const std::uint32_t> vertices_;
  Vector<Indices> users_;          // the vertices that use each key point
  Vector<std::uint8_t> in_block_;  // for each key point, 1 if it is in the block
  Indices missing_;                // for each vertex, the number of its key points that are not in the block
  Vector<std::uint8_t> is_taken_, is_candidate_;
  Vector<std::uint16_t> block_key_points_;
  Indices candidates_;  // vertices that share a key point with the block
  std::uint32_t first_left_ = 0;
};

// Appends the blocks of a window, sorted by descending number of key points. Successive loops over the key
// points then often have equal lengths, which helps the processor to predict the end of each loop. A block
// that is not full stays last.
void append_window(Window& window, std::size_t vertices, std::uint32_t block_vertices, Memory* memory,
                   Indices& order) {
  struct Block {
    std::size_t key_points, begin;
  };
  Indices blocks(memory);
  Vector<Block> sizes(memory);
  while (vertices - blocks.size() >= block_vertices) {
    const std::size_t begin = blocks.size();
    sizes.push_back({window.append_block(block_vertices, blocks), begin});
  }
  std::stable_sort(sizes.begin(), sizes.end(),
                   [](const Block& a, const Block& b) { return a.key_points > b.key_points; });
  for (const Block& block : sizes)
    for (std::size_t i = 0; i < block_vertices; ++i) order.push_back(blocks[block.begin + i]);
  if (blocks.size() < vertices)
    window.append_block(static_cast<std::uint32_t>(vertices - blocks.size()), order);
}

}  // namespace

Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory) {
  const Indices in_file = file_order(model, memory);
  Indices order(memory);
  order.reserve(in_file.size());
  for (std::size_t begin = 0; begin < in_file.size(); begin += linear_window_vertices) {
    const std::size_t count = std::min<std::size_t>(linear_window_vertices, in_file.size() - begin);
    Window window(model, std::span(in_file).subspan(begin, count), memory);
    append_window(window, count, block_vertices, memory, order);
  }
  return order;
}

}  // namespace nook
