#include "sdk/src/character/sphere_tree.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nook {
namespace {

// The estimated error of a single node may be this many times the allowed error. The errors of several nodes
// add up, but the linear layer averages them over key points. On baked bodies, the resulting rms error of AO
// is 0.8 to 1.0 times the allowed error.
constexpr float share_of_node = 1.4f;

using Spheres = std::span<std::uint32_t>;

float coordinate(const CharacterModel& model, std::uint32_t sphere, int axis) {
  const Vec3& centre = model.spheres[sphere].centre;
  return axis == 0 ? centre.x : axis == 1 ? centre.y : centre.z;
}

// Returns the number of spheres in the first half, which is at least 1 and less than the number of spheres.
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

// Orders the nodes breadth first. Neighbouring nodes then do not depend on each other, so a processor can
// merge several of them in parallel.
Vector<SphereTreeNode> nodes_of(const CharacterModel& model, Spheres all, Memory* memory) {
  struct Range {
    std::uint32_t begin, end;
  };
  const std::size_t first_sphere = all.size() - 1;  // there is one node less than there are spheres
  Vector<SphereTreeNode> nodes(memory);
  Vector<Range> ranges(memory);
  const auto number_of = [&](std::uint32_t begin, std::uint32_t end) {
    if (end - begin == 1) return static_cast<std::uint16_t>(first_sphere + begin);
    ranges.push_back({begin, end});
    return static_cast<std::uint16_t>(ranges.size() - 1);
  };
  number_of(0, static_cast<std::uint32_t>(all.size()));
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    const auto [begin, end] = ranges[n];
    const std::uint32_t middle = begin + split(model, all.subspan(begin, end - begin));
    SphereTreeNode node;
    node.half[0] = number_of(begin, middle);
    node.half[1] = number_of(middle, end);
    nodes.push_back(node);
  }
  return nodes;
}

// Sums over the spheres of a node. For a leaf, these are the values of its single sphere.
struct Moments {
  float mass = 0;    // square metres: the sum of squared radii
  Vec3 centre;       // weighted by mass
  float spread = 0;  // metres^4: sum of mass * (distance from the centre)^2
  float fourth = 0;  // metres^4: sum of mass * radius^2
  float extent = 0;  // metres: the largest distance of any sphere's surface from the centre
};

// `inverse` is 1 / (a.mass + b.mass).
Moments joined(const Moments& a, const Moments& b, float inverse) {
  const float share = b.mass * inverse;
  const Vec3 apart = b.centre - a.centre;
  const float squared = dot(apart, apart), distance = std::sqrt(squared);
  return {a.mass + b.mass, a.centre + apart * share, a.spread + b.spread + a.mass * share * squared,
          a.fourth + b.fourth, std::max(a.extent + distance * share, b.extent + distance * (1 - share))};
}

void put_mass(const Moments& m, std::uint32_t i, float softness, float radius_squared, PosedSphereTree& out) {
  out.x[i] = m.centre.x;
  out.y[i] = m.centre.y;
  out.z[i] = m.centre.z;
  out.softness[i] = softness;
  out.core[i] = float(NOOK_KERNEL_CORE) * radius_squared;
  out.mass[i] = 0.75f * m.mass;
}

// If spheres near the horizon have the standard deviation sigma along the normal, their mean height above the
// horizon, counting those below as 0, is sigma / sqrt(2 pi). A single sphere whose horizon is softened by 4
// sigma^2 / (2 pi) has the same effect. sigma^2 is a third of the variance over all directions.
constexpr float softness_of_variance = 0.21f;

// The largest second derivative of cos / d^2 is 6 / d^4. So the error is at most half of 6 * spread / d^4.
// Half of all key points face away, and the mean square of cos over the other half is 1/3. This gives an RMS
// error of 1.2 * spread / d^4. It equals `error` at the squared distance sqrt(1.2 * spread / error).
//
// Two lower limits apply to the reach. First, at distances below three standard deviations, the series is not
// valid. Second, a key point that is closer than the farthest sphere may lie fully in the shadow of one
// sphere. This sphere may be too small to affect the spread.
void put_node(const Moments& m, std::uint32_t n, float inverse, float inverse_error, PosedSphereTree& out) {
  const float variance = m.spread * inverse, radius_squared = m.fourth * inverse;
  put_mass(m, n, radius_squared + softness_of_variance * variance, radius_squared, out);
  out.reach[n] =
      std::max(std::sqrt(1.2f * inverse_error * m.spread), std::max(9 * variance, m.extent * m.extent));
}

}  // namespace

SphereTree::SphereTree(const CharacterModel& model, Memory* memory) {
  const auto count = static_cast<std::uint32_t>(model.spheres.size());
  if (model.kernel.form != KernelForm::nook || model.kernel.gamma != 1 || count < 2 ||
      count > PosedSphereTree::max_spheres)
    return;
  order_ = AlignedArray<std::uint32_t>(count, memory);
  for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
  const Vector<SphereTreeNode> nodes = nodes_of(model, {order_.data(), count}, memory);
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
    Moments& m = moments[nodes + i];
    m = {squared,
         {spheres.x[s], spheres.y[s], spheres.z[s]},
         0,
         squared * squared,
         1 / spheres.inverse_radius[s]};
    put_mass(m, nodes + i, squared, squared, out);
  }
  const float inverse_error = 1 / (share_of_node * error);
  for (std::uint32_t n = nodes; n-- > 0;) {
    const Moments &a = moments[tree.nodes()[n].half[0]], &b = moments[tree.nodes()[n].half[1]];
    const float inverse = 1 / (a.mass + b.mass);
    moments[n] = joined(a, b, inverse);
    put_node(moments[n], n, inverse, inverse_error, out);
  }
  return {tree.nodes().data(), nodes, &out};
}

}  // namespace nook
