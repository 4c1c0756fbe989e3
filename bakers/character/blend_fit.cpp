#include "bakers/character/blend_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>

#include "bakers/import/skinning.h"
#include "sdk/src/character/model_file_packing.h"

namespace nook::bake {
namespace {

// Against ray tracing of a body on the ground with neighbours, the error is flat from 0.001 to 0.01 for the
// ridge and from 0 to 2 per square metre for the positions.
constexpr double ridge = 3e-3;
constexpr double position_weight_per_m2 = 1;
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

Equations equations_of(const std::vector<PosedBody>& bodies, std::size_t vertex,
                       std::span<const std::uint16_t> key_point) {
  const auto n = Eigen::Index(key_point.size());
  Equations e{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows(6, n);
  const double c = std::sqrt(position_weight_per_m2);
  for (const PosedBody& body : bodies) {
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
    const Eigen::VectorXd weight = rounded_weights(equations_of(bodies, i, key_point));
    for (std::size_t k = 0; k < entry.size(); ++k) model.blend[entry[k]] = float(weight[Eigen::Index(k)]);
  });
}

}  // namespace nook::bake
