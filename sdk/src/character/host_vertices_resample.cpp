#include "sdk/src/character/host_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sdk/src/core/affine.h"

namespace nook {
namespace {

// If the cosine between two normals is below this, they belong to different sides of the body.
constexpr float min_facing = 0.2f;
constexpr float facing_power = 8;
constexpr std::size_t interpolated_vertices = 3;
// Points are treated as the same place if their distance is less than this fraction of the rest pose's
// diameter. The tolerance covers the rounding of 16-bit positions.
constexpr float same_place = 1e-4f;

// A position with a normal. If there are no normals, all points get the same one.
struct Oriented {
  Vec3 position;
  Vec3 normal;
};

// Points sorted by x, so that all points near a place are in a short range of the list.
class SortedPoints {
 public:
  struct Near {
    std::uint32_t index = 0;
    float distance = INFINITY;
  };

  SortedPoints(std::span<const Oriented> points, Memory* memory) : points_(points), order_(memory) {
    for (std::uint32_t i = 0; i < points.size(); ++i) order_.push_back(i);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points_[a].position.x < points_[b].position.x;
    });
  }

  // Returns the nearest points that face the same way, the nearest first. If there are fewer than `count`,
  // the remaining distances stay infinite.
  template <std::size_t count>
  std::array<Near, count> nearest(const Oriented& at) const {
    std::array<Near, count> found;
    const auto start = first_from(at.position.x);
    auto up = start, down = start;
    while (up != order_.end() || down != order_.begin()) {
      const float reach = found.back().distance;
      const float above = up != order_.end() ? points_[*up].position.x - at.position.x : INFINITY;
      const float below =
          down != order_.begin() ? at.position.x - points_[*std::prev(down)].position.x : INFINITY;
      if (std::min(above, below) > reach) break;
      const std::uint32_t index = above <= below ? *up++ : *--down;
      if (dot(points_[index].normal, at.normal) < min_facing) continue;
      const Near here{index, length(points_[index].position - at.position)};
      if (here.distance >= reach) continue;
      found.back() = here;
      for (std::size_t i = count - 1; i > 0 && found[i].distance < found[i - 1].distance; --i)
        std::swap(found[i], found[i - 1]);
    }
    return found;
  }

 private:
  Vector<std::uint32_t>::const_iterator first_from(float x) const {
    return std::lower_bound(order_.begin(), order_.end(), x,
                            [&](std::uint32_t i, float value) { return points_[i].position.x < value; });
  }

  std::span<const Oriented> points_;
  Vector<std::uint32_t> order_;
};

Vector<Oriented> host_points(const HostVertices& host, Memory* memory) {
  Vector<Oriented> points(memory);
  points.reserve(host.count);
  for (std::uint32_t i = 0; i < host.count; ++i)
    points.push_back({host.position[i], host.normal.first ? normalised(host.normal[i]) : Vec3{0, 1, 0}});
  return points;
}

Vector<Oriented> baked_points(const Candidates& candidates, bool has_normals, Memory* memory) {
  Vector<Oriented> points(memory);
  points.reserve(candidates.size());
  for (const Candidate& c : candidates)
    points.push_back({c.position, has_normals ? c.normal : Vec3{0, 1, 0}});
  return points;
}

struct Share {
  std::uint32_t candidate = 0;
  float weight = 0;
};

// Weights the nearest candidates by the inverse square of their distance. The weights sum to 1. If the point
// is at the place of a baked vertex, this vertex gets nearly all of the weight; only a millionth is left for
// the others. Where parts of a body meet, vertices at the same place face different ways. To choose between
// them, the weights are also multiplied by a high power of the cosine between the normals.
Vector<Share> shares_of(const Oriented& at, const SortedPoints& baked, std::span<const Oriented> points,
                        Memory* memory) {
  Vector<Share> shares(memory);
  const auto near = baked.nearest<interpolated_vertices>(at);
  float farthest = 0, sum = 0;
  for (const auto& n : near)
    if (std::isfinite(n.distance)) farthest = std::max(farthest, n.distance);
  for (const auto& n : near) {
    if (!std::isfinite(n.distance)) continue;
    const float relative = farthest > 0 ? n.distance / farthest : 0;
    const float facing = std::pow(dot(points[n.index].normal, at.normal), facing_power);
    const float weight = facing / (relative * relative + 1e-6f);
    shares.push_back({n.index, weight});
    sum += weight;
  }
  for (Share& share : shares) share.weight /= sum;
  return shares;
}

// The weights of a key point for one vertex of the new mesh. They are summed over the baked vertices that the
// new vertex interpolates.
struct Influence {
  std::uint16_t key_point = 0;
  float alpha = 0, blend = 0;
};

class LayerMean {
 public:
  LayerMean(const CharacterModel& model, Memory* memory) : model_(model), sum_(memory) {}

  void add(std::uint32_t welded, float weight) {
    bias_ += weight * model_.bias[welded];
    if (!model_.static_ao.empty()) static_ao_ += weight * model_.static_ao[welded];
    if (!model_.occluded.empty()) {
      occluded_.dark += weight * model_.occluded[welded].dark;
      occluded_.open += weight * model_.occluded[welded].open;
    }
    const std::size_t first = std::size_t(welded) * model_.influences;
    for (std::size_t s = first; s < first + model_.influences; ++s)
      if (model_.alpha[s] > 0) {
        Influence& sum = of(model_.influence[s]);
        sum.alpha += weight * model_.alpha[s];
        sum.blend += weight * model_.blend[s];
      }
  }

  void append_to(CharacterModel& out) {
    std::stable_sort(sum_.begin(), sum_.end(),
                     [](const Influence& a, const Influence& b) { return a.alpha > b.alpha; });
    float alpha_all = 0, alpha_kept = 0, blend_kept = 0;
    const std::size_t kept = std::min<std::size_t>(sum_.size(), out.influences);
    for (const Influence& i : sum_) alpha_all += i.alpha;
    for (std::size_t i = 0; i < kept; ++i) {
      alpha_kept += sum_[i].alpha;
      blend_kept += sum_[i].blend;
    }
    // Blend weights may be negative, so the sum of the kept blend weights can be close to zero.
    const bool blend_is_sound = blend_kept > 0.25f;
    for (std::size_t i = 0; i < out.influences; ++i) {
      const Influence entry = i < kept ? sum_[i] : Influence{};
      out.influence.push_back(entry.key_point);
      out.alpha.push_back(entry.alpha * alpha_all / alpha_kept);
      out.blend.push_back(blend_is_sound ? entry.blend / blend_kept : entry.alpha / alpha_kept);
    }
    out.bias.push_back(bias_);
    if (!model_.static_ao.empty()) out.static_ao.push_back(static_ao_);
    if (!model_.occluded.empty()) out.occluded.push_back(occluded_);
  }

 private:
  Influence& of(std::uint16_t key_point) {
    for (Influence& i : sum_)
      if (i.key_point == key_point) return i;
    return sum_.emplace_back(Influence{key_point, 0, 0});
  }

  const CharacterModel& model_;
  Vector<Influence> sum_;
  float bias_ = 0, static_ao_ = 0;
  OccludedEnds occluded_;
};

// Returns the host's vertex and its normal in rest space.
Oriented in_rest_space(const Oriented& at, const CharacterModel& model, std::uint32_t file_vertex,
                       const HostVertices& host, const Vec3& baked_normal) {
  Oriented rest = at;
  const Mat3x4& matrix = model.bind.rest_from_mesh[space_of(model, file_vertex)];
  if (!host.in_rest_space) rest.position = transform(to_double(matrix), at.position);
  // To transform the mesh's own normals, we would need the inverse transpose of the matrix. Instead, we use
  // the normal of the nearest baked vertex, which is already in rest space.
  if (!host.in_rest_space || !host.normal.first) rest.normal = baked_normal;
  return rest;
}

// The pose check uses BindData::vertices. Keeps those for which the new mesh has a vertex at the same place.
void keep_rest_vertices(const CharacterModel& model, CharacterModel& out, Memory* memory) {
  Vector<Oriented> points(memory);
  for (std::size_t i = 0; i < out.rest.position.size(); ++i)
    points.push_back({out.rest.position[i], out.rest.normal[i]});
  const SortedPoints sorted(points, memory);
  const float tolerance = same_place * 2 * model.bounding_radius;  // metres
  out.bind.vertices.clear();
  for (RestVertex vertex : model.bind.vertices) {
    const Vec3 normal = model.rest.normal[model.file_to_welded[vertex.file_vertex]];
    const auto nearest = sorted.nearest<1>({vertex.position, normal})[0];
    if (!(nearest.distance <= tolerance)) continue;
    vertex.file_vertex = nearest.index;
    out.bind.vertices.push_back(vertex);
  }
}

}  // namespace

FarVertex farthest_vertex(const CharacterModel& model, const HostVertices& host, Memory* memory) {
  const Candidates candidates = candidates_of(model, host, memory);
  const Vector<Oriented> baked = baked_points(candidates, host.normal.first != nullptr, memory);
  const Vector<Oriented> vertices = host_points(host, memory);
  const SortedPoints sorted(baked, memory);
  FarVertex farthest;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const float distance = sorted.nearest<1>(vertices[i])[0].distance;
    if (distance > farthest.distance) farthest = {i, distance};
  }
  return farthest;
}

CharacterModel resampled(const CharacterModel& model, const HostVertices& host, Memory* memory) {
  const Candidates candidates = candidates_of(model, host, memory);
  const Vector<Oriented> baked = baked_points(candidates, host.normal.first != nullptr, memory);
  const Vector<Oriented> vertices = host_points(host, memory);
  const SortedPoints sorted(baked, memory);

  CharacterModel out(memory);
  out = model;
  out.influences = CharacterModel::max_influences;
  out.influence.clear();
  out.alpha.clear();
  out.blend.clear();
  out.bias.clear();
  out.static_ao.clear();
  out.occluded.clear();
  out.file_to_welded.clear();
  out.rest.position.clear();
  out.rest.normal.clear();
  out.bind.close.clear();
  Vector<std::uint32_t> nearest_file_vertex(memory);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    LayerMean mean(model, memory);
    for (const Share& share : shares_of(vertices[i], sorted, baked, memory))
      mean.add(model.file_to_welded[candidates[share.candidate].file_vertex], share.weight);
    mean.append_to(out);
    const std::uint32_t nearest = candidates[sorted.nearest<1>(vertices[i])[0].index].file_vertex;
    const Vec3 normal = model.rest.normal[model.file_to_welded[nearest]];
    const Oriented rest = in_rest_space(vertices[i], model, nearest, host, normal);
    out.rest.position.push_back(rest.position);
    out.rest.normal.push_back(rest.normal);
    out.file_to_welded.push_back(i);
    nearest_file_vertex.push_back(nearest);
  }
  set_primitives(model, nearest_file_vertex, out);
  keep_rest_vertices(model, out, memory);
  return out;
}

}  // namespace nook
