#include "bakers/import/coincident_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "bakers/import/shown_nodes.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t all_samples = std::size_t{1} << 16, most_of_part = 512, fewest_of_part = 16;
constexpr std::size_t most_parts = std::size_t{1} << 16;
// Limits the time for files whose triangles all lie on each other. The contacts found up to the limit are
// sufficient.
constexpr std::size_t most_candidates = 256, most_tests = std::size_t{1} << 26;
constexpr float reach_of_size = 0.02f;  // relative to the diagonal of a part
constexpr float least_cosine = 0.7f;    // limit for the orientations `along` and `facing`
constexpr float same_plane = 0.01f;     // relative to the reach

struct Box {
  Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool overlaps(const Box& o) const {
    return low.x <= o.high.x && low.y <= o.high.y && low.z <= o.high.z && o.low.x <= high.x &&
           o.low.y <= high.y && o.low.z <= high.z;
  }
};

// How another part is oriented at the point where the line along a sample's normal crosses it.
enum class Lie : std::uint8_t {
  along,   // faces the same way
  facing,  // in front of the sample, with its front towards it
  behind   // behind the sample or at the same place, and faces the other way, like the other side of a sheet
};

// The point nearest to a sample where its normal crosses another part.
struct Hit {
  std::uint32_t part = 0;
  float height = 0;  // along the sample's normal, in units of its reach
  Lie lie = Lie::along;
};

struct Sample {
  Vec3 at, normal;
  float reach = 0;
  double area = 0;  // area that the sample represents
  std::uint32_t part = 0;
  std::vector<Hit> hits;  // for each other part, the nearest hit of each orientation
};

constexpr std::size_t most_hits = 16;

// A bounding-box tree over samples. It sorts the samples by leaf.
class SampleTree {
 public:
  explicit SampleTree(std::vector<Sample>& samples) : samples_(samples) {
    if (!samples.empty()) build(0, samples.size());
  }

  template <class Visit>
  void visit(const Box& box, Visit visit) {
    stack_.assign(1, 0);
    while (!stack_.empty() && !nodes_.empty()) {
      const Node& node = nodes_[stack_.back()];
      stack_.pop_back();
      if (!node.box.overlaps(box)) continue;
      if (node.right == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i) visit(samples_[i]);
      } else {
        stack_.push_back(node.right);
        stack_.push_back(std::size_t(&node - nodes_.data()) + 1);
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::size_t begin = 0, end = 0, right = 0;  // right: 0 for a leaf; the left child follows its parent
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    Box box, centres;
    for (std::size_t i = begin; i < end; ++i) {
      const Sample& s = samples_[i];
      box.add(s.at + s.normal * s.reach);
      box.add(s.at - s.normal * s.reach);
      centres.add(s.at);
    }
    std::size_t right = 0;
    if (end - begin > 4) {
      const Vec3 size = centres.high - centres.low;
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      const auto along = [axis](const Sample& s) { return axis == 0 ? s.at.x : axis == 1 ? s.at.y : s.at.z; };
      const std::size_t middle = (begin + end) / 2;
      std::nth_element(samples_.begin() + long(begin), samples_.begin() + long(middle),
                       samples_.begin() + long(end),
                       [&](const Sample& a, const Sample& b) { return along(a) < along(b); });
      build(begin, middle);
      right = build(middle, end);
    }
    nodes_[at] = {box, begin, end, right};
    return at;
  }

  std::vector<Sample>& samples_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> stack_;
};

struct Mesh {
  const SurfaceParts& parts;
  std::span<const Vec3> position;
  std::span<const Triangle> triangle;

  std::size_t begin(std::size_t part) const { return part == 0 ? 0 : parts.all[part - 1].end_triangle; }
  Vec3 corner(std::size_t t, std::size_t c) const { return position[triangle[t][c]]; }
  Vec3 face(std::size_t t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }
};

// Adds points that are spread over a part in proportion to area. Every run gives the same points.
void add_samples(const Mesh& mesh, std::size_t part, std::size_t count, std::vector<Sample>& out) {
  const std::size_t first = mesh.begin(part), end = mesh.parts.all[part].end_triangle;
  Box box;
  double area = 0;
  for (std::size_t t = first; t < end; ++t) {
    area += 0.5 * double(length(mesh.face(t)));
    for (std::size_t c = 0; c < 3; ++c) box.add(mesh.corner(t, c));
  }
  if (!(area > 0)) return;
  const float reach = reach_of_size * length(box.high - box.low);
  double before = 0;
  std::size_t made = 0;
  for (std::size_t t = first; t < end && made < count; ++t) {
    const Vec3 face = mesh.face(t);
    const double own = 0.5 * double(length(face));
    for (; made < count && (double(made) + 0.5) / double(count) * area <= before + own; ++made) {
      if (!(own > 0)) continue;
      // Uses the quasi-random sequence of the plastic number, and folds it into the triangle.
      float u = float(std::fmod(0.5 + 0.7548776662466927 * double(made), 1.0));
      float v = float(std::fmod(0.5 + 0.5698402909980532 * double(made), 1.0));
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 a = mesh.corner(t, 0);
      out.push_back({a + (mesh.corner(t, 1) - a) * u + (mesh.corner(t, 2) - a) * v,
                     normalised(face),
                     reach,
                     area / double(count),
                     std::uint32_t(part),
                     {}});
    }
    before += own;
  }
}

// Returns the line parameter at which a line crosses a triangle, or NaN if it does not cross it.
float crossing(Vec3 at, Vec3 direction, Vec3 a, Vec3 b, Vec3 c) {
  constexpr float slack = 1e-5f;  // for points on an edge that two triangles share
  const Vec3 ab = b - a, ac = c - a, p = cross(direction, ac);
  const float det = dot(ab, p);
  if (det == 0) return NAN;
  const Vec3 from = at - a;
  const float u = dot(from, p) / det;
  const Vec3 q = cross(from, ab);
  const float v = dot(direction, q) / det;
  if (!(u >= -slack && v >= -slack && u + v <= 1 + slack)) return NAN;
  return dot(ac, q) / det;
}

void add_hit(Sample& sample, const Hit& found) {
  for (Hit& hit : sample.hits)
    if (hit.part == found.part && hit.lie == found.lie) {
      if (std::abs(found.height) < std::abs(hit.height)) hit.height = found.height;
      return;
    }
  if (sample.hits.size() < most_hits) sample.hits.push_back(found);
}

bool same_primitive(const SurfaceParts::Part& a, const SurfaceParts::Part& b) {
  return a.node == b.node && a.primitive == b.primitive;
}

std::vector<Sample> sample_parts(const Mesh& mesh) {
  std::vector<std::size_t> order(mesh.parts.all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto triangles = [&](std::size_t p) { return mesh.parts.all[p].end_triangle - mesh.begin(p); };
  if (order.size() > most_parts) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return triangles(a) > triangles(b); });
    order.resize(most_parts);
  }
  const std::size_t count = std::clamp(all_samples / order.size(), fewest_of_part, most_of_part);
  std::vector<Sample> samples;
  for (const std::size_t part : order) add_samples(mesh, part, count, samples);
  return samples;
}

void find_hits(const Mesh& mesh, std::vector<Sample>& samples) {
  SampleTree tree(samples);
  std::size_t part = 0, tests = 0;
  for (std::size_t t = 0; t < mesh.triangle.size() && tests < most_tests; ++t) {
    while (part < mesh.parts.all.size() && t >= mesh.parts.all[part].end_triangle) ++part;
    if (part == mesh.parts.all.size()) return;
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    Box box;
    for (const Vec3 p : {a, b, c}) box.add(p);
    const Vec3 normal = normalised(mesh.face(t));
    tree.visit(box, [&](Sample& sample) {
      ++tests;
      if (same_primitive(mesh.parts.all[sample.part], mesh.parts.all[part])) return;
      const float cosine = dot(sample.normal, normal);
      if (!(std::abs(cosine) >= least_cosine)) return;
      const float height = crossing(sample.at, sample.normal, a, b, c) / sample.reach;
      if (!(std::abs(height) <= 1)) return;
      const Lie lie = cosine > 0 ? Lie::along : height > same_plane ? Lie::facing : Lie::behind;
      add_hit(sample, {std::uint32_t(part), height, lie});
    });
  }
}

// A whole node, or one of its primitives when primitives of the same node are compared.
using Surface = std::array<std::uint32_t, 2>;
constexpr std::uint32_t whole_node = ~0u;

// Sums over the samples of one surface that hit another surface. Heights are in units of the reach.
struct Contact {
  double area = 0, height = 0, height_square = 0;
};

struct Contacts {
  std::map<Surface, double> area;  // area of each surface
  std::map<std::pair<Surface, Surface>, Contact> of;
};

std::map<Surface, double> areas_of(const Mesh& mesh, const std::vector<Sample>& samples) {
  std::map<Surface, double> area;
  for (const Sample& sample : samples) {
    const SurfaceParts::Part& own = mesh.parts.all[sample.part];
    area[{own.node, whole_node}] += sample.area;
    area[{own.node, own.primitive}] += sample.area;
  }
  return area;
}

Contacts add_up(const Mesh& mesh, const std::vector<Sample>& samples, Lie lie) {
  Contacts sum{areas_of(mesh, samples), {}};
  std::map<Surface, float> nearest;
  for (const Sample& sample : samples) {
    const SurfaceParts::Part& own = mesh.parts.all[sample.part];
    nearest.clear();
    for (const Hit& hit : sample.hits) {
      if (hit.lie != lie) continue;
      const SurfaceParts::Part& other = mesh.parts.all[hit.part];
      const Surface key{other.node, other.node == own.node ? other.primitive : whole_node};
      const auto [at, is_new] = nearest.try_emplace(key, hit.height);
      if (!is_new && std::abs(hit.height) < std::abs(at->second)) at->second = hit.height;
    }
    for (const auto& [key, height] : nearest) {
      const Surface self{own.node, key[0] == own.node ? own.primitive : whole_node};
      Contact& contact = sum.of[{self, key}];
      contact.area += sample.area;
      contact.height += sample.area * double(height);
      contact.height_square += sample.area * double(height) * double(height);
    }
  }
  return sum;
}

bool belongs_to(const SurfaceParts::Part& part, const Surface& surface) {
  return part.node == surface[0] && (surface[1] == whole_node || part.primitive == surface[1]);
}

template <class Visit>
void for_each_triangle(const Mesh& mesh, const Surface& surface, Visit visit) {
  for (std::size_t p = 0; p < mesh.parts.all.size(); ++p)
    if (belongs_to(mesh.parts.all[p], surface))
      for (std::size_t t = mesh.begin(p); t < mesh.parts.all[p].end_triangle; ++t) visit(t);
}

std::set<std::array<float, 3>> places_of(const Mesh& mesh, const Surface& surface) {
  std::set<std::array<float, 3>> places;
  for_each_triangle(mesh, surface, [&](std::size_t t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p = mesh.corner(t, c);
      places.insert({p.x, p.y, p.z});
    }
  });
  return places;
}

// Returns true if half of the vertices of one surface are also vertices of the other. This finds a level of
// detail that keeps some vertices of a convex body. Such a level lies inside the body and does not cross its
// surface.
bool share_vertices(const Mesh& mesh, const Surface& a, const Surface& b) {
  std::set<std::array<float, 3>> few = places_of(mesh, a), many = places_of(mesh, b);
  if (few.size() > many.size()) few.swap(many);
  std::size_t shared = 0;
  for (const auto& place : few) shared += many.count(place);
  return 2 * shared >= few.size();
}

// Returns true for a mesh and a copy of it that was moved outwards along its normals.
bool have_equal_counts(const Mesh& mesh, const Surface& a, const Surface& b) {
  std::size_t of_a = 0, of_b = 0;
  for_each_triangle(mesh, a, [&](std::size_t) { ++of_a; });
  for_each_triangle(mesh, b, [&](std::size_t) { ++of_b; });
  return of_a == of_b && places_of(mesh, a).size() == places_of(mesh, b).size();
}

// Returns true for a copy or a level of detail. Clothes on a body and pictures on a wall do not match,
// because they stay on one side of the other surface and cover only a part of it.
bool is_coincident(const Mesh& mesh, const Surface& a, const Surface& b, const Contact& from_a,
                   const Contact& from_b, const float (&cover)[2]) {
  const double area = from_a.area + from_b.area;
  const double mean = std::abs(from_a.height - from_b.height) / area;
  const double rms = std::sqrt((from_a.height_square + from_b.height_square) / area);
  const float least = std::min(cover[0], cover[1]), most = std::max(cover[0], cover[1]);
  // Clothes keep a nearly constant distance to the body: the mean / rms of their heights is 0.93 or more.
  // Levels of detail lie on both sides, or have their corners on the surface of a convex body and the rest
  // inside. Their mean / rms is 0.05 to 0.86, and rises as they get coarser.
  const double one_sided = rms < double(same_plane) ? 0 : mean / rms;
  if (least >= 0.9f) return one_sided < 0.9 || share_vertices(mesh, a, b) || have_equal_counts(mesh, a, b);
  if (least >= 0.5f) return one_sided < 0.8 || share_vertices(mesh, a, b);
  return most >= 0.9f && rms >= double(same_plane) && one_sided < 0.7;
}

// The pairs of surfaces that face the same way.
std::vector<CoincidentPair> pairs_of(const Mesh& mesh, Contacts sum) {
  std::vector<CoincidentPair> out;
  std::size_t candidates = 0;
  for (const auto& [pair, there] : sum.of) {
    const auto back = sum.of.find({pair.second, pair.first});
    if (back != sum.of.end() && pair.second < pair.first) continue;
    const Contact here = back == sum.of.end() ? Contact{} : back->second;
    Surface a = pair.first, b = pair.second;
    float cover[2] = {float(there.area / sum.area[a]), float(here.area / sum.area[b])};
    if (std::max(cover[0], cover[1]) < 0.5f) continue;
    if (++candidates > most_candidates) break;
    if (!is_coincident(mesh, a, b, there, here, cover)) continue;
    std::size_t of_a = 0, of_b = 0;
    for_each_triangle(mesh, a, [&](std::size_t) { ++of_a; });
    for_each_triangle(mesh, b, [&](std::size_t) { ++of_b; });
    // The outer one of two copies darkens the inner one.
    const bool b_is_inside = there.height < 0 && here.height > 0;
    if (of_a < of_b || (of_a == of_b && b_is_inside)) std::swap(a, b), std::swap(cover[0], cover[1]);
    out.push_back({{a[0], b[0]}, {a[1], b[1]}, {cover[0], cover[1]}});
  }
  return out;
}

// Returns the volume that each surface encloses. It is negative if the fronts face inwards. Open surfaces are
// closed by triangles to the centre of their bounding box.
std::map<Surface, double> volumes_of(const Mesh& mesh) {
  std::map<Surface, Box> boxes;
  std::map<Surface, double> volume;
  const auto surfaces_of = [&](std::size_t p) {
    const SurfaceParts::Part& part = mesh.parts.all[p];
    return std::array{Surface{part.node, part.primitive}, Surface{part.node, whole_node}};
  };
  for (std::size_t p = 0; p < mesh.parts.all.size(); ++p)
    for (const Surface& surface : surfaces_of(p)) {
      Box& box = boxes[surface];
      for (std::size_t t = mesh.begin(p); t < mesh.parts.all[p].end_triangle; ++t)
        for (std::size_t c = 0; c < 3; ++c) box.add(mesh.corner(t, c));
    }
  for (std::size_t p = 0; p < mesh.parts.all.size(); ++p)
    for (const Surface& surface : surfaces_of(p)) {
      const Box& box = boxes[surface];
      const Vec3 middle = 0.5f * (box.low + box.high);
      double& sum = volume[surface];
      for (std::size_t t = mesh.begin(p); t < mesh.parts.all[p].end_triangle; ++t)
        sum += double(dot(mesh.corner(t, 0) - middle, mesh.face(t))) / 6;
    }
  return volume;
}

// Returns the share of each surface's area that faces another surface and has nothing behind it. For a node,
// only surfaces of other nodes count. For a primitive, other primitives of its node count too.
std::map<Surface, double> facing_shares(const Mesh& mesh, const std::vector<Sample>& samples) {
  std::map<Surface, double> share, area = areas_of(mesh, samples);
  for (const Sample& sample : samples) {
    const SurfaceParts::Part& own = mesh.parts.all[sample.part];
    bool any = false, of_other_node = false, has_back = false;
    for (const Hit& hit : sample.hits) {
      has_back = has_back || hit.lie == Lie::behind;
      if (hit.lie != Lie::facing) continue;
      any = true;
      of_other_node = of_other_node || mesh.parts.all[hit.part].node != own.node;
    }
    if (any && !has_back) share[{own.node, own.primitive}] += sample.area;
    if (of_other_node && !has_back) share[{own.node, whole_node}] += sample.area;
  }
  for (auto& [surface, sum] : share) sum /= area[surface];
  return share;
}

// Returns surfaces that face other surfaces over nearly their whole area. Linings are left out, because they
// have cloth behind them. Sockets are left out, because a socket surrounds only a part of its ball.
std::vector<Surface> facing_surfaces(const Mesh& mesh, const std::vector<Sample>& samples) {
  // A hull is larger than its body, so its edges face nothing and its share is below 1.
  constexpr double least = 0.8;
  std::vector<Surface> out;
  const std::map<Surface, double> shares = facing_shares(mesh, samples);
  for (const auto& [surface, share] : shares) {
    if (share < least || out.size() == most_candidates) continue;
    const auto whole = shares.find({surface[0], whole_node});
    if (surface[1] == whole_node || whole == shares.end() || whole->second < least) out.push_back(surface);
  }
  return out;
}

// Returns the facing surfaces that enclose a negative volume. A hull may surround several surfaces; the
// result names the largest one.
std::vector<OutlineHull> hulls_of(const Mesh& mesh, const std::vector<Sample>& samples) {
  constexpr double least_of_body = 0.5;  // the hull does not cover inner surfaces, such as mouths
  std::map<Surface, OutlineHull> found;
  for (const Surface& surface : facing_surfaces(mesh, samples)) found[surface] = {};
  if (found.empty()) return {};
  std::map<Surface, double> volume = volumes_of(mesh), most;
  std::erase_if(found, [&](const auto& hull) { return !(volume[hull.first] < 0); });
  Contacts sum = add_up(mesh, samples, Lie::facing);
  for (const auto& [pair, contact] : sum.of) {
    const auto& [body, around] = pair;
    const double cover = contact.area / sum.area[body];
    if (cover < least_of_body || !(volume[body] > 0)) continue;
    for (auto at = found.lower_bound({around[0], 0}); at != found.end() && at->first[0] == around[0]; ++at) {
      const Surface& hull = at->first;
      if ((around[1] != whole_node && around != hull) || contact.area <= most[hull]) continue;
      most[hull] = contact.area;
      at->second = {hull[0], hull[1], hull[1] == whole_node, body[0], body[1], float(cover)};
    }
  }
  std::vector<OutlineHull> out;
  for (const auto& [surface, hull] : found)
    if (most[surface] > 0) out.push_back(hull);
  return out;
}

// Returns a name that matches only one of the two nodes of a pair.
std::string chosen_name(const tinygltf::Model& model, const CoincidentPair& pair, std::size_t which) {
  const std::size_t own = pair.node[which], other = pair.node[1 - which];
  if (node_label(model, own) != node_label(model, other)) return node_label(model, own);
  const std::string mesh = mesh_label(model, model.nodes[own].mesh);
  return mesh != mesh_label(model, model.nodes[other].mesh) ? mesh : "";
}

std::string sentence_of(const tinygltf::Model& model, const CoincidentPair& pair) {
  char cover[64];
  std::snprintf(cover, sizeof cover, "%.0f %% and %.0f %%", 100 * double(pair.cover[0]),
                100 * double(pair.cover[1]));
  std::string what, cure;
  if (pair.node[0] == pair.node[1]) {
    what = "primitives " + std::to_string(pair.primitive[0]) + " and " + std::to_string(pair.primitive[1]) +
           " of node \"" + node_label(model, pair.node[0]) + "\"";
    cure = "remove it from the mesh";
  } else {
    const std::string first = chosen_name(model, pair, 0), second = chosen_name(model, pair, 1);
    const auto label = [&](std::size_t i, const std::string& name) {
      return "\"" + (name.empty() ? node_label(model, pair.node[i]) : name) + "\"";
    };
    what = "nodes " + label(0, first) + " and " + label(1, second);
    cure = second.empty() ? "give it a unique name and leave it out with --without"
                          : "leave it out: --without \"" + second + "\"";
  }
  return what + " coincide on " + cover +
         " of their surfaces, so that each darkens the other; if one of them is a level of detail, a spare "
         "part or a copy, " +
         cure;
}

std::string sentence_of(const tinygltf::Model& model, const OutlineHull& hull) {
  const std::string percent = std::to_string(int(std::lround(100 * double(hull.cover)))) + " %";
  std::string what, around, cure;
  const std::string node = "node \"" + node_label(model, hull.node) + "\"";
  if (hull.is_whole_node) {
    const std::string name = chosen_name(model, {{hull.node, hull.inner_node}, {}, {}}, 0);
    what = name.empty() ? node : "\"" + name + "\"";
    cure = name.empty() ? "give it a unique name and leave it out with --without"
                        : "leave it out: --without \"" + name + "\"";
  } else {
    what = "primitive " + std::to_string(hull.primitive) + " of " + node;
    cure = "remove it from the mesh";
  }
  around = hull.inner_node == hull.node ? "primitive " + std::to_string(hull.inner_primitive)
                                        : "node \"" + node_label(model, hull.inner_node) + "\"";
  return what + " closely surrounds " + percent + " of " + around +
         ", with its faces turned inwards, like the hull of a toon outline, and darkens everything inside; " +
         cure;
}

}  // namespace

CloseSurfaces close_surfaces(const SurfaceParts& parts, std::span<const Vec3> position,
                             std::span<const Triangle> triangle) {
  std::set<Surface> distinct;
  for (const SurfaceParts::Part& part : parts.all) distinct.insert({part.node, part.primitive});
  if (distinct.size() < 2) return {};
  const Mesh mesh{parts, position, triangle};
  std::vector<Sample> samples = sample_parts(mesh);
  find_hits(mesh, samples);
  return {pairs_of(mesh, add_up(mesh, samples, Lie::along)), hulls_of(mesh, samples)};
}

std::vector<OutlineHull> warn_of_close_surfaces(const tinygltf::Model& model, const SurfaceParts& parts,
                                                std::span<const Vec3> position,
                                                std::span<const Triangle> triangle,
                                                std::vector<std::string>& warnings) {
  constexpr std::size_t most = 4;
  CloseSurfaces close = close_surfaces(parts, position, triangle);
  std::vector<CoincidentPair>& pairs = close.pairs;
  std::stable_sort(pairs.begin(), pairs.end(), [](const CoincidentPair& a, const CoincidentPair& b) {
    return a.cover[0] + a.cover[1] > b.cover[0] + b.cover[1];
  });
  for (std::size_t i = 0; i < std::min(pairs.size(), most); ++i)
    warnings.push_back(sentence_of(model, pairs[i]));
  if (pairs.size() > most)
    warnings.push_back(std::to_string(pairs.size() - most) +
                       (pairs.size() == most + 1 ? " more pair of nodes has" : " more pairs of nodes have") +
                       " surfaces that coincide; `nook inspect` lists the nodes of a file");
  for (std::size_t i = 0; i < std::min(close.hulls.size(), most); ++i)
    warnings.push_back(sentence_of(model, close.hulls[i]));
  if (close.hulls.size() > most)
    warnings.push_back(std::to_string(close.hulls.size() - most) +
                       (close.hulls.size() == most + 1 ? " more hull was found" : " more hulls were found") +
                       " around other surfaces; `nook inspect` lists the nodes of a file");
  return std::move(close.hulls);
}

}  // namespace nook::bake
