#include "bakers/material/raw_relief.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "bakers/material/view_spline.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/relief_tables.h"

namespace nook::bake::material {
namespace {

using nook::material::Relief;
using nook::material::ReliefTables;

constexpr float largest_slope = 5.67f;  // slope of a tilt of 80 degrees

ReliefTables tables_of(const Relief& relief, std::uint32_t width, std::uint32_t height) {
  return nook::material::make_relief_tables(relief, width, height, default_memory());
}

float middle(std::size_t texel, std::uint32_t side) {
  return (float(texel) + 0.5f) / float(side);
}

// Returns where the view sees the points of the relief, as if no point were hidden by others.
std::vector<Taps> unhidden_taps(const Relief& relief, const ReliefTables& tables, std::uint32_t width,
                                std::uint32_t height, Vec3 view) {
  const nook::material::TexturePlace slope = nook::material::relief_slope(tables, view);
  std::vector<Taps> taps;
  for (std::size_t x = 0; x < width; ++x)
    for (std::size_t y = 0; y < height; ++y) {
      const float share = relief.levels.empty() ? 1 : float(relief.levels[y * width + x]) / 255;
      const float z = relief.low + (relief.high - relief.low) * share;
      taps.push_back(taps_at(width, height, middle(x, width) - z * slope.u, middle(y, height) - z * slope.v));
    }
  return taps;
}

// Working memory of the conjugate gradients. Each vector has one value per texel.
struct ConjugateWork {
  std::vector<float> step, rest, along, image;
};

// The taps are the rows of a sparse matrix S. gather() sets out = S * in. scatter() adds S^T * in to `out`.
void gather(const std::vector<Taps>& taps, const float* in, float* out) {
  for (std::size_t t = 0; t < taps.size(); ++t) out[t] = mean_of(taps[t], in);
}
void scatter(const std::vector<Taps>& taps, const float* in, float* out) {
  for (std::size_t t = 0; t < taps.size(); ++t)
    for (int i = 0; i < 4; ++i) out[taps[t].texel[i]] += taps[t].share[i] * in[t];
}

double square(const std::vector<float>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

// Minimises |S x - shown|^2 + stiffness |x - first|^2 by conjugate gradients from x = first. Rows of S sum to
// 1, so the stiffness bounds the error after a few rounds.
void fit_image(const std::vector<Taps>& taps, const std::vector<float>& shown, std::vector<float>& x,
               ConjugateWork& w) {
  constexpr float stiffness = 0.05f;
  constexpr int rounds = 12;
  const std::size_t count = taps.size();
  w.image.resize(count);
  w.rest.assign(count, 0);
  gather(taps, x.data(), w.image.data());
  for (std::size_t t = 0; t < count; ++t) w.image[t] = shown[t] - w.image[t];
  scatter(taps, w.image.data(), w.rest.data());
  w.step = w.rest;
  double left = square(w.rest);
  for (int round = 0; round < rounds && left > 0; ++round) {
    gather(taps, w.step.data(), w.image.data());
    w.along.assign(count, 0);
    scatter(taps, w.image.data(), w.along.data());
    for (std::size_t t = 0; t < count; ++t) w.along[t] += stiffness * w.step[t];
    const double bend = std::inner_product(w.step.begin(), w.step.end(), w.along.begin(), 0.0);
    if (!(bend > 0)) return;
    const auto length = float(left / bend);
    for (std::size_t t = 0; t < count; ++t) {
      x[t] += length * w.step[t];
      w.rest[t] -= length * w.along[t];
    }
    const double now = square(w.rest);
    const auto turn = float(now / left);
    for (std::size_t t = 0; t < count; ++t) w.step[t] = w.rest[t] + turn * w.step[t];
    left = now;
  }
}

// Blurs a repeating tile along one side. `texels` is the standard deviation of the Gaussian. The side has
// `count` texels with a distance of `stride` values between them.
std::vector<float> blurred(const std::vector<float>& image, std::size_t count, std::size_t stride,
                           float texels) {
  const auto reach = long(std::ceil(3 * texels)), side = long(count);
  std::vector<float> out(image.size());
  for (std::size_t t = 0; t < image.size(); ++t) {
    const long at = long(t / stride) % side;
    const std::size_t first = t - std::size_t(at) * stride;
    double sum = 0, weight = 0;
    for (long i = -reach; i <= reach; ++i) {
      const double w = std::exp(-0.5 * double(i * i) / (double(texels) * double(texels)));
      sum += w * double(image[first + std::size_t(((at + i) % side + side) % side) * stride]);
      weight += w;
    }
    out[t] = float(sum / weight);
  }
  return out;
}

std::vector<float> smooth(const RawMaterial& raw, const std::vector<float>& heights, float texels) {
  return blurred(blurred(heights, raw.height, 1, texels), raw.width, raw.height, texels);
}

// Returns images for at most eight lights, which are enough to judge a relief. A value is the sum of red,
// green and blue.
std::vector<float> few_rows(const RawMaterial& raw) {
  const std::size_t each = raw.views.size() * raw.texels();
  const std::size_t stride = std::max<std::size_t>((raw.lights.size() + 7) / 8, 1);
  std::vector<float> rows;
  for (std::size_t light = 0; light < raw.lights.size(); light += stride)
    for (std::size_t i = 0; i < each; ++i)
      rows.push_back(raw.btf[3 * light * each + i] + raw.btf[(3 * light + 1) * each + i] +
                     raw.btf[(3 * light + 2) * each + i]);
  return rows;
}

constexpr std::size_t folds = 4;

// Predicts the views of one fold from all other views, with the given relief. Returns the squared error.
double fold_error(const RawMaterial& raw, const Relief& relief, const std::vector<float>& shown,
                  const std::vector<float>& moved, std::size_t fold) {
  std::vector<Vec3> known, held;
  std::vector<std::size_t> known_at, held_at;
  for (std::size_t v = 0; v < raw.views.size(); ++v) {
    (v % folds == fold ? held : known).push_back(raw.views[v]);
    (v % folds == fold ? held_at : known_at).push_back(v);
  }
  const tensor::Matrix weights = spline_weights(known, held);
  const std::size_t views = raw.views.size(), texels = raw.texels(), rows = shown.size() / (views * texels);
  return tensor::ordered_sum(held.size(), 1, [&](std::size_t h, std::size_t) {
    const std::vector<Taps> taps = relief_taps(relief, raw.width, raw.height, held[h]);
    std::vector<float> mixed(texels), image(texels);
    double error = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      std::fill(mixed.begin(), mixed.end(), 0.0f);
      for (std::size_t k = 0; k < known.size(); ++k) {
        const float weight = weights(Eigen::Index(h), Eigen::Index(k));
        const float* const from = &moved[(row * views + known_at[k]) * texels];
        for (std::size_t t = 0; t < texels; ++t) mixed[t] += weight * from[t];
      }
      gather(taps, mixed.data(), image.data());
      const float* const truth = &shown[(row * views + held_at[h]) * texels];
      for (std::size_t t = 0; t < texels; ++t) {
        const double off = double(image[t]) - double(truth[t]);
        error += off * off;
      }
    }
    return error;
  });
}

double prediction_error(const RawMaterial& raw, const Relief& relief, const std::vector<float>& shown,
                        const ReliefProgress& progress) {
  const std::size_t views = raw.views.size(), steps = views + folds;
  std::vector<float> moved = shown;
  move_to_relief(raw, relief, moved,
                 [&](std::size_t done, std::size_t) { return !progress || progress(done, steps); });
  double error = 0;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    if (progress && !progress(views + fold, steps)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
    error += fold_error(raw, relief, shown, moved, fold);
  }
  return error;
}

}  // namespace

void check_heights(const RawMaterial& raw) {
  using nook::material::max_relief_height;
  if (raw.heights.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the heights of the material are not known; give an image of "
                  "the heights, or have the heights estimated");
  if (raw.heights.size() != raw.texels())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the relief has %zu heights, need %zu, one for each texel",
                  raw.heights.size(), raw.texels());
  for (const float height : raw.heights)
    if (!(std::abs(height) <= max_relief_height))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "a height of the relief is out of range (got %g, need at most %g tiles)", double(height),
                    double(max_relief_height));
}

Relief relief_of_heights(const RawMaterial& raw, const std::vector<float>& heights, std::uint32_t steps) {
  Relief relief;
  for (const Vec3 view : raw.views)
    relief.max_slope = std::max(
        relief.max_slope, std::min(std::hypot(view.x, view.y) / std::max(view.z, 1e-6f), largest_slope));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  if (steps == 0 || !(*high > *low)) {
    relief.low = relief.high =
        float(std::accumulate(heights.begin(), heights.end(), 0.0) / double(heights.size()));
    return relief;
  }
  relief.low = *low;
  relief.high = *high;
  relief.steps = steps;
  for (std::size_t y = 0; y < raw.height; ++y)
    for (std::size_t x = 0; x < raw.width; ++x)
      relief.levels.push_back(
          std::uint8_t(std::lround(255 * (heights[x * raw.height + y] - *low) / (*high - *low))));
  return relief;
}

namespace {

// The overall progress of a search. Each part of the search has the same number of steps, and counts its own
// steps.
class SearchProgress {
 public:
  SearchProgress(const ReliefProgress& progress, std::size_t parts) : progress_(progress), parts_(parts) {}

  // Returns the progress callback for the next part.
  ReliefProgress next() {
    return [this, part = part_++](std::size_t done, std::size_t total) {
      return !progress_ || progress_(steps * part + steps * done / total, steps * parts_);
    };
  }

 private:
  static constexpr std::size_t steps = 100;
  const ReliefProgress& progress_;
  std::size_t parts_, part_ = 0;
};

// The two other candidates: no relief, and a plane.
constexpr std::size_t other_candidates = 2;

// Returns the best of several reliefs: a plane at the heights' mean, the heights smoothed over some numbers
// of texels (0: not smoothed), and no relief.
Relief best_relief(const RawMaterial& raw, const std::vector<float>& heights,
                   std::initializer_list<float> smoothings, SearchProgress& progress) {
  const std::vector<float> shown = few_rows(raw);
  Relief best;
  double least = prediction_error(raw, best, shown, progress.next());
  const auto try_relief = [&](Relief relief) {
    const double error = prediction_error(raw, relief, shown, progress.next());
    if (!(error < least)) return;
    least = error;
    best = std::move(relief);
  };
  try_relief(relief_of_heights(raw, heights, 0));
  for (const float texels : smoothings)
    try_relief(relief_of_heights(raw, texels > 0 ? smooth(raw, heights, texels) : heights));
  return best;
}

constexpr std::size_t fewest_views = 8;

}  // namespace

Relief estimate_relief(const RawMaterial& raw, const ReliefProgress& progress) {
  if (raw.views.size() < fewest_views) return Relief();
  const std::initializer_list<float> smoothings{1, 2, 4, 8};
  SearchProgress search(progress, 1 + other_candidates + smoothings.size());
  const std::vector<float> heights = heights_of_views(raw, search.next());
  return best_relief(raw, heights, smoothings, search);
}

Relief known_relief(const RawMaterial& raw, const ReliefProgress& progress) {
  check_heights(raw);
  if (raw.views.size() < fewest_views) return Relief();
  const std::initializer_list<float> smoothings{0, 1, 2, 4, 8};
  SearchProgress search(progress, other_candidates + smoothings.size());
  return best_relief(raw, raw.heights, smoothings, search);
}

std::vector<Taps> relief_taps(const Relief& relief, std::uint32_t width, std::uint32_t height, Vec3 view) {
  const ReliefTables tables = tables_of(relief, width, height);
  std::vector<Taps> taps;
  for (std::size_t x = 0; x < width; ++x)
    for (std::size_t y = 0; y < height; ++y) {
      const nook::material::TexturePlace at =
          nook::material::relief_place(tables, {middle(x, width), middle(y, height)}, 0, view);
      taps.push_back(taps_at(width, height, at.u, at.v));
    }
  return taps;
}

void move_to_relief(const RawMaterial& raw, const Relief& relief, std::vector<float>& values,
                    const ReliefProgress& progress) {
  constexpr std::size_t views_at_once = 16;  // number of views between two calls of progress
  if (!relief.moves()) return;
  const ReliefTables tables = tables_of(relief, raw.width, raw.height);
  const std::size_t views = raw.views.size(), texels = raw.texels(), rows = values.size() / (views * texels);
  const auto move_view = [&](std::size_t view) {
    const std::vector<Taps> shown_at = relief_taps(relief, raw.width, raw.height, raw.views[view]),
                            seen_at = unhidden_taps(relief, tables, raw.width, raw.height, raw.views[view]);
    std::vector<float> shown(texels), moved(texels);
    ConjugateWork work;
    for (std::size_t row = 0; row < rows; ++row) {
      float* const image = &values[(row * views + view) * texels];
      std::copy_n(image, texels, shown.begin());
      gather(seen_at, shown.data(), moved.data());
      fit_image(shown_at, shown, moved, work);
      std::copy_n(moved.begin(), texels, image);
    }
  };
  for (std::size_t first = 0; first < views; first += views_at_once) {
    if (progress && !progress(first, views)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
    tensor::for_each_block(std::min(views_at_once, views - first), 1,
                           [&](std::size_t i, std::size_t) { move_view(first + i); });
  }
}

}  // namespace nook::bake::material
