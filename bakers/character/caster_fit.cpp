#include "bakers/character/caster_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file_packing.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

struct Point {
  Vec3 position, normal;
};

// A direction spread evenly over the sphere from two uniform numbers.
Vec3 sphere_direction(float u, float v) {
  const float z = 2 * u - 1, r = std::sqrt(std::max(0.0f, 1 - z * z)), a = 2 * std::numbers::pi_v<float> * v;
  return {r * std::cos(a), r * std::sin(a), z};
}

std::vector<Point> points_round(Vec3 centre, float radius, std::size_t count, std::uint64_t seed) {
  std::vector<Point> points(count);
  Random random(seed);
  for (Point& p : points) {
    // Even in the logarithm of the distance: every scale counts alike.
    const float distance = radius * 0.3f * std::pow(8 / 0.3f, random.unit());
    const float u = random.unit(), v = random.unit();
    p.position = centre + distance * sphere_direction(u, v);
    const float s = random.unit(), t = random.unit();
    p.normal = sphere_direction(s, t);
    // Half of the normals look at the body, where occlusion is.
    if (dot(p.normal, centre - p.position) < 0) p.normal = -p.normal;
  }
  return points;
}

// In front of random vertices, 0.03 to 0.5 body radii away, turned towards the surface.
std::vector<Point> points_near(const SkinnedMesh& mesh, std::span<const Vec3> position, float radius,
                               std::size_t count, std::uint64_t seed) {
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, position, normal);
  std::vector<Point> points(count);
  Random random(seed);
  for (Point& p : points) {
    const std::uint32_t vertex = random.below(std::uint32_t(position.size()));
    p.position = position[vertex] + radius * random.log_between(0.03f, 0.5f) * normal[vertex];
    const float u = random.unit(), v = random.unit();
    p.normal = sphere_direction(u, v);
    if (dot(p.normal, normal[vertex]) > 0) p.normal = -p.normal;
  }
  return points;
}

std::vector<Point> fit_points(const SkinnedMesh& mesh, std::span<const Vec3> position, Vec3 centre,
                              float radius, const CasterFitSettings& settings, std::uint64_t seed) {
  const std::size_t near = settings.points_per_pose / 10;
  std::vector<Point> points = points_round(centre, radius, settings.points_per_pose - near, seed);
  const std::vector<Point> others = points_near(mesh, position, radius, near, ~seed);
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

// The sum over spheres whose solid_depth is `depth`.
double sum_of_solid_depth(double depth) {
  constexpr double c = NOOK_SOLID_DEPTH;
  return (std::sqrt(1 + 4 * c * depth) - 1) / (2 * c);
}

}  // namespace

void fit_caster_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                        const CasterFitSettings& settings,
                        const std::function<bool(std::size_t, std::size_t)>& progress) {
  const std::size_t spheres = model.spheres.size(), used = std::min(settings.poses, poses.size());
  const auto n = Eigen::Index(spheres);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  TriangleSoup body;
  body.triangle = mesh.triangle;
  double equations = 0;
  for (std::size_t s = 0; s < used; ++s) {
    if (progress && !progress(s, used))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while fitting casters");
    const Pose& pose = poses[s * poses.size() / used];
    skin_positions(mesh, pose, body.position);
    const Vec3 centre = transform_point(pose[model.root_bone], model.bounding_centre);
    const std::vector<Point> points =
        fit_points(mesh, body.position, centre, model.bounding_radius, settings, settings.seed + s);
    std::vector<Vec3> position, normal;
    for (const Point& p : points) {
      position.push_back(p.position);
      normal.push_back(p.normal);
    }
    const AoSettings rays{settings.rays, settings.seed + 977 * s};
    const std::vector<float> ao = trace_ao(body, {position, normal}, rays);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::VectorXd row(n);
      for (std::size_t h = 0; h < spheres; ++h) {
        const ProxySphere& sphere = model.spheres[h];
        const float inverse_radius = 1 / sphere.radius;
        const Vec3 d =
            (transform_point(pose[sphere.bone], sphere.centre) - points[i].position) * inverse_radius;
        row[Eigen::Index(h)] = double(form_factor_fast(dot(d, points[i].normal), dot(d, d)));
      }
      // Points inside the body see nothing and say nothing about it from outside.
      const double occlusion = 1 - double(ao[i]);
      if (occlusion > 0.97) continue;
      const double depth = sum_of_solid_depth(-std::log1p(-occlusion));
      // The expected depth, not the noisy traced one, sets the weight, or lucky rays would count more.
      const double expected = std::max(row.sum() * 0.5, 1e-4);
      const double weight = 1 / ((expected + 0.003) * (expected + 0.003));
      gram += weight * row * row.transpose();
      right += weight * depth * row;
      ++equations;
    }
  }
  if (equations == 0) return;
  // Pulled a little towards one common factor, so that spheres which always act together share evenly.
  const double common = std::max(0.0, right.sum() / std::max(gram.sum(), 1e-30));
  const double pull = 1e-3 * gram.trace() / double(spheres);
  gram.diagonal().array() += pull;
  right.array() += pull * common;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(n, common);
  for (int sweep = 0; sweep < 400; ++sweep)
    for (Eigen::Index h = 0; h < n; ++h)
      weight[h] = std::clamp(weight[h] + (right[h] - gram.row(h).dot(weight)) / gram(h, h), 0.0,
                             double(max_coefficient));
  for (std::size_t h = 0; h < spheres; ++h) model.spheres[h].caster_weight = float(weight[Eigen::Index(h)]);
}

namespace {

// Against ray tracing of a body on the ground with neighbours, the error is flat from 0.001 to 0.01 for the
// ridge and from 0 to 2 per square metre for the positions.
constexpr double ridge = 3e-3;
constexpr double position_weight_per_m2 = 1;
// Of the spheres. The error of neighbours falls by a fifth with 3, and hardly further with 30.
constexpr double sphere_weight = 10;
constexpr std::size_t spheres_per_pose = 16;
// In radii of the body: from a hand's breadth to where a body is seen under a small angle.
constexpr float nearest_sphere = 0.15f, farthest_sphere = 4, sphere_radius = 0.15f;
// Many times more than a vertex has entries.
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
    vertex_normals(mesh.triangle, position, normal);
    for (std::size_t i = 0; i < position.size(); ++i) bodies[b].vertex.push_back({position[i], normal[i]});
    for (const KeyPoint& point : model.key_points) bodies[b].key_point.push_back(posed_surface(point, pose));
  });
  return bodies;
}

// Normal equations of the weights, sum to one included: (gram, 1; 1, 0) (w, multiplier) = (right, 1).
struct Equations {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
};

struct TestSphere {
  Vec3 centre;
  float radius = 0;
  double weight = 0;

  // Of the hemisphere above a place, clipped at its horizon.
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

// Adds the spheres round a vertex of one pose. `share` has room for its key points.
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
      // Positions relative to the vertex: those of a sum of weights 1 then ought to vanish.
      const Vec3 away = f.position - own.position;
      rows.col(k) << double(f.normal.x), double(f.normal.y), double(f.normal.z), c * double(away.x),
          c * double(away.y), c * double(away.z);
    }
    Eigen::Matrix<double, 6, 1> wanted;
    wanted << double(own.normal.x), double(own.normal.y), double(own.normal.z), 0, 0, 0;
    e.gram += rows.transpose() * rows;
    e.right += rows.transpose() * wanted;
    // The same spheres for all vertices of a pose, as seen from each, so that those side by side blend alike.
    Random random(b);
    add_spheres(e, body, vertex, key_point, body_radius, random, share);
  }
  e.gram /= double(bodies.size());
  e.right /= double(bodies.size());
  e.gram.diagonal().array() += ridge;
  return e;
}

// The first `free` weights, the others as they are.
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
  // All others are whole steps, so this one is as well.
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
