#include "bakers/character/rig_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "bakers/character/torn_edges.h"

namespace nook::bake {
namespace {

constexpr std::int32_t nobody = -1;

struct Box {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  bool is_empty() const { return low.x > high.x; }
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Box& box) {
    if (box.is_empty()) return;
    add(box.low);
    add(box.high);
  }
  Vec3 size() const { return is_empty() ? Vec3{} : high - low; }
};

// The skin that each bone moves more than any other bone does.
struct BoneSkin {
  std::vector<Box> box;
  std::vector<Vec3> middle;  // metres, rest space
  std::vector<float> count;  // vertices
};

BoneSkin bone_skin(const SkinnedMesh& mesh) {
  const std::size_t bones = mesh.bones.size();
  BoneSkin skin{std::vector<Box>(bones), std::vector<Vec3>(bones), std::vector<float>(bones, 0)};
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const std::size_t b = mesh.weights[i].bone[0];
    skin.box[b].add(mesh.position[i]);
    skin.middle[b] += mesh.position[i];
    ++skin.count[b];
  }
  for (std::size_t b = 0; b < bones; ++b)
    if (skin.count[b] > 0) skin.middle[b] = (1 / skin.count[b]) * skin.middle[b];
  return skin;
}

// For each bone, returns true if this bone or a bone below it moves skin.
std::vector<char> alive(const BoneSkin& skin, std::span<const std::int32_t> parent) {
  std::vector<char> live(parent.size(), 0);
  for (std::size_t b = 0; b < live.size(); ++b) {
    if (skin.count[b] == 0) continue;
    for (std::int32_t at = std::int32_t(b); at >= 0 && !live[std::size_t(at)]; at = parent[std::size_t(at)])
      live[std::size_t(at)] = 1;
  }
  return live;
}

std::vector<char> branch_of(std::span<const std::int32_t> parent, std::size_t root) {
  std::vector<char> in(parent.size(), 0);
  in[root] = 1;
  for (const std::uint32_t b : parents_first(parent))
    if (parent[b] >= 0 && in[std::size_t(parent[b])]) in[b] = 1;
  return in;
}

int depth_of(std::span<const std::int32_t> parent, std::int32_t bone) {
  int depth = 0;
  for (; bone >= 0; bone = parent[std::size_t(bone)]) ++depth;
  return depth;
}

bool has_word(const std::string& name, std::initializer_list<const char*> wanted) {
  for (const std::string& word : words_of(name))
    for (const char* w : wanted)
      if (word.find(w) != std::string::npos) return true;
  return false;
}

// For each bone, returns true if it is a twist bone. A twist bone has no children. Its name
// says so, or it lies between its parent and a sibling.
std::vector<char> helpers(const SkinnedMesh& mesh) {
  const std::size_t bones = mesh.bones.size();
  std::vector<char> helper(bones, 0), has_child(bones, 0);
  std::vector<std::vector<std::size_t>> children(bones);
  for (std::size_t b = 0; b < bones; ++b)
    if (mesh.bones[b].parent >= 0) {
      has_child[std::size_t(mesh.bones[b].parent)] = 1;
      children[std::size_t(mesh.bones[b].parent)].push_back(b);
    }
  for (std::size_t b = 0; b < bones; ++b) {
    if (has_child[b] || mesh.bones[b].parent < 0) continue;
    const auto p = std::size_t(mesh.bones[b].parent);
    if (has_word(mesh.bones[b].name, {"twist", "roll"})) helper[b] = 1;
    const Vec3 from = joint_origin(mesh.bones[p]), own = joint_origin(mesh.bones[b]) - from;
    for (const std::size_t other : children[p]) {
      if (!has_child[other]) continue;
      const Vec3 way = joint_origin(mesh.bones[other]) - from;
      const float along = dot(way, way) > 0 ? dot(own, way) / dot(way, way) : 0;
      if (along > 0.05f && along < 0.95f && length(own - along * way) < 0.05f * length(way)) helper[b] = 1;
    }
  }
  return helper;
}

}  // namespace

std::vector<SkinContact> skin_contacts(const SkinnedMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, float> found;
  for (const MeshEdge& edge : mesh_edges(mesh)) {
    const SkinWeights &u = mesh.weights[edge[0]], &v = mesh.weights[edge[1]];
    for (int s = 0; s < SkinWeights::max_bones && u.weight[s] > 0; ++s)
      for (int t = 0; t < SkinWeights::max_bones && v.weight[t] > 0; ++t)
        if (u.bone[s] != v.bone[t])
          found[{std::min(u.bone[s], v.bone[t]), std::max(u.bone[s], v.bone[t])}] +=
              u.weight[s] * v.weight[t];
  }
  std::vector<SkinContact> contacts;
  for (const auto& [bones, amount] : found) contacts.push_back({bones.first, bones.second, amount});
  return contacts;
}

namespace {

struct Holder {
  std::int32_t bone = nobody;
  float amount = 0, of_ancestors = 0;
};

// Returns the bone outside a branch that shares most skin with the branch. `of_ancestors` is how much skin
// the branch shares with the ancestors of its root.
Holder holder_by_edges(std::span<const SkinContact> contacts, std::span<const std::int32_t> parent,
                       const std::vector<char>& branch, std::size_t root) {
  std::map<std::uint32_t, float> shared;
  for (const SkinContact& c : contacts)
    if (branch[c.a] != branch[c.b]) shared[branch[c.a] ? c.b : c.a] += c.amount;
  Holder holder;
  for (const auto& [bone, amount] : shared)
    if (amount > holder.amount) {
      holder.bone = std::int32_t(bone);
      holder.amount = amount;
    }
  for (std::int32_t a = parent[root]; a >= 0; a = parent[std::size_t(a)]) {
    const auto found = shared.find(std::uint32_t(a));
    if (found != shared.end()) holder.of_ancestors += found->second;
  }
  return holder;
}

// Returns the bone that holds an unconnected part of the mesh: the bone of the nearest vertex outside the
// part, if the distance is less than 3 % of the body's diagonal.
Holder holder_by_nearness(const SkinnedMesh& mesh, const std::vector<char>& branch) {
  constexpr std::size_t most_samples = 12;
  std::vector<std::uint32_t> own, other;
  Box box;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    (branch[mesh.weights[i].bone[0]] ? own : other).push_back(i);
    box.add(mesh.position[i]);
  }
  Holder holder;
  float nearest = 0.03f * length(box.size());
  for (std::size_t s = 0; s < std::min(most_samples, own.size()); ++s) {
    const Vec3 at = mesh.position[own[s * own.size() / std::min(most_samples, own.size())]];
    for (const std::uint32_t i : other) {
      const float distance = length(mesh.position[i] - at);
      if (distance >= nearest) continue;
      nearest = distance;
      holder = {std::int32_t(mesh.weights[i].bone[0]), 1, 0};
    }
  }
  return holder;
}

// Returns the root bone with the most vertices below it.
std::int32_t main_root(const BoneSkin& skin, std::span<const std::int32_t> parent) {
  std::vector<float> count(skin.count);
  const std::vector<std::uint32_t> order = parents_first(parent);
  std::int32_t best = nobody;
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::uint32_t b = order[i];
    if (parent[b] >= 0)
      count[std::size_t(parent[b])] += count[b];
    else if (best < 0 || count[b] >= count[std::size_t(best)])
      best = std::int32_t(b);
  }
  return best;
}

}  // namespace

std::vector<std::int32_t> parents_by_skin(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  std::vector<std::int32_t> parent;
  for (const Bone& bone : mesh.bones) parent.push_back(bone.parent);
  std::vector<char> fixed(parent.size(), 0);
  for (const BoneCorrection& c : corrections)
    if (c.parent) {
      fixed[c.bone] = 1;
      parent[c.bone] = *c.parent;
    }
  const BoneSkin skin = bone_skin(mesh);
  const std::vector<char> live = alive(skin, parent), helper = helpers(mesh);
  const std::vector<SkinContact> contacts = skin_contacts(mesh);
  const std::int32_t root = main_root(skin, parent);
  for (const std::uint32_t b : parents_first(parent)) {
    if (!live[b] || fixed[b] || std::int32_t(b) == root) continue;
    const std::int32_t above = parent[b];
    // If the parent has skin and is not the rig's root, the bone keeps its parent.
    if (above >= 0 && skin.count[std::size_t(above)] > 0 && parent[std::size_t(above)] >= 0) continue;
    const std::vector<char> branch = branch_of(parent, b);
    Holder holder = holder_by_edges(contacts, parent, branch, b);
    if (holder.bone < 0) holder = holder_by_nearness(mesh, branch);
    while (holder.bone >= 0 && helper[std::size_t(holder.bone)])
      holder.bone = parent[std::size_t(holder.bone)];
    if (holder.bone < 0 || branch[std::size_t(holder.bone)]) continue;
    if (holder.of_ancestors >= 0.1f * holder.amount) continue;
    // Siblings such as thighs may touch each other, but they keep their common parent.
    const bool is_far = depth_of(parent, holder.bone) >= depth_of(parent, above) + 2;
    if (above < 0 || is_far) parent[b] = holder.bone;
  }
  return parent;
}

namespace {

float across(const BodySides& sides, Vec3 p) {
  return (sides.across_x ? p.x : p.z) - sides.middle_m;
}

Vec3 mirrored_point(const BodySides& sides, Vec3 p) {
  (sides.across_x ? p.x : p.z) -= 2 * across(sides, p);
  return p;
}

// Each bone chooses the bone that is nearest to its mirror image. Two bones that choose each other become
// partners.
void pair_bones(const SkinnedMesh& mesh, const std::vector<char>& live, const std::vector<Vec3>& tip,
                std::span<const std::int32_t> parent, BodySides& sides) {
  const std::size_t bones = mesh.bones.size();
  std::vector<std::int32_t> choice(bones, nobody);
  std::vector<int> depth(bones);
  for (std::size_t b = 0; b < bones; ++b) depth[b] = depth_of(parent, std::int32_t(b));
  for (std::size_t b = 0; b < bones; ++b) {
    if (!live[b]) continue;
    const Vec3 own = joint_origin(mesh.bones[b]);
    const bool in_middle = std::fabs(across(sides, own)) < sides.tolerance_m &&
                           std::fabs(across(sides, tip[b])) < sides.tolerance_m;
    if (in_middle) {
      choice[b] = std::int32_t(b);
      continue;
    }
    const Vec3 image = mirrored_point(sides, own), image_tip = mirrored_point(sides, tip[b]);
    float nearest = 4 * sides.tolerance_m;
    for (std::size_t o = 0; o < bones; ++o) {
      if (o == b || !live[o] || depth[o] != depth[b]) continue;
      const float distance = length(joint_origin(mesh.bones[o]) - image) + length(tip[o] - image_tip);
      if (distance >= nearest) continue;
      nearest = distance;
      choice[b] = std::int32_t(o);
    }
  }
  sides.partner.assign(bones, nobody);
  for (std::size_t b = 0; b < bones; ++b)
    if (choice[b] >= 0 && choice[std::size_t(choice[b])] == std::int32_t(b)) sides.partner[b] = choice[b];
}

// For each bone, returns the mean position of the skin of this bone and of all bones below it. If none of
// them has skin, returns the bone's joint.
std::vector<Vec3> bone_tips(const SkinnedMesh& mesh, const BoneSkin& skin,
                            std::span<const std::int32_t> parent) {
  const std::vector<std::uint32_t> order = parents_first(parent);
  std::vector<Vec3> sum(parent.size());
  std::vector<float> count(parent.size(), 0);
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::uint32_t b = order[i];
    sum[b] += skin.count[b] * skin.middle[b];
    count[b] += skin.count[b];
    if (parent[b] >= 0) {
      sum[std::size_t(parent[b])] += sum[b];
      count[std::size_t(parent[b])] += count[b];
    }
  }
  for (std::size_t b = 0; b < sum.size(); ++b)
    sum[b] = count[b] > 0 ? (1 / count[b]) * sum[b] : joint_origin(mesh.bones[b]);
  return sum;
}

}  // namespace

BodySides body_sides(const SkinnedMesh& mesh, std::span<const std::int32_t> parent) {
  const BoneSkin skin = bone_skin(mesh);
  const std::vector<char> live = alive(skin, parent);
  const std::vector<Vec3> tip = bone_tips(mesh, skin, parent);
  Box box;
  Vec3 sum;
  float count = 0;
  for (std::size_t b = 0; b < live.size(); ++b)
    if (live[b]) {
      box.add(joint_origin(mesh.bones[b]));
      sum += joint_origin(mesh.bones[b]);
      ++count;
    }
  Box all;
  for (const Vec3 p : mesh.position) all.add(p);
  const Vec3 mean = count > 0 ? (1 / count) * sum : Vec3{}, centre = 0.5f * (all.low + all.high);
  BodySides best;
  // Compares the number of pairs first, then the number of pairs and middle bones together. For example, the
  // bones of a snake along x form no pairs across x, and they all lie in the middle across z.
  std::pair<int, int> most{-1, -1};
  for (const bool x : {true, false})
    for (const float middle : {x ? mean.x : mean.z, 0.0f, x ? centre.x : centre.z}) {
      BodySides sides{x, middle, 0.02f * length(all.size()), {}};
      pair_bones(mesh, live, tip, parent, sides);
      std::pair<int, int> found{0, 0};
      for (std::size_t b = 0; b < live.size(); ++b) {
        found.first += sides.partner[b] >= 0 && sides.partner[b] != std::int32_t(b);
        found.second += sides.partner[b] >= 0;
      }
      if (found <= most) continue;
      most = found;
      best = std::move(sides);
    }
  return best;
}

namespace {

// Finds the roles in this order: middle of the body, limbs, branches on limbs.
class RigReader {
 public:
  RigReader(const SkinnedMesh& mesh, const RigCorrections& corrections);
  std::vector<Joint> read();

 private:
  void find_front();
  void find_carried();
  void correct_sides(const RigCorrections& corrections);
  bool is_middle(std::size_t b) const { return live_[b] && sides_.partner[b] == std::int32_t(b); }
  bool spans_body(std::size_t b) const;
  JointRole hinted(std::size_t b) const;
  std::vector<std::size_t> branch_bones(std::size_t root) const;
  std::size_t branch_end(std::size_t root, bool lowest) const;
  bool is_leg(std::size_t root) const;
  JointRole role_of_branch(std::size_t root) const;
  void read_branch(std::size_t root);
  void read_middle();
  void read_feet(const std::vector<std::size_t>& chain);
  void number_limbs();
  void apply(const RigCorrections& corrections);
  float forward_of(Vec3 p) const { return front_ * (sides_.across_x ? p.z : p.x); }
  Vec3 origin(std::size_t b) const { return joint_origin(mesh_.bones[b]); }

  const SkinnedMesh& mesh_;
  const RigCorrections& corrections_;
  std::vector<std::int32_t> parent_;
  std::vector<std::uint32_t> order_;
  BodySides sides_;
  BoneSkin skin_;
  std::vector<char> live_, helper_, carried_;
  std::vector<Box> below_;  // bounds of the skin of a bone and all bones below it
  std::vector<std::vector<std::size_t>> children_;
  std::vector<Vec3> tip_;
  Box body_;
  float front_ = 1;
  std::vector<Joint> joints_;
  std::vector<std::size_t> branch_roots_;
  std::vector<JointRole> branch_role_;
};

RigReader::RigReader(const SkinnedMesh& mesh, const RigCorrections& corrections)
    : mesh_(mesh),
      corrections_(corrections),
      parent_(parents_by_skin(mesh, corrections)),
      order_(parents_first(parent_)),
      sides_(body_sides(mesh, parent_)),
      skin_(bone_skin(mesh)),
      live_(alive(skin_, parent_)),
      helper_(helpers(mesh)),
      below_(skin_.box),
      children_(mesh.bones.size()),
      tip_(bone_tips(mesh, skin_, parent_)),
      joints_(mesh.bones.size()) {
  for (std::size_t i = order_.size(); i-- > 0;)
    if (parent_[order_[i]] >= 0) below_[std::size_t(parent_[order_[i]])].add(below_[order_[i]]);
  for (const std::uint32_t b : order_)
    if (parent_[b] >= 0) children_[std::size_t(parent_[b])].push_back(b);
  for (const Vec3 p : mesh.position) body_.add(p);
  for (std::size_t b = 0; b < joints_.size(); ++b) {
    joints_[b].parent = parent_[b];
    if (!live_[b]) joints_[b].role = JointRole::control;
  }
  find_front();
  find_carried();
}

// Finds objects that a limb carries. A carried object is an unconnected part of the mesh at the end of a
// branch. A body that consists of unconnected parts carries no objects.
void RigReader::find_carried() {
  carried_.assign(live_.size(), 0);
  std::vector<char> touches(live_.size(), 0);
  for (const SkinContact& c : skin_contacts(mesh_)) touches[c.a] = touches[c.b] = 1;
  float islands = 0, bones = 0;
  for (std::size_t b = 0; b < live_.size(); ++b)
    if (skin_.count[b] > 0) {
      islands += !touches[b];
      ++bones;
    }
  if (islands > 0.4f * bones) return;
  for (std::size_t b = 0; b < live_.size(); ++b) {
    const bool ends =
        std::none_of(children_[b].begin(), children_[b].end(), [&](std::size_t c) { return live_[c] != 0; });
    carried_[b] = skin_.count[b] > 0 && !touches[b] && ends && parent_[b] >= 0;
  }
}

// Bones that are named head, neck, jaw, snout or tail determine the front. Without such names, the front is
// +z, or +x for a body whose sides differ in z.
void RigReader::find_front() {
  Vec3 all, difference;
  float count = 0;
  for (std::size_t b = 0; b < live_.size(); ++b)
    if (live_[b]) {
      all += origin(b);
      ++count;
    }
  if (count > 0) all = (1 / count) * all;
  for (std::size_t b = 0; b < live_.size(); ++b) {
    if (!live_[b]) continue;
    const std::string& name = mesh_.bones[b].name;
    if (has_word(name, {"tail"})) difference += all - tip_[b];
    if (has_word(name, {"head", "neck", "jaw", "snout"})) difference += tip_[b] - all;
  }
  front_ = forward_of(difference) < 0 ? -1.0f : 1.0f;
}

// Returns the role that a name suggests. It is used where geometry alone is ambiguous.
JointRole RigReader::hinted(std::size_t b) const {
  const std::string& name = mesh_.bones[b].name;
  if (has_word(name, {"tail"})) return JointRole::tail;
  if (has_word(name, {"jaw", "mouth", "mandible"})) return JointRole::jaw;
  if (has_word(name, {"wing", "feather"})) return JointRole::wing;
  if (has_word(name, {"neck"})) return JointRole::neck;
  if (has_word(name, {"head", "skull"})) return JointRole::head;
  for (const std::string& word : words_of(name))
    if (word == "ear" || word == "ears") return JointRole::ear;
  return JointRole::other;
}

std::vector<std::size_t> RigReader::branch_bones(std::size_t root) const {
  std::vector<std::size_t> bones{root};
  for (std::size_t i = 0; i < bones.size(); ++i)
    for (const std::size_t c : children_[bones[i]])
      if (live_[c]) bones.push_back(c);
  return bones;
}

// Returns the bone at which a branch ends: the bone with the lowest skin, or with the skin farthest from the
// branch's root. Among bones near that extreme, returns the deepest one in the hierarchy.
std::size_t RigReader::branch_end(std::size_t root, bool lowest) const {
  const float tolerance = 0.05f * body_.size().y;
  std::size_t best = root;
  float best_value = -INFINITY;
  for (const std::size_t b : branch_bones(root)) {
    if (skin_.count[b] == 0 || helper_[b] || carried_[b]) continue;
    const float value = lowest ? -skin_.box[b].low.y : length(skin_.middle[b] - origin(root));
    const bool deeper = depth_of(parent_, std::int32_t(b)) > depth_of(parent_, std::int32_t(best));
    if (value > best_value + tolerance || (value > best_value - tolerance && deeper)) {
      best = b;
      best_value = std::max(value, best_value);
    }
  }
  return best;
}

// A leg starts at a fifth of the body's height or higher, reaches the ground, and has two bones or more.
bool RigReader::is_leg(std::size_t root) const {
  const Vec3 size = body_.size();
  const float ground = body_.low.y;
  const std::size_t bones = branch_bones(root).size();
  return bones >= 2 && below_[root].low.y < ground + 0.08f * size.y &&
         origin(root).y > ground + 0.2f * size.y;
}

JointRole RigReader::role_of_branch(std::size_t root) const {
  for (const std::size_t b : branch_bones(root)) {
    const JointRole hint = hinted(b);
    if (hint == JointRole::wing || hint == JointRole::ear || hint == JointRole::tail) return hint;
    if (hint == JointRole::jaw && b == root) return hint;
    if (b != root && depth_of(parent_, std::int32_t(b)) > depth_of(parent_, std::int32_t(root)) + 1) break;
  }
  if (is_leg(root)) return JointRole::leg;
  const Vec3 size = below_[root].size(), body = body_.size();
  const float lateral = sides_.across_x ? size.x : size.z, along = sides_.across_x ? size.z : size.x;
  const float width = sides_.across_x ? body.x : body.z;
  // A wing is flat and reaches far to its side.
  const float thinnest = std::min({lateral, along, size.y});
  if (lateral > 0.25f * width && thinnest < 0.2f * along && lateral > size.y && along > thinnest &&
      lateral > 0.5f * along)
    return JointRole::wing;
  const float reach = length(size), whole = length(body);
  // On a head, a small branch that reaches above the head's joint is an ear.
  const std::int32_t on = parent_[root];
  if (on >= 0 && joints_[std::size_t(on)].role == JointRole::head)
    return reach < 0.25f * whole && below_[root].high.y > origin(std::size_t(on)).y ? JointRole::ear
                                                                                    : JointRole::other;
  return reach > 0.08f * whole ? JointRole::arm : JointRole::other;
}

// A foot consists of the last bones of a leg that are lower than a quarter of the height of the leg's root.
void RigReader::read_feet(const std::vector<std::size_t>& chain) {
  const float ground = body_.low.y, height = origin(chain.front()).y - ground;
  for (std::size_t i = 2; i < chain.size(); ++i)
    if (origin(chain[i]).y - ground < 0.25f * height) joints_[chain[i]].role = JointRole::foot;
}

void RigReader::read_branch(std::size_t root) {
  const JointRole role = role_of_branch(root);
  branch_roots_.push_back(root);
  branch_role_.push_back(role);
  std::vector<std::size_t> chain;
  const std::size_t end = branch_end(root, role == JointRole::leg);
  for (std::size_t b = end;; b = std::size_t(parent_[b])) {
    chain.push_back(b);
    if (b == root) break;
  }
  std::reverse(chain.begin(), chain.end());
  for (const std::size_t b : branch_bones(root)) joints_[b].role = role;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    joints_[chain[i]].segment = std::uint8_t(std::min<std::size_t>(i, 255));
    if (i + 1 < chain.size()) joints_[chain[i]].continuation = std::int32_t(chain[i + 1]);
  }
  if (role == JointRole::leg) read_feet(chain);
  const std::set<std::size_t> on_chain(chain.begin(), chain.end());
  for (const std::size_t b : branch_bones(root)) {
    if (carried_[b]) joints_[b].role = JointRole::prop;
    if (on_chain.count(b) || carried_[b]) continue;
    const JointRole above = joints_[std::size_t(parent_[b])].role;
    if (helper_[b])
      joints_[b].role = JointRole::helper;
    else if (role == JointRole::leg)
      joints_[b].role =
          above == JointRole::foot || above == JointRole::toe ? JointRole::toe : JointRole::other;
    else if (role == JointRole::arm)
      joints_[b].role = JointRole::finger;
  }
}

// Returns true for a bone of the trunk: it is in the middle, and the body has limbs in front of it and behind
// it.
bool RigReader::spans_body(std::size_t b) const {
  std::size_t with = 0;
  bool own = false, elsewhere = false;
  std::vector<char> below = branch_of(parent_, b);
  for (std::size_t i = 0; i < branch_roots_.size(); ++i) {
    const JointRole role = branch_role_[i];
    if (role != JointRole::leg && role != JointRole::arm && role != JointRole::wing) continue;
    const auto on = std::size_t(parent_[branch_roots_[i]]);
    own = own || on == b;
    with += below[branch_roots_[i]];
    elsewhere = elsewhere || !below[branch_roots_[i]];
  }
  return own || with > 0 || !elsewhere;
}

void RigReader::read_middle() {
  Vec3 centre;
  float count = 0;
  bool has_limbs = false;
  for (std::size_t i = 0; i < branch_roots_.size(); ++i) {
    const JointRole role = branch_role_[i];
    if (role != JointRole::leg && role != JointRole::arm && role != JointRole::wing) continue;
    has_limbs = true;
    centre += origin(branch_roots_[i]);
    ++count;
  }
  if (count > 0) centre = (1 / count) * centre;
  for (const std::uint32_t b : order_) {
    if (!is_middle(b)) continue;
    const std::int32_t p = parent_[b];
    const JointRole above = p >= 0 ? joints_[std::size_t(p)].role : JointRole::spine;
    const JointRole hint = hinted(b);
    JointRole& role = joints_[b].role;
    if (p < 0 || (skin_.count[b] == 0 && parent_[std::size_t(p)] < 0))
      role = JointRole::pelvis;
    else if (hint == JointRole::tail || hint == JointRole::jaw || hint == JointRole::neck ||
             hint == JointRole::head)
      role = hint;
    else if (above == JointRole::head)
      role = tip_[b].y < tip_[std::size_t(p)].y ? JointRole::jaw : JointRole::other;
    else if (above == JointRole::tail || above == JointRole::neck || above == JointRole::jaw)
      role = above;
    else if (has_limbs && !spans_body(b))
      role = forward_of(tip_[b]) >= forward_of(centre) ? JointRole::neck : JointRole::tail;
    else
      role = JointRole::spine;
  }
  // The last bone of a neck is a head.
  for (const std::uint32_t b : order_) {
    if (joints_[b].role != JointRole::neck) continue;
    const bool goes_on = std::any_of(children_[b].begin(), children_[b].end(), [&](std::size_t c) {
      return joints_[c].role == JointRole::neck || joints_[c].role == JointRole::head;
    });
    if (!goes_on) joints_[b].role = JointRole::head;
  }
  for (std::size_t i = order_.size(); i-- > 0;) {
    const std::size_t b = order_[i];
    const std::int32_t p = parent_[b];
    if (!is_middle(b) || p < 0 || joints_[std::size_t(p)].role != joints_[b].role) continue;
    joints_[std::size_t(p)].continuation = std::int32_t(b);
  }
}

std::vector<Joint> RigReader::read() {
  // Ears can be distinguished from arms only when the heads are known, and spines from necks only when the
  // limbs are known. So we read limbs first, then the middle, then the small branches again.
  std::vector<std::size_t> roots;
  for (const std::uint32_t b : order_) {
    if (!live_[b] || is_middle(b)) continue;
    const std::int32_t p = parent_[b];
    if (p < 0 || is_middle(std::size_t(p))) roots.push_back(b);
  }
  for (const std::size_t root : roots) read_branch(root);
  read_middle();
  branch_roots_.clear();
  branch_role_.clear();
  for (const std::size_t root : roots) read_branch(root);
  read_middle();
  number_limbs();
  apply(corrections_);
  return joints_;
}

// Numbers legs first, from front to back, and left before right. Then numbers all other branches and the
// chains of the middle.
void RigReader::number_limbs() {
  const float left = front_ * (sides_.across_x ? 1.0f : -1.0f);
  std::vector<std::size_t> roots = branch_roots_;
  for (const std::uint32_t b : order_) {
    const std::int32_t p = parent_[b];
    const JointRole role = joints_[b].role;
    const bool chain = role == JointRole::tail || role == JointRole::neck || role == JointRole::jaw;
    if (is_middle(b) && chain && (p < 0 || joints_[std::size_t(p)].role != role)) roots.push_back(b);
  }
  const float step = 2 * sides_.tolerance_m;
  const auto key = [&](std::size_t b) {
    return std::tuple(joints_[b].role != JointRole::leg,
                      std::lround(-forward_of(origin(b)) / std::max(step, 1e-6f)),
                      -left * across(sides_, tip_[b]), b);
  };
  std::sort(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::int32_t number = 0;
  for (const std::size_t root : roots) {
    const bool middle = is_middle(root);
    for (const std::size_t b : branch_bones(root)) {
      if (middle && !is_middle(b)) continue;
      if (joints_[b].limb < 0 || !middle) joints_[b].limb = number;
    }
    ++number;
  }
  for (std::size_t b = 0; b < joints_.size(); ++b) {
    const float at = left * across(sides_, tip_[b]);
    if (!live_[b] || is_middle(b)) continue;
    joints_[b].side = at > 0 ? Side::left : Side::right;
  }
}

void RigReader::apply(const RigCorrections& corrections) {
  for (const BoneCorrection& c : corrections) {
    Joint& joint = joints_[c.bone];
    if (c.role) joint.role = *c.role;
    if (c.side) joint.side = *c.side;
    if (c.limb) joint.limb = *c.limb;
  }
}

}  // namespace

std::vector<Joint> roles_by_geometry(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  return RigReader(mesh, corrections).read();
}

}  // namespace nook::bake
