#include "sdk/src/character/sphere_tree.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nook {
namespace {

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

// Returns the number of the node or sphere that holds all of them.
std::uint16_t add_nodes(const CharacterModel& model, Spheres all, std::uint32_t begin, std::uint32_t end,
                        Vector<SphereTreeNode>& nodes) {
  const std::size_t first_sphere = all.size() - 1;  // one node less than spheres
  if (end - begin == 1) return static_cast<std::uint16_t>(first_sphere + begin);
  const std::size_t own = nodes.size();
  nodes.emplace_back();
  const std::uint32_t middle = begin + split(model, all.subspan(begin, end - begin));
  SphereTreeNode node;
  node.half[0] = add_nodes(model, all, begin, middle, nodes);
  node.half[1] = add_nodes(model, all, middle, end, nodes);
  nodes[own] = node;
  return static_cast<std::uint16_t>(own);
}

// Sums over the spheres of a node, or of one sphere.
struct Moments {
  float mass = 0;    // square metres: the sum of squared radii
  Vec3 centre;       // by mass
  float spread = 0;  // metres^4: sum of mass * (distance from the centre)^2
  float fourth = 0;  // metres^4: sum of mass * radius^2
};

Moments joined(const Moments& a, const Moments& b) {
  const float mass = a.mass + b.mass, share = b.mass / mass;
  const Vec3 apart = b.centre - a.centre;
  return {mass, a.centre + apart * share, a.spread + b.spread + a.mass * share * dot(apart, apart),
          a.fourth + b.fourth};
}

// Spheres that spread by sigma along the normal are, around the horizon, on average sigma / sqrt(2 pi) above
// it, as one whose horizon is softened by 4 sigma^2 / (2 pi); sigma^2 is a third of the variance.
constexpr float softness_of_variance = 0.21f;

void put_mass(const Moments& m, std::uint32_t i, PosedSphereTree& out) {
  const float inverse = 1 / m.mass, variance = m.spread * inverse, radius_squared = m.fourth * inverse;
  out.x[i] = m.centre.x;
  out.y[i] = m.centre.y;
  out.z[i] = m.centre.z;
  out.softness[i] = radius_squared + softness_of_variance * variance;
  out.core[i] = float(NOOK_KERNEL_CORE) * radius_squared;
  out.mass[i] = 0.75f * m.mass;
}

// The largest second derivative of cos / d^2 is 6 / d^4; half of all key points face away, and the mean
// square of cos over the other half is 1/3, so that half of 6 * spread / d^4 becomes 1.2 * spread / d^4, root
// mean square. Nearer than three times the extent the series has no meaning.
float reach_of(const Moments& m, float error) {
  return std::max(std::sqrt(1.2f * m.spread / error), 9 * m.spread / m.mass);
}

}  // namespace

SphereTree::SphereTree(const CharacterModel& model, Memory* memory) {
  const auto count = static_cast<std::uint32_t>(model.spheres.size());
  if (model.kernel.form != KernelForm::nook || model.kernel.gamma != 1 || count < 2 ||
      count > PosedSphereTree::max_spheres)
    return;
  order_ = AlignedArray<std::uint32_t>(count, memory);
  for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
  Vector<SphereTreeNode> nodes(memory);
  add_nodes(model, {order_.data(), count}, 0, count, nodes);
  nodes_ = AlignedArray<SphereTreeNode>(nodes.size(), memory);
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
}

SphereTreeView pose_tree(const SphereTree& tree, const SphereSoa& spheres, float error,
                         PosedSphereTree& out) {
  const auto nodes = static_cast<std::uint32_t>(tree.nodes().size()),
             count = static_cast<std::uint32_t>(tree.order().size());
  Moments moments[PosedSphereTree::max_masses];
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t s = tree.order()[i];
    const float squared = 1 / (spheres.inverse_radius[s] * spheres.inverse_radius[s]);
    moments[nodes + i] = {squared, {spheres.x[s], spheres.y[s], spheres.z[s]}, 0, squared * squared};
    put_mass(moments[nodes + i], nodes + i, out);
  }
  for (std::uint32_t n = nodes; n-- > 0;) {
    const SphereTreeNode& node = tree.nodes()[n];
    moments[n] = joined(moments[node.half[0]], moments[node.half[1]]);
    put_mass(moments[n], n, out);
    out.reach[n] = reach_of(moments[n], error / 2);
  }
  return {tree.nodes().data(), nodes, &out};
}

}  // namespace nook
