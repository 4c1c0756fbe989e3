#include "bakers/character/blend_weights.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/import/posed_normals.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/model_file_packing.h"

namespace nook::bake {
namespace {

// The error against ray tracing is nearly the same for any ridge from 0.001 to 0.01, and for any position
// weight from 0 to 2 per square metre. The test was a body on the ground with neighbours.
constexpr double ridge = 3e-3;
constexpr double position_weight_per_m2 = 1;
// The weight of the spheres in the loss. A weight of 3 lowers the error of the AO from neighbours by a fifth.
// A weight of 30 lowers it hardly any further.
constexpr double sphere_weight = 10;
constexpr std::size_t spheres_per_pose = 16;
// Lengths are in radii of the body. The nearest spheres are about a hand's width away. The farthest spheres
// are so far away that the body looks small from there.
constexpr float nearest_sphere = 0.15f, farthest_sphere = 4, sphere_radius = 0.15f;
// Many times the number of entries per vertex, so that the poses determine the weights well.
constexpr std::size_t max_poses = 64;

struct Frame {
  Vec3 position, normal;
};

Frame posed_surface(const KeyPoint& point, const Pose& pose) {
  Frame frame;
  for (int b = 0; b < KeyPoint::max_bones; ++b) {
    const Mat3x4& bone = pose[point.bone[b]];
    frame.position += transform_point(bone, point.surface_position) * point.weight[b];
    frame.normal += transform_vector(bone, point.surface_normal) * point.weight[b];
  }
  frame.normal = normalised(frame.normal);
  return frame;
}

struct PosedBody {
  std::vector<Frame> vertex, key_point;
};

std::vector<PosedBody> posed_bodies(const CharacterModel& model, const SkinnedMesh& mesh,
                                    std::span<const Pose> poses) {
  std::vector<PosedBody> bodies(std::min(max_poses, poses.size()));
  tbb::parallel_for(std::size_t(0), bodies.size(), [&](std::size_t b) {
    const Pose& pose = poses[b * poses.size() / bodies.size()];
    std::vector<Vec3> position, normal;
    skin_positions(mesh, pose, position);
    posed_normals(mesh, pose, position, normal);
    for (std::size_t i = 0; i < position.size(); ++i) bodies[b].vertex.push_back({position[i], normal[i]});
    for (const KeyPoint& point : model.key_points) bodies[b].key_point.push_back(posed_surface(point, pose));
  });
  return bodies;
}

// Normal equations of the weights. They include the constraint that the weights sum to 1: (gram, 1; 1, 0) (w,
// multiplier) = (right, 1).
struct Equations {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
};

struct TestSphere {
  Vec3 centre;
  float radius = 0;
  double weight = 0;

  // Returns the share of a surface point's hemisphere that the sphere covers, clipped at the horizon.
  double share(const Frame& frame) const {
    const Vec3 d = (centre - frame.position) * (1 / radius);
    return double(form_factor_exact(dot(d, frame.normal), dot(d, d)));
  }
};

TestSphere random_sphere(Random& random, Vec3 vertex, float body_radius) {
  const float z = random.between(-1, 1), turn = random.between(0, 2 * std::numbers::pi_v<float>);
  const float across = std::sqrt(1 - z * z);
  const float distance = body_radius * random.log_between(nearest_sphere, farthest_sphere);
  TestSphere sphere;
  sphere.centre = vertex + distance * Vec3{across * std::cos(turn), across * std::sin(turn), z};
  sphere.radius = std::min(sphere_radius * body_radius, 0.7f * distance);
  sphere.weight = std::pow(double(distance / sphere.radius), 4.0);
  return sphere;
}

// Adds the spheres around a vertex in one pose. `share` has room for the vertex's key points.
void add_spheres(Equations& e, const PosedBody& body, std::size_t vertex,
                 std::span<const std::uint16_t> key_point, float body_radius, Random& random,
                 Eigen::VectorXd& share) {
  const Frame& own = body.vertex[vertex];
  for (std::size_t s = 0; s < spheres_per_pose; ++s) {
    const TestSphere sphere = random_sphere(random, own.position, body_radius);
    for (std::size_t k = 0; k < key_point.size(); ++k)
      share[Eigen::Index(k)] = sphere.share(body.key_point[key_point[k]]);
    const double weight = sphere_weight / double(spheres_per_pose) * sphere.weight;
    e.gram.noalias() += weight * share * share.transpose();
    e.right += weight * sphere.share(own) * share;
  }
}

Equations equations_of(const std::vector<PosedBody>& bodies, std::size_t vertex,
                       std::span<const std::uint16_t> key_point, float body_radius) {
  const auto n = Eigen::Index(key_point.size());
  Equations e{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows(6, n);
  Eigen::VectorXd share(n);
  const double c = std::sqrt(position_weight_per_m2);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const PosedBody& body = bodies[b];
    const Frame& own = body.vertex[vertex];
    for (Eigen::Index k = 0; k < n; ++k) {
      const Frame& f = body.key_point[key_point[std::size_t(k)]];
      // Positions are relative to the vertex. So the weighted sum should be 0 if the weights sum to 1.
      const Vec3 away = f.position - own.position;
      rows.col(k) << double(f.normal.x), double(f.normal.y), double(f.normal.z), c * double(away.x),
          c * double(away.y), c * double(away.z);
    }
    Eigen::Matrix<double, 6, 1> wanted;
    wanted << double(own.normal.x), double(own.normal.y), double(own.normal.z), 0, 0, 0;
    e.gram += rows.transpose() * rows;
    e.right += rows.transpose() * wanted;
    // In one pose, the spheres have the same offsets from every vertex. This gives neighbouring vertices
    // similar weights.
    Random random(b);
    add_spheres(e, body, vertex, key_point, body_radius, random, share);
  }
  e.gram /= double(bodies.size());
  e.right /= double(bodies.size());
  e.gram.diagonal().array() += ridge;
  return e;
}

// Solves for the first `free` weights. Does not change the other weights.
void solve_free(const Equations& e, Eigen::Index free, Eigen::VectorXd& weight) {
  const Eigen::Index fixed = weight.size() - free;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(free + 1, free + 1);
  system.topLeftCorner(free, free) = e.gram.topLeftCorner(free, free);
  system.col(free).head(free).setOnes();
  system.row(free).head(free).setOnes();
  Eigen::VectorXd right(free + 1);
  right.head(free) = e.right.head(free) - e.gram.topRightCorner(free, fixed) * weight.tail(fixed);
  right[free] = 1 - weight.tail(fixed).sum();
  weight.head(free) = system.partialPivLu().solve(right).head(free);
}

Eigen::VectorXd rounded_weights(const Equations& e) {
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(e.right.size());
  for (Eigen::Index free = weight.size(); free > 0; --free) {
    solve_free(e, free, weight);
    weight[free - 1] = double(decode_blend(encode_blend(float(weight[free - 1]))));
  }
  // All other weights are multiples of the quantisation step, so this weight is a multiple too.
  weight[0] = 1 - weight.tail(weight.size() - 1).sum();
  return weight;
}

}  // namespace

void fit_blend_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses) {
  const std::vector<PosedBody> bodies = posed_bodies(model, mesh, poses);
  model.blend.assign(model.alpha.size(), 0.0f);
  tbb::parallel_for(std::size_t(0), model.vertex_count(), [&](std::size_t i) {
    std::vector<std::size_t> entry;
    std::vector<std::uint16_t> key_point;
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) {
      if (model.alpha[e] == 0) continue;
      entry.push_back(e);
      key_point.push_back(model.influence[e]);
    }
    const Eigen::VectorXd weight = rounded_weights(equations_of(bodies, i, key_point, model.bounding_radius));
    for (std::size_t k = 0; k < entry.size(); ++k) model.blend[entry[k]] = float(weight[Eigen::Index(k)]);
  });
}

}  // namespace nook::bake
