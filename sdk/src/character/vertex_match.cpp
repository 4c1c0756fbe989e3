#include "sdk/src/character/vertex_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/character/place_tree.h"

namespace nook {
namespace {

// For each candidate, we compute the cosine between its normal and the host's normal. If the cosine is at
// least this much below the best candidate's cosine, the candidate belongs to another side of the surface.
// Smaller differences are ignored, because hosts smooth normals, and bend them on cards and leaves.
constexpr float other_side = 0.7f;

// A host normal within 5 degrees of the model's normal is treated as the same normal. This covers the
// quantisation of the model's normals (2 degrees) and of 8-bit normals of the host. A normal that is 10
// degrees away is treated as different.
constexpr float fitting_cosine = 0.9962f, unfitting_cosine = 0.9848f;

// Limit for the sum of absolute differences between two sets of weights. It covers an error of half an 8-bit
// step in each of 8 weights. If no candidate is within this limit, the host's weights belong to another skin.
constexpr float fitting_weights = 0.1f;
// A smaller limit, which covers only the quantisation of the weights in the model file.
constexpr float weight_steps = 2e-4f;

// If the AO of two vertices differs by less than this in every pose, it is treated as equal. The limit covers
// half an 8-bit step and the error of a bake.
constexpr float equal_ao = 0.01f;

constexpr float unknown_weights = -1;

// A candidate for one vertex of the host.
struct Fit {
  const Candidate* candidate = nullptr;
  float distance = 0;               // host's unit
  float facing = 1;                 // the cosine between the normals; 1 if there are no normals
  float side = 1;                   // the cosine between the candidate's normal and the normal of the host's
                                    // triangles; equals `facing` if the host passed no triangles
  float weights = unknown_weights;  // the sum of absolute differences to the host's weights
};
using Fits = Vector<Fit>;

// Returns the alpha of a key point at a welded vertex.
float alpha_of(const CharacterModel& model, std::uint32_t welded, std::uint16_t key_point) {
  const std::size_t first = std::size_t{welded} * model.influences;
  float sum = 0;
  for (std::size_t s = first; s < first + model.influences; ++s)
    if (model.influence[s] == key_point) sum += model.alpha[s];
  return sum;
}

// Returns the largest amount by which vertex `a` can be darker than vertex `b`, if the shadow of each key
// point is between 0 and 1.
float darker_by(const CharacterModel& model, std::uint32_t a, std::uint32_t b) {
  const std::size_t first = std::size_t{a} * model.influences;
  float sum = model.bias[a] - model.bias[b];
  for (std::size_t s = first; s < first + model.influences; ++s)
    if (model.alpha[s] > 0) sum += std::max(0.0f, model.alpha[s] - alpha_of(model, b, model.influence[s]));
  return sum;
}

// Returns an upper bound for the difference of the body's own AO at two vertices, over all poses.
float ao_difference(const CharacterModel& model, std::uint32_t a, std::uint32_t b) {
  const float rest = model.static_ao.empty() ? 0 : std::abs(model.static_ao[a] - model.static_ao[b]);
  return std::max({rest, darker_by(model, a, b), darker_by(model, b, a)});
}

// Returns the first fit whose AO differs from the AO of `taken`, or null.
const Fit* other_ao(const CharacterModel& model, const Fits& fits, const Fit& taken) {
  for (const Fit& fit : fits)
    if (fit.candidate->welded != taken.candidate->welded &&
        ao_difference(model, fit.candidate->welded, taken.candidate->welded) > equal_ao)
      return &fit;
  return nullptr;
}

// Returns the bones of a host vertex, with weights that sum to 1. If no weight is positive, the vertex
// follows its first joint. The import of the file does the same.
BoneWeights bones_of(const HostWeights& host, std::size_t vertex) {
  BoneWeights out;
  double sum = 0;
  for (std::uint32_t k = 0; k < host.influences; ++k) sum += double(host.weight_at(vertex, k));
  for (std::uint32_t k = 0; k < host.influences; ++k) {
    const double share = sum > 0 ? double(host.weight_at(vertex, k)) / sum : k == 0 ? 1.0 : 0.0;
    const auto weight = static_cast<float>(share);
    if (!(weight > 0)) continue;
    const std::uint16_t joint = host.joint_at(vertex, k);
    out.bone[out.count] = host.bone_of_joint.empty() ? joint : host.bone_of_joint[joint];
    out.weight[out.count++] = weight;
  }
  return out;
}

// Returns the weight of a bone. If the bone occurs several times, returns the sum.
float weight_of(const BoneWeights& weights, std::uint16_t bone) {
  float sum = 0;
  for (std::uint32_t b = 0; b < weights.count; ++b)
    if (weights.bone[b] == bone) sum += weights.weight[b];
  return sum;
}

// Returns the sum of absolute differences over all bones. Both sets of weights sum to 1. So the result is
// twice the sum over the bones that have more weight in `a` than in `b`.
float weight_difference(const BoneWeights& a, const BoneWeights& b) {
  float more = 0;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    const bool is_again = std::find(a.bone.begin(), a.bone.begin() + i, a.bone[i]) != a.bone.begin() + i;
    if (!is_again) more += std::max(0.0f, weight_of(a, a.bone[i]) - weight_of(b, a.bone[i]));
  }
  return 2 * more;
}

template <class Predicate>
void drop(Fits& fits, Predicate predicate) {
  fits.erase(std::remove_if(fits.begin(), fits.end(), predicate), fits.end());
}

void drop_other_sides(Fits& fits, bool has_face, const Fit* but) {
  const Candidate* const kept = but ? but->candidate : nullptr;
  float best = -1;
  for (const Fit& fit : fits) best = std::max(best, fit.side);
  // If even the best candidate faces another side than the triangles of the vertex, the sides do not help to
  // choose and are ignored.
  if (has_face && best < other_side) return;
  drop(fits, [&](const Fit& fit) { return fit.side < best - other_side && fit.candidate != kept; });
}

// Sets Fit::weights for all candidates whose weights are known.
void set_weights(Fits& fits, const BoneWeights& bones) {
  for (Fit& fit : fits)
    if (fit.candidate->weights) fit.weights = weight_difference(bones, *fit.candidate->weights);
}

// If the weights of at least one candidate fit within `limit`, drops the candidates with other weights. If
// none fits, drops nothing: the host may store its weights with fewer bits, so that they differ from all
// candidates.
void drop_other_weights(Fits& fits, float limit) {
  float best = INFINITY;
  for (const Fit& fit : fits)
    if (fit.weights != unknown_weights) best = std::min(best, fit.weights);
  if (best <= limit) drop(fits, [&](const Fit& fit) { return fit.weights > 2 * best + weight_steps; });
}

// Returns the candidate that fits the normal if it is the only one; otherwise null.
const Fit* only_facing(const Fits& fits) {
  const Fit* found = nullptr;
  for (const Fit& fit : fits) {
    if (fit.facing < unfitting_cosine) continue;
    if (found || fit.facing < fitting_cosine) return nullptr;
    found = &fit;
  }
  return found;
}

// Returns the candidate whose normal is closest to the host's normal. If several are equal, returns the one
// at the smallest distance.
const Fit& best_fit(const Fits& fits) {
  return *std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    if (a.facing != b.facing) return a.facing > b.facing;
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.candidate->file_vertex < b.candidate->file_vertex;
  });
}

// Predicts the next match from the order of the host's vertices. Most meshes keep long runs of the file's
// order.
struct Order {
  std::uint32_t successor = no_vertex;  // the file vertex after the previous match
  std::uint32_t number = no_vertex;     // the file vertex with the same index as the host vertex
  bool is_sure = false;                 // the previous match was unambiguous
  std::uint32_t run = 0;                // how many previous matches in a row were the successor

  // In some files, the normals on a card point to the wrong side. If the host has kept the file's order for
  // several vertices, the order is more reliable than a normal.
  bool is_kept() const { return run >= 4; }
};

class Matcher {
 public:
  Matcher(const CharacterModel& model, const HostVertices& host, Memory* memory)
      : model_(model),
        host_(host),
        candidates_(candidates_of(model, host, memory)),
        places_(places_of(candidates_, memory)),
        tree_(places_, memory),
        nearest_(memory),
        found_(memory),
        fits_(memory) {}

  VertexMatches match(std::span<std::uint32_t> file_vertices, Memory* memory);

 private:
  static Vector<Vec3> places_of(const Candidates& candidates, Memory* memory) {
    Vector<Vec3> places(memory);
    places.reserve(candidates.size());
    for (const Candidate& candidate : candidates) places.push_back(candidate.position);
    return places;
  }

  float slack_of_places(Memory* memory) const;
  void gather(std::uint32_t vertex, float reach, const Order& order);
  // A fit can stand for several file vertices. Returns the one that continues the host's order, or the first
  // one if none does.
  std::uint32_t file_vertex(const Fit& fit, const Order& order) const;
  bool is_vertex_of(const Fit& fit, std::uint32_t file_vertex) const;
  const Fit* fit_of(std::uint32_t file_vertex) const;
  const Fit* decide(const Order& order) const;

  const CharacterModel& model_;
  const HostVertices& host_;
  Candidates candidates_;
  Vector<Vec3> places_;
  PlaceTree tree_;
  Vector<float> nearest_;  // distance of each host vertex to the nearest candidate
  Vector<std::uint32_t> found_;
  Fits fits_;  // the fits of the current vertex
};

// Returns by how much the distance of the right candidate may exceed the smallest distance. If the host's
// positions are exact, this only covers rounding. If the host stores positions with fewer bits, this covers
// the steps of the host's and of the model's positions.
float Matcher::slack_of_places(Memory* memory) const {
  constexpr float model_steps = 65535, exact_share = 0.9f, rounding = 5e-7f;
  float farthest = 0;
  for (const Vec3 p : places_) farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  // Meshes in different spaces may have the same coordinates, for example the same object in the left and in
  // the right hand. Their stored positions are rounded differently.
  const bool has_spaces =
      std::any_of(candidates_.begin(), candidates_.end(),
                  [&](const Candidate& candidate) { return candidate.space != candidates_.front().space; });
  Vector<float> matched(memory);
  for (const float distance : nearest_)
    if (distance < INFINITY) matched.push_back(distance);
  if (matched.empty()) return 0;
  const float half_step = diagonal_of(model_, host_) / model_steps / 2 + rounding * farthest;
  const auto exact = std::count_if(matched.begin(), matched.end(), [&](float d) { return d <= half_step; });
  if (static_cast<float>(exact) >= exact_share * static_cast<float>(matched.size()))
    return has_spaces ? 2 * half_step : rounding * farthest;
  const auto middle = matched.begin() + static_cast<std::ptrdiff_t>(matched.size() / 2);
  std::nth_element(matched.begin(), middle, matched.end());
  return 2 * *middle;
}

void Matcher::gather(std::uint32_t vertex, float reach, const Order& order) {
  const Vec3 position = host_.position[vertex];
  const Vec3 normal = host_.normal.first ? normalised(host_.normal[vertex]) : Vec3{};
  const bool has_normal = dot(normal, normal) > 0;
  // Compares the normals of the triangles, because smooth normals may be equal on both faces of a sharp fold.
  // The model's normals come from triangles, too.
  const Vec3 face = host_.face_normal.first ? host_.face_normal[vertex] : Vec3{};
  const bool has_face = dot(face, face) > 0;
  found_.clear();
  fits_.clear();
  tree_.find_within(position, reach, found_);
  for (const std::uint32_t index : found_) {
    const Candidate& candidate = candidates_[index];
    Fit fit{&candidate, length(candidate.position - position)};
    if (has_normal) fit.facing = fit.side = dot(candidate.normal, normal);
    if (has_face) fit.side = dot(candidate.normal, face);
    fits_.push_back(fit);
  }
  const bool has_weights = fits_.size() > 1 && host_.weights.joint;
  if (has_weights) {
    set_weights(fits_, bones_of(host_.weights, vertex));
    // If the host's weights are equal to the file's weights, they are more reliable than the side, because
    // some files have normals that point the wrong way.
    drop_other_weights(fits_, weight_steps);
  }
  if (fits_.size() > 1 && (has_normal || has_face))
    drop_other_sides(fits_, has_face, order.is_kept() ? fit_of(order.successor) : nullptr);
  if (has_weights && fits_.size() > 1) drop_other_weights(fits_, fitting_weights);
}

bool Matcher::is_vertex_of(const Fit& fit, std::uint32_t file_vertex) const {
  if (file_vertex >= model_.file_to_welded.size()) return false;
  if (model_.file_to_welded[file_vertex] != fit.candidate->welded) return false;
  if (space_of(model_, file_vertex) != fit.candidate->space) return false;
  if (host_.primitive < 0) return true;
  const PrimitiveRange& range = model_.primitives[static_cast<std::size_t>(host_.primitive)];
  return file_vertex - range.first_vertex < range.vertex_count;
}

const Fit* Matcher::fit_of(std::uint32_t file_vertex) const {
  for (const Fit& fit : fits_)
    if (is_vertex_of(fit, file_vertex)) return &fit;
  return nullptr;
}

std::uint32_t Matcher::file_vertex(const Fit& fit, const Order& order) const {
  for (const std::uint32_t vertex : {order.successor, order.number})
    if (is_vertex_of(fit, vertex)) return vertex;
  return fit.candidate->file_vertex;
}

// Chooses between the remaining candidates. Returns null if no criterion decides. If the previous match was
// unambiguous, the file vertex after it is preferred to the file vertex with the host vertex's index.
const Fit* Matcher::decide(const Order& order) const {
  const Fit* const successor = order.is_sure ? fit_of(order.successor) : nullptr;
  if (successor && order.is_kept()) return successor;
  if (const Fit* facing = only_facing(fits_)) return facing;
  return successor ? successor : fit_of(order.number);
}

VertexMatches Matcher::match(std::span<std::uint32_t> file_vertices, Memory* memory) {
  const float tolerance = tolerance_of(model_, host_);
  nearest_.reserve(host_.count);
  for (std::uint32_t i = 0; i < host_.count; ++i)
    nearest_.push_back(tree_.nearest(host_.position[i], tolerance));
  const float slack = slack_of_places(memory);
  const std::uint32_t first =
      host_.primitive < 0 ? 0 : model_.primitives[static_cast<std::size_t>(host_.primitive)].first_vertex;
  VertexMatches out;
  Order order;
  for (std::uint32_t i = 0; i < host_.count; ++i) {
    if (!(nearest_[i] <= tolerance)) {
      file_vertices[i] = no_vertex;
      if (out.unmatched++ == 0) out.first_unmatched = i;
      continue;
    }
    // If the position of a candidate is bit-exactly the host's position, all candidates at other positions
    // are excluded.
    gather(i, nearest_[i] == 0 ? 0 : nearest_[i] + slack, order);
    order.number = first + i;
    const Fit* decided = fits_.size() == 1 ? &fits_[0] : decide(order);
    const Fit* taken = decided ? decided : fit_of(order.successor);
    if (!taken) taken = &best_fit(fits_);
    file_vertices[i] = file_vertex(*taken, order);
    const Fit* const other = decided ? nullptr : other_ao(model_, fits_, *taken);
    if (other && out.ambiguous++ == 0) {
      out.first_ambiguous = i;
      out.taken = file_vertices[i];
      out.other = other->candidate->file_vertex;
    }
    order.is_sure = !other;
    order.run = file_vertices[i] == order.successor ? order.run + 1 : 0;
    order.successor = file_vertices[i] + 1;
  }
  return out;
}

}  // namespace

VertexMatches match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory) {
  return Matcher(model, host, memory).match(file_vertices, memory);
}

}  // namespace nook
