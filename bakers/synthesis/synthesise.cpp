#include "bakers/synthesis/synthesise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::bake::synthesis {
namespace {

using tensor::Matrix;

constexpr Eigen::Index rows_of_task = 256;
// The maximum number of comparisons. It limits the time for large exemplars.
constexpr double max_pairs = 1.5e9;
constexpr Eigen::Index max_candidates = 16384, fewest_candidates = 1024;

Texel texel_of(const ExemplarShape& shape, Eigen::Index row) {
  return {std::int32_t(row % shape.width), std::int32_t(row / shape.width)};
}

Matrix surroundings(const Matrix& appearance, const ExemplarShape& shape, std::int32_t spacing) {
  const Eigen::Index channels = appearance.cols();
  Matrix out(appearance.rows(), 4 * channels);
  tbb::parallel_for(Eigen::Index{0}, appearance.rows(), [&](Eigen::Index row) {
    Eigen::Index at = 0;
    for (const Texel step : {Texel{-1, -1}, Texel{1, -1}, Texel{-1, 1}, Texel{1, 1}}) {
      out.row(row).segment(at, channels) =
          appearance.row(shape.row(shape.inside(texel_of(shape, row) + step * spacing)));
      at += channels;
    }
  });
  return out;
}

// Returns the squared distance of two texels. In a tiling exemplar, this is the shortest distance across its
// borders.
double squared_distance(const ExemplarShape& shape, Texel a, Texel b) {
  double dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  if (shape.is_tiling) {
    dx = std::min(dx, shape.width - dx);
    dy = std::min(dy, shape.height - dy);
  }
  return dx * dx + dy * dy;
}

}  // namespace

std::vector<Texel> similar_texels(const Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing) {
  const Eigen::Index texels = shape.texels();
  const Matrix all = surroundings(appearance, shape, spacing);
  const Eigen::Index offered =
      std::clamp(Eigen::Index(max_pairs / double(texels)), fewest_candidates, max_candidates);
  const Eigen::Index stride = (texels + offered - 1) / offered, count = (texels + stride - 1) / stride;
  Matrix candidates(count, all.cols());
  std::vector<char> is_offered(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) {
    candidates.row(i) = all.row(i * stride);
    is_offered[std::size_t(i)] = shape.is_shown(texel_of(shape, i * stride));
  }
  const Eigen::RowVectorXf squares = candidates.rowwise().squaredNorm().transpose();
  const double apart = 0.05 * std::min(shape.width, shape.height);
  std::vector<Texel> out(static_cast<std::size_t>(texels));
  tbb::parallel_for(Eigen::Index{0}, (texels + rows_of_task - 1) / rows_of_task, [&](Eigen::Index i) {
    const Eigen::Index first = i * rows_of_task, rows = std::min(rows_of_task, texels - first);
    // Squared distances, minus the squared lengths of the rows, which do not affect the order.
    Matrix distances = -2 * all.middleRows(first, rows) * candidates.transpose();
    distances.rowwise() += squares;
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Texel own = texel_of(shape, first + r);
      float least = std::numeric_limits<float>::infinity();
      Texel best = own;
      for (Eigen::Index c = 0; c < count; ++c) {
        if (distances(r, c) >= least || !is_offered[std::size_t(c)]) continue;
        const Texel other = texel_of(shape, c * stride);
        if (squared_distance(shape, own, other) < apart * apart) continue;
        least = distances(r, c);
        best = other;
      }
      out[std::size_t(first + r)] = best;
    }
  });
  return out;
}

namespace {

using tensor::Matrix;

// A plane of side x side coordinates in the exemplar. The plane repeats.
struct Plane {
  std::int32_t side = 0;
  std::vector<Texel> texels;

  Texel at(Texel p) const {
    return texels[std::size_t(wrapped(p.y, side)) * std::size_t(side) + std::size_t(wrapped(p.x, side))];
  }
};

// The exemplar at one level. The synthesis of the plane at the same level uses it.
struct Level {
  ExemplarShape shape;
  std::int32_t spacing = 1;
  Matrix appearance;
  Matrix looks;  // the looks of single texels
  std::vector<Texel> similar;
};

// Returns two random values in [-1, 1) for a texel of a level.
std::array<float, 2> random_pair(std::uint64_t seed, std::uint32_t level, Texel p) {
  const std::uint64_t bits = mix_bits(mix_bits(seed ^ (std::uint64_t(level) << 56)) ^
                                      (std::uint64_t(std::uint32_t(p.y)) << 32) ^ std::uint32_t(p.x));
  return {2 * unit_float(bits) - 1, 2 * unit_float(mix_bits(bits)) - 1};
}

// For a texel of the coarsest plane, returns the position along one axis of the exemplar. `random` is in [-1,
// 1).
std::int32_t coarsest_place(const ExemplarShape& shape, std::int32_t size, std::int32_t texel,
                            std::int32_t block, std::int32_t spacing, float random, float jitter) {
  const float moved = jitter * random / 2;
  if (shape.is_tiling) return wrapped(texel * spacing + std::int32_t(std::lround(moved * float(size))), size);
  const std::int32_t room = size - 2 * shape.margin - (block - 1) * spacing - 1;
  return shape.margin + std::int32_t(std::lround((0.5f + moved) * float(room))) + texel % block * spacing;
}

// Covers the plane with square blocks of half the exemplar's size. Each block shows a part of the exemplar,
// moved at random. Without the movement, the blocks would only repeat the exemplar, or one part of it if it
// does not tile. Without blocks, the initial plane would have no structure, and the corrections would
// converge to an average of the exemplar.
Plane coarsest_plane(const Level& level, std::int32_t side, std::uint32_t number, float jitter,
                     std::uint64_t seed) {
  const ExemplarShape& s = level.shape;
  const std::int32_t h = level.spacing, margin = s.is_tiling ? 0 : s.margin,
                     block = std::max((std::min(s.width, s.height) - 2 * margin) / 2 / h, 1);
  Plane plane{side, std::vector<Texel>(std::size_t(side) * std::size_t(side))};
  for (std::int32_t y = 0; y < side; ++y)
    for (std::int32_t x = 0; x < side; ++x) {
      const auto [a, b] = random_pair(seed, number, {x / block, y / block});
      plane.texels[std::size_t(y) * std::size_t(side) + std::size_t(x)] = {
          coarsest_place(s, s.width, x, block, h, a, jitter),
          coarsest_place(s, s.height, y, block, h, b, jitter)};
    }
  return plane;
}

// Replaces each texel by four children, and moves them at random. Before this movement, each child is half
// the spacing away from its parent along each axis.
Plane upsampled(const Plane& coarse, const Level& level, std::uint32_t number, float jitter,
                std::uint64_t seed) {
  const std::int32_t side = 2 * coarse.side, h = level.spacing;
  Plane plane{side, std::vector<Texel>(std::size_t(side) * std::size_t(side))};
  tbb::parallel_for(0, side, [&](std::int32_t y) {
    for (std::int32_t x = 0; x < side; ++x) {
      const Texel parent = coarse.at({x / 2, y / 2});
      // The four children are placed around the parent. At a spacing of 1, they cannot be centred: along each
      // axis, they lie on the parent and one texel before it.
      const auto place = [h](std::int32_t child) { return child == 0 ? -((h + 1) / 2) : h / 2; };
      const auto [a, b] = random_pair(seed, number, {x, y});
      const float reach = jitter * float(h);
      const Texel moved{std::int32_t(std::lround(a * reach)), std::int32_t(std::lround(b * reach))};
      plane.texels[std::size_t(y) * std::size_t(side) + std::size_t(x)] =
          level.shape.shown(parent + Texel{place(x % 2), place(y % 2)} + moved);
    }
  });
  return plane;
}

constexpr std::array<Texel, 4> diagonals{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

// The surroundings of a texel of the plane: an appearance vector for each diagonal neighbour. Each vector is
// the mean of the predictions by three texels near the neighbour, equation (2) of the 2006 paper.
using Surroundings = Eigen::Matrix<float, 4, Eigen::Dynamic, Eigen::RowMajor, 4, appearance_channels>;
Surroundings surroundings(const Plane& plane, const Level& level, Texel p) {
  Surroundings out = Surroundings::Zero(4, level.appearance.cols());
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Texel d = diagonals[std::size_t(i)];
    for (const Texel further : {Texel{0, 0}, Texel{d.x, 0}, Texel{0, d.y}})
      out.row(i) += level.appearance.row(
          level.shape.row(level.shape.inside(plane.at(p + d + further) - further * level.spacing)));
    out.row(i) *= 1 / 3.0f;
  }
  return out;
}

float difference(const Surroundings& wanted, const Level& level, Texel candidate) {
  float sum = 0;
  for (Eigen::Index i = 0; i < 4; ++i)
    sum += (wanted.row(i) - level.appearance.row(level.shape.row(
                                level.shape.inside(candidate + diagonals[std::size_t(i)] * level.spacing))))
               .squaredNorm();
  return sum;
}

// The weight of seams relative to differences of surroundings. The surroundings contain only the leading
// components of windows, so they do not describe every texel, and we also compare seams. A larger weight
// would choose texels with the wrong surroundings.
constexpr float seam_weight = 4;

// Measures the visible seams between a candidate and its four neighbours in the plane. If the candidate and
// the neighbour are also neighbours in the exemplar, there is no seam. Otherwise, compares the neighbour with
// the texel that would continue the candidate's piece of the exemplar, and the candidate with the texel that
// would continue the neighbour's piece.
float seams(const Plane& plane, const Level& level, Texel p, Texel candidate) {
  constexpr std::array<Texel, 4> sides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const ExemplarShape& s = level.shape;
  const auto apart = [&](Texel a, Texel b) {
    return (level.looks.row(s.row(a)) - level.looks.row(s.row(b))).squaredNorm();
  };
  float sum = 0;
  for (const Texel side : sides) {
    const Texel step = side * level.spacing, neighbour = plane.at(p + side),
                expected = s.inside(candidate + step);
    if (neighbour == expected) continue;
    sum += apart(neighbour, expected) + apart(candidate, s.inside(neighbour - step));
  }
  return sum;
}

// Returns the best candidate for p. Each of the 3 x 3 texels around p proposes two candidates. One continues
// the texel's own piece of the exemplar to p. The other continues the piece that is most similar to it.
Texel corrected(const Plane& plane, const Level& level, Texel p) {
  const Surroundings wanted = surroundings(plane, level, p);
  Texel best = plane.at(p);
  float least = difference(wanted, level, best) + seam_weight * seams(plane, level, p, best);
  const auto propose = [&](Texel candidate) {
    if (!level.shape.is_shown(candidate)) return;
    candidate = level.shape.inside(candidate);
    float cost = difference(wanted, level, candidate);
    if (cost >= least) return;
    cost += seam_weight * seams(plane, level, p, candidate);
    if (cost < least) {
      least = cost;
      best = candidate;
    }
  };
  for (std::int32_t y = -1; y <= 1; ++y)
    for (std::int32_t x = -1; x <= 1; ++x) {
      const Texel from = plane.at(p + Texel{x, y}), step = Texel{x, y} * level.spacing;
      propose(from - step);
      propose(level.similar[std::size_t(level.shape.row(from))] - step);
    }
  return best;
}

// Corrects the texels with coordinates equal to `phase` modulo 2. Every correction reads only the plane
// `before`.
void correct(const Level& level, Texel phase, const Plane& before, Plane& after) {
  tbb::parallel_for(0, (before.side - phase.y + 1) / 2, [&](std::int32_t row) {
    const std::int32_t y = 2 * row + phase.y;
    for (std::int32_t x = phase.x; x < before.side; x += 2)
      after.texels[std::size_t(y) * std::size_t(before.side) + std::size_t(x)] =
          corrected(before, level, {x, y});
  });
}

// Counts finished work for the progress callback, which can stop the synthesis.
class Count {
 public:
  Count(std::size_t total, const Progress& progress) : total_(total), progress_(progress) {}
  void add(std::size_t work) {
    done_ += work;
    if (progress_ && !progress_(done_, total_))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled during the synthesis (%zu of %zu texels done)", done_,
                    total_);
  }

 private:
  std::size_t total_, done_ = 0;
  const Progress& progress_;
};

std::uint32_t level_count(const ExemplarShape& shape) {
  const std::int32_t shorter = std::min(shape.width, shape.height);
  std::uint32_t levels = 1;
  while (levels < 6 && (4 << levels) <= shorter) ++levels;
  return levels - 1;
}

// Returns the exemplar's shape for a level with this spacing. The margin is two spacings. Closer to the
// border, windows are partly mirrored. Without the margin, the plane would show the border again and again.
ExemplarShape shape_of_level(ExemplarShape shape, std::int32_t spacing) {
  if (!shape.is_tiling) shape.margin = std::min(2 * spacing, std::min(shape.width, shape.height) / 4);
  return shape;
}

void correct_passes(const Level& level, std::uint32_t passes, Plane& plane, Count& count) {
  Plane next = plane;
  for (std::uint32_t pass = 0; pass < passes; ++pass)
    for (std::int32_t y = 0; y < 2; ++y)
      for (std::int32_t x = 0; x < 2; ++x) {
        correct(level, {x, y}, plane, next);
        plane.texels = next.texels;
        count.add(plane.texels.size() / 4);
      }
}

}  // namespace

void check_synthesis(const Exemplar& exemplar, const SynthesisSettings& settings) {
  const ExemplarShape& shape = exemplar.shape;
  const auto shorter = std::uint32_t(std::max(std::min(shape.width, shape.height), 0));
  if (shorter < min_exemplar_side)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material is too small for a synthesis (got %d x %d texels, need at least %u x %u)",
                  shape.width, shape.height, min_exemplar_side, min_exemplar_side);
  if (settings.side < side_step || settings.side > nook::synthesis::max_side ||
      settings.side % side_step != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the side of the plane is out of range (got %u texels, need a multiple of %u up to %u)",
                  settings.side, side_step, nook::synthesis::max_side);
  if (!(settings.jitter >= 0 && settings.jitter <= 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "jitter is out of range (got %g, need 0 to 1)",
                  double(settings.jitter));
  if (settings.passes < 1 || settings.passes > 16)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "passes is out of range (got %u, need 1 to 16)",
                  settings.passes);
  if (exemplar.values.rows() != shape.texels() || exemplar.values.cols() < 1 || !exemplar.values.allFinite())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the appearance values of the texels are missing or not finite");
}

std::vector<Texel> synthesise(const Exemplar& exemplar, const SynthesisSettings& settings,
                              const Progress& progress) {
  check_synthesis(exemplar, settings);
  const std::uint32_t levels = level_count(exemplar.shape);
  const std::vector<Matrix> stack = gaussian_stack(exemplar, levels);
  // For the progress, the search for similar texels counts as one step per exemplar texel at each level.
  std::size_t total = 0;
  for (std::uint32_t l = 0; l <= levels; ++l) {
    const std::size_t side = settings.side >> l;
    total += std::size_t(exemplar.shape.texels()) + settings.passes * 4 * (side * side / 4);
  }
  Count count(total, progress);
  count.add(0);
  Plane plane;
  for (std::uint32_t l = levels + 1; l-- > 0;) {
    const std::int32_t spacing = std::int32_t(1) << l;
    Level level{shape_of_level(exemplar.shape, spacing), spacing, {}, {}, {}};
    level.looks = stack[l];
    level.appearance = appearance_vectors(stack[l], level.shape, level.spacing);
    level.similar = similar_texels(level.appearance, level.shape, level.spacing);
    count.add(std::size_t(exemplar.shape.texels()));
    const float jitter = l >= 2 ? settings.jitter : 0.0f;
    plane = l == levels
                ? coarsest_plane(level, std::int32_t(settings.side >> l), l, settings.jitter, settings.seed)
                : upsampled(plane, level, l, jitter, settings.seed);
    correct_passes(level, settings.passes, plane, count);
  }
  return std::move(plane.texels);
}

}  // namespace nook::bake::synthesis
