#include "bakers/character/clip_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/character/clip_set.h"

namespace nook::bake {
namespace {

// Blocks of fixed size give the same bits on any number of threads.
constexpr Eigen::Index block = 256;

template <class Body>
void for_blocks(Eigen::Index count, const Body& body) {
  tbb::parallel_for(Eigen::Index(0), (count + block - 1) / block,
                    [&](Eigen::Index b) { body(b * block, std::min(block, count - b * block)); });
}

// values * x
Eigen::MatrixXf product(const Eigen::MatrixXf& values, const Eigen::MatrixXf& x) {
  Eigen::MatrixXf out(values.rows(), x.cols());
  for_blocks(values.rows(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleRows(first, count).noalias() = values.middleRows(first, count) * x;
  });
  return out;
}

// values.transpose() * x
Eigen::MatrixXf transposed_product(const Eigen::MatrixXf& values, const Eigen::MatrixXf& x) {
  Eigen::MatrixXf out(values.cols(), x.cols());
  for_blocks(values.cols(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleRows(first, count).noalias() = values.middleCols(first, count).transpose() * x;
  });
  return out;
}

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
  return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

}  // namespace

LowRank factorise(const Eigen::MatrixXf& values, std::size_t count, std::uint64_t seed) {
  // The iteration uses more vectors than it keeps, so that the last kept modes converge in these rounds.
  constexpr Eigen::Index spare = 16;
  constexpr int rounds = 3;
  const Eigen::Index smaller = std::min(values.rows(), values.cols());
  const Eigen::Index kept = std::min(Eigen::Index(count), smaller), used = std::min(kept + spare, smaller);
  Random random(seed);
  Eigen::MatrixXf start(values.cols(), used);
  for (Eigen::Index c = 0; c < used; ++c)
    for (Eigen::Index r = 0; r < start.rows(); ++r) start(r, c) = random.normal();
  Eigen::MatrixXf basis = orthonormal(product(values, start));
  for (int round = 0; round < rounds; ++round)
    basis = orthonormal(product(values, orthonormal(transposed_product(values, basis))));
  const Eigen::MatrixXf weights = transposed_product(values, basis);

  const Eigen::MatrixXd wide = weights.cast<double>();
  const SymmetricEigen eigen = symmetric_eigen(wide.transpose() * wide);
  const Eigen::MatrixXf turn = eigen.vectors.rowwise().reverse().leftCols(kept).cast<float>();
  LowRank result;
  result.modes = basis * turn;
  result.weights = weights * turn;
  for (Eigen::Index k = 0; k < kept; ++k) result.removed.push_back(std::max(eigen.values[used - 1 - k], 0.0));
  for (Eigen::Index c = 0; c < values.cols(); ++c) result.total += values.col(c).cast<double>().squaredNorm();
  return result;
}

Eigen::MatrixXf fitted_weights(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes) {
  const Eigen::MatrixXd wide = modes.cast<double>();
  Eigen::MatrixXd gram = wide.transpose() * wide;
  // If the matrix has a lower rank, the remaining modes and their weights are zero.
  gram.diagonal().array() += 1e-9 * gram.trace() / double(gram.rows()) + 1e-30;
  const Eigen::MatrixXd right = transposed_product(values, modes).cast<double>();
  return gram.ldlt().solve(right.transpose()).transpose().cast<float>();
}

Eigen::MatrixXf outer_product(const Eigen::MatrixXf& left, const Eigen::MatrixXf& right) {
  Eigen::MatrixXf out(left.rows(), right.rows());
  for_blocks(right.rows(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleCols(first, count).noalias() = left * right.middleRows(first, count).transpose();
  });
  return out;
}

namespace {

std::uint32_t frame_count_of(const Clip& clip, double frames_per_second) {
  if (!(clip.duration_s > 0)) return 1;
  return std::uint32_t(std::max(2.0, std::round(double(clip.duration_s) * frames_per_second) + 1));
}

float time_of(const Clip& clip, std::uint32_t frames, double frame) {
  return frames > 1 ? float(double(clip.duration_s) * frame / double(frames - 1)) : 0.0f;
}

// Rounds the modes to the number type of a table, and then fits the weights again to the rounded modes.
template <class Number>
FrameTable<Number> rounded(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes) {
  FrameTable<Number> table;
  table.rows = std::uint32_t(modes.rows());
  table.modes = std::uint32_t(modes.cols());
  table.mode.reserve(std::size_t(modes.size()));
  Eigen::MatrixXf stored(modes.rows(), modes.cols());
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    const float largest = modes.col(k).cwiseAbs().maxCoeff();
    for (Eigen::Index r = 0; r < modes.rows(); ++r) {
      const float number =
          largest > 0 ? std::round(modes(r, k) / largest * FrameTable<Number>::max_mode) : 0.0f;
      table.mode.push_back(Number(number));
      stored(r, k) = number / FrameTable<Number>::max_mode;
    }
  }
  const Eigen::MatrixXf weights = fitted_weights(values, stored);
  for (Eigen::Index k = 0; k < weights.cols(); ++k)
    table.scale.push_back(weights.col(k).cwiseAbs().maxCoeff());
  table.weight.reserve(std::size_t(weights.size()));
  for (Eigen::Index f = 0; f < weights.rows(); ++f)
    for (Eigen::Index k = 0; k < weights.cols(); ++k) {
      const float scale = table.scale[std::size_t(k)];
      table.weight.push_back(std::int16_t(
          scale > 0 ? std::round(weights(f, k) / scale * FrameTable<Number>::max_weight) : 0.0f));
    }
  return table;
}

// Returns the values of a table, rows x frames.
template <class Number>
Eigen::MatrixXf value_of(const FrameTable<Number>& table, std::size_t frames) {
  Eigen::MatrixXf modes(Eigen::Index(table.rows), Eigen::Index(table.modes)),
      weights(Eigen::Index(frames), Eigen::Index(table.modes));
  for (std::size_t k = 0; k < table.modes; ++k) {
    for (std::size_t r = 0; r < table.rows; ++r)
      modes(Eigen::Index(r), Eigen::Index(k)) =
          float(table.mode[k * table.rows + r]) / FrameTable<Number>::max_mode;
    for (std::size_t f = 0; f < frames; ++f)
      weights(Eigen::Index(f), Eigen::Index(k)) = table.frame_weight(f, k);
  }
  return outer_product(modes, weights);
}

// For each bone, returns the mean position of its points, and a radius. The radius is the rms distance of the
// points from the mean, divided by sqrt(3). An error of the bone's rotation moves a point at this radius as
// far as it moves the bone's points on average.
std::vector<BoneSpan> bone_spans(const SkinnedMesh& mesh) {
  // In metres, for bones without vertices and for bones whose vertices are all at one position.
  constexpr float least_radius = 0.02f;
  const std::size_t bones = mesh.bones.size();
  std::vector<double> weight(bones, 0), square(bones, 0);
  std::vector<Vec3> sum(bones);
  const auto visit = [&](auto&& body) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      for (int s = 0; s < SkinWeights::max_bones; ++s)
        if (mesh.weights[i].weight[s] > 0)
          body(mesh.weights[i].bone[s], mesh.weights[i].weight[s], mesh.position[i]);
  };
  visit([&](std::size_t bone, float share, Vec3 place) {
    weight[bone] += double(share);
    sum[bone] += share * place;
  });
  std::vector<BoneSpan> spans(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    const Mat3x4& frame = mesh.bones[b].frame_rest;
    spans[b].centre =
        weight[b] > 0 ? sum[b] * float(1 / weight[b]) : Vec3{frame.m[3], frame.m[7], frame.m[11]};
  }
  visit([&](std::size_t bone, float share, Vec3 place) {
    const Vec3 d = place - spans[bone].centre;
    square[bone] += double(share) * double(dot(d, d));
  });
  for (std::size_t b = 0; b < bones; ++b)
    spans[b].radius =
        std::max(weight[b] > 0 ? float(std::sqrt(square[b] / weight[b] / 3)) : 0.0f, least_radius);
  return spans;
}

Eigen::MatrixXf pose_values(std::span<const BoneSpan> spans, std::span<const Pose> poses) {
  Eigen::MatrixXf values(Eigen::Index(spans.size() * pose_rows_per_bone), Eigen::Index(poses.size()));
  for (std::size_t f = 0; f < poses.size(); ++f) {
    Eigen::Index row = 0;
    for (std::size_t b = 0; b < spans.size(); ++b) {
      const Mat3x4& matrix = poses[f][b];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) values(row++, Eigen::Index(f)) = spans[b].radius * matrix.m[4 * i + j];
      const Vec3 centre = transform_point(matrix, spans[b].centre);
      for (const float coordinate : {centre.x, centre.y, centre.z})
        values(row++, Eigen::Index(f)) = coordinate;
    }
  }
  return values;
}

Eigen::MatrixXf ao_values(const AoTargets& targets) {
  Eigen::MatrixXf values(Eigen::Index(targets.vertex_count), Eigen::Index(targets.pose_count()));
  for (std::size_t f = 0; f < targets.pose_count(); ++f)
    for (std::size_t i = 0; i < targets.vertex_count; ++i)
      values(Eigen::Index(i), Eigen::Index(f)) = float(targets.row(f)[i]) * AoTargets::scale - 0.5f;
  return values;
}

// Where a target is black or fully open and the product lies beyond it, replaces the target by the product.
// The runtime clamps the result, so the product has no error there.
void relax(const Eigen::MatrixXf& values, const Eigen::MatrixXf& product, Eigen::MatrixXf& relaxed) {
  tbb::parallel_for(Eigen::Index(0), values.cols(), [&](Eigen::Index f) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const float value = values(i, f), said = product(i, f);
      const bool is_beyond = (value <= -0.5f && said < value) || (value >= 0.5f && said > value);
      relaxed(i, f) = is_beyond ? said : value;
    }
  });
}

double clamped_mse(const Eigen::MatrixXf& values, const Eigen::MatrixXf& product) {
  double sum = 0;
  for (Eigen::Index f = 0; f < values.cols(); ++f)
    sum += double((product.col(f).cwiseMax(-0.5f).cwiseMin(0.5f) - values.col(f)).squaredNorm());
  return sum / double(values.size());
}

// Estimates the mse of the product against the noise-free values. A fit of `count` modes also fits a part of
// the noise, in proportion to the number of its free parameters.
double true_mse(double residual_mse, double noise_mse, std::size_t count, double rows, double columns) {
  const double k = double(count), taken = std::min(k * (rows + columns - k) / (rows * columns), 1.0);
  return std::max(residual_mse - noise_mse * (1 - 2 * taken), 0.0);
}

// Returns the smallest multiple of `step` modes with an error of at most `max_mse`. If no number of modes
// reaches max_mse, returns the one with the smallest error, because more modes would only fit noise.
std::size_t modes_for(const LowRank& low, double size, double max_mse, double noise_mse, std::size_t step,
                      double rows, double columns, std::vector<double>* curve) {
  double left = low.total;
  double best_mse = INFINITY;
  std::size_t found = 0, best = low.removed.size();
  for (std::size_t k = 1; k <= low.removed.size(); ++k) {
    left = std::max(left - low.removed[k - 1], 0.0);
    if (k % step != 0) continue;
    const double mse = true_mse(left / size, noise_mse, k, rows, columns);
    if (curve) curve->push_back(std::sqrt(mse));
    if (found == 0 && mse <= max_mse) found = k;
    if (mse < best_mse) {
      best_mse = mse;
      best = k;
    }
  }
  return found ? found : best;
}

// Returns how many modes fit into a number of bytes. A mode has a scale, a weight per frame and a value per
// row.
std::size_t affordable(double bytes, double frames, double rows, double number_bytes) {
  const double each = 4 + 2 * frames + number_bytes * rows;
  return std::size_t(std::max(bytes / each, 0.0));
}

// Adds modes of zeros up to a multiple of four.
void pad_modes(FrameTable<std::int8_t>& table, std::size_t frames) {
  const std::uint32_t padded = (table.modes + 3) / 4 * 4;
  if (padded == table.modes) return;
  Vector<std::int16_t> weight;
  for (std::size_t f = 0; f < frames; ++f)
    for (std::uint32_t k = 0; k < padded; ++k)
      weight.push_back(k < table.modes ? table.weight[f * table.modes + k] : std::int16_t(0));
  table.weight = std::move(weight);
  table.mode.resize(std::size_t(padded) * table.rows, 0);
  table.scale.resize(padded, 0.0f);
  table.modes = padded;
}

}  // namespace

ClipFrames clip_frames(const ImportedCharacter& character, std::span<const std::size_t> clips,
                       double frames_per_second) {
  ClipFrames frames;
  for (const std::size_t index : clips) {
    const Clip& clip = character.clips[index];
    ClipRange& range = frames.clips.emplace_back();
    range.name = clip.name;
    range.duration_s = clip.duration_s;
    range.first_frame = std::uint32_t(frames.poses.size());
    range.frame_count = frame_count_of(clip, frames_per_second);
    for (std::uint32_t i = 0; i < range.frame_count; ++i)
      frames.poses.push_back(sample_clip(character, index, time_of(clip, range.frame_count, i)));
  }
  return frames;
}

ClipSet make_clip_set(const SkinnedMesh& mesh, const CharacterModel& model, const ClipFrames& frames,
                      const AoTargets& targets, double noise_mse, const ClipTableSettings& settings,
                      ClipTableReport& report) {
  ClipSet set;
  set.clips.assign(frames.clips.begin(), frames.clips.end());
  set.frame_count = std::uint32_t(frames.poses.size());
  set.model_hash = clip_model_hash(model);
  const double vertices = double(mesh.vertex_count()), count = double(set.frame_count);

  const std::vector<BoneSpan> spans = bone_spans(mesh);
  set.bones.assign(spans.begin(), spans.end());
  const double rows = double(spans.size() * pose_rows_per_bone);
  // Subtracts the bytes of the header, names, bones and container. The pose table gets at most half of the
  // rest.
  double budget = settings.max_bytes * vertices * count - 400 - 16 * double(spans.size());
  for (const ClipRange& clip : frames.clips) budget -= double(clip.name.size() + 8);
  const Eigen::MatrixXf poses = pose_values(spans, frames.poses);
  LowRank low = factorise(poses, ClipSet::max_pose_modes, settings.seed);
  const std::size_t pose_modes = std::clamp<std::size_t>(
      modes_for(low, double(spans.size()) * count, settings.max_pose_error * settings.max_pose_error, 0, 1,
                rows, count, nullptr),
      1, std::max<std::size_t>(affordable(budget / 2, count, rows, 2), 1));
  set.pose = rounded<std::int16_t>(poses, low.modes.leftCols(Eigen::Index(pose_modes)));
  report.pose_error = std::sqrt(double((value_of(set.pose, frames.poses.size()) - poses).squaredNorm()) /
                                (double(spans.size()) * count));
  budget -= double(pose_modes) * (4 + 2 * count + 2 * rows);

  const Eigen::MatrixXf values = ao_values(targets);
  const std::size_t most = std::max<std::size_t>(
      4, std::min<std::size_t>(settings.max_modes, affordable(budget, count, vertices, 1)) / 4 * 4);
  low = factorise(values, std::max<std::size_t>(most, settings.max_modes), settings.seed + 1);
  const std::size_t modes =
      std::min(most, modes_for(low, vertices * count, settings.max_error * settings.max_error, noise_mse, 4,
                               vertices, count, &report.error_of_modes));
  // In each round, targets of black vertices may fall below black, and targets of open vertices may rise
  // above open. The modes then describe only visible differences.
  constexpr int relaxations = 3;
  Eigen::MatrixXf relaxed = values;
  for (int round = 0; round < relaxations; ++round) {
    relax(values,
          outer_product(low.modes.leftCols(Eigen::Index(std::min(modes, low.removed.size()))),
                        low.weights.leftCols(Eigen::Index(std::min(modes, low.removed.size())))),
          relaxed);
    low = factorise(relaxed, modes, settings.seed + 2 + std::uint64_t(round));
  }
  set.ao = rounded<std::int8_t>(relaxed, low.modes);
  pad_modes(set.ao, frames.poses.size());
  report.error = std::sqrt(true_mse(clamped_mse(values, value_of(set.ao, frames.poses.size())), noise_mse,
                                    set.ao.modes, vertices, count));
  return set;
}

}  // namespace nook::bake
