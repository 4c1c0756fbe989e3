#include "sdk/src/character/sphere_tree.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nook {
namespace {

// A leaf costs one test for all of its spheres.
constexpr std::uint32_t leaf_spheres = 4;

using Spheres = std::span<std::uint32_t>;

float coordinate(const CharacterModel& model, std::uint32_t sphere, int axis) {
  const Vec3& centre = model.spheres[sphere].centre;
  return axis == 0 ? centre.x : axis == 1 ? centre.y : centre.z;
}

// Returns the number of spheres of the first half, which is neither none nor all of them.
std::uint32_t split(const CharacterModel& model, Spheres spheres) {
  int longest = 0;
  float extent = -1, middle = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(spheres.begin(), spheres.end(), [&](std::uint32_t a, std::uint32_t b) {
          return coordinate(model, a, axis) < coordinate(model, b, axis);
        });
    const float from = coordinate(model, *low, axis), to = coordinate(model, *high, axis);
    if (!(to - from > extent)) continue;
    longest = axis;
    extent = to - from;
    middle = 0.5f * from + 0.5f * to;
  }
  const auto cut = std::stable_partition(spheres.begin(), spheres.end(), [&](std::uint32_t s) {
    return coordinate(model, s, longest) < middle;
  });
  const auto first = static_cast<std::uint32_t>(cut - spheres.begin());
  return first == 0 || first == spheres.size() ? static_cast<std::uint32_t>(spheres.size() / 2) : first;
}

void add_nodes(const CharacterModel& model, Spheres all, std::uint32_t begin, std::uint32_t end,
               Vector<SphereTreeNode>& nodes) {
  const std::size_t own = nodes.size();
  nodes.push_back({begin, end, 0});
  if (end - begin > leaf_spheres) {
    const std::uint32_t middle = begin + split(model, all.subspan(begin, end - begin));
    add_nodes(model, all, begin, middle, nodes);
    add_nodes(model, all, middle, end, nodes);
  }
  nodes[own].next = static_cast<std::uint32_t>(nodes.size());
}

// Sums over the spheres of a node.
struct Moments {
  float mass = 0;    // square metres: the sum of squared radii
  Vec3 centre;       // by mass
  float spread = 0;  // metres^4: sum of mass * (distance from the centre)^2
  float fourth = 0;  // metres^4: sum of mass * radius^2
};

// Sums about the first sphere, which is near all of them.
Moments moments_of(std::span<const MassSphere> spheres) {
  Moments sum;
  const Vec3 first{spheres[0].x, spheres[0].y, spheres[0].z};
  Vec3 shift;
  for (const MassSphere& sphere : spheres) {
    const Vec3 d = Vec3{sphere.x, sphere.y, sphere.z} - first;
    const float mass = sphere.softness;
    sum.mass += mass;
    shift += d * mass;
    sum.spread += mass * dot(d, d);
    sum.fourth += mass * mass;
  }
  shift = shift * (1 / sum.mass);
  sum.centre = first + shift;
  sum.spread = std::max(sum.spread - sum.mass * dot(shift, shift), 0.0f);
  return sum;
}

Moments joined(const Moments& a, const Moments& b) {
  const float mass = a.mass + b.mass, share = b.mass / mass;
  const Vec3 apart = b.centre - a.centre;
  return {mass, a.centre + apart * share, a.spread + b.spread + a.mass * share * dot(apart, apart),
          a.fourth + b.fourth};
}

// The largest second derivative of cos / d^2 is 6 / d^4; half of all key points face away, and the mean
// square of cos over the other half is 1/3, so that half of 6 * spread / d^4 becomes 1.2 * spread / d^4, root
// mean square. Nearer than three times the extent the series has no meaning. The extent softens the horizon
// of a node.
MassNode node_of(const Moments& m, float error) {
  const float inverse = 1 / m.mass, variance = m.spread * inverse, radius_squared = m.fourth * inverse;
  const float reach = std::max(std::sqrt(1.2f * m.spread / error), 9 * variance);
  const float core = float(NOOK_KERNEL_CORE) * radius_squared;
  return {{m.centre.x, m.centre.y, m.centre.z, radius_squared + 0.1f * variance, core, 0.75f * m.mass},
          reach + core};
}

}  // namespace

SphereTree::SphereTree(const CharacterModel& model, Memory* memory) {
  const auto count = static_cast<std::uint32_t>(model.spheres.size());
  if (model.kernel.form != KernelForm::nook || model.kernel.gamma != 1 || count == 0 ||
      count > PosedSphereTree::max_spheres)
    return;
  order_ = AlignedArray<std::uint32_t>(count, memory);
  for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
  Vector<SphereTreeNode> nodes(memory);
  add_nodes(model, {order_.data(), count}, 0, count, nodes);
  if (nodes.size() > PosedSphereTree::max_nodes) return;
  nodes_ = AlignedArray<SphereTreeNode>(nodes.size(), memory);
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
}

SphereTreeView pose_tree(const SphereTree& tree, const SphereSoa& spheres, float error,
                         PosedSphereTree& out) {
  for (std::uint32_t i = 0; i < tree.order().size(); ++i) {
    const std::uint32_t s = tree.order()[i];
    const float squared = 1 / (spheres.inverse_radius[s] * spheres.inverse_radius[s]);
    out.spheres[i] = {spheres.x[s],   spheres.y[s], spheres.z[s], squared, float(NOOK_KERNEL_CORE) * squared,
                      0.75f * squared};
  }
  const SphereTreeNode* const nodes = tree.nodes().data();
  const auto count = static_cast<std::uint32_t>(tree.nodes().size());
  Moments moments[PosedSphereTree::max_nodes];
  for (std::uint32_t n = count; n-- > 0;) {
    const SphereTreeNode& node = nodes[n];
    const bool is_leaf = node.next == n + 1;
    moments[n] = is_leaf ? moments_of({out.spheres + node.begin, out.spheres + node.end})
                         : joined(moments[n + 1], moments[nodes[n + 1].next]);
    out.nodes[n] = node_of(moments[n], error / 8);
  }
  return {nodes, count, out.spheres, out.nodes};
}

}  // namespace nook
