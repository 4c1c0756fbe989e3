#include "bakers/measure/nnao/tuning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <map>

#include "bakers/measure/nnao/baseline_pass.h"
#include "bakers/measure/nnao/tuning_grid.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using Step = std::array<int, tuned_axes>;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t power_axis = 1;

struct ViewOnGpu {
  ViewOnGpu(const GladGLContext& gl, const MeasuredView& of) : measured(of), image(gl, of.view) {}
  const MeasuredView& measured;
  GpuView image;
};

// Of all pixels with one of the 256 values of AO: how many there are, and the sum of their truth. The error
// after any function of the AO follows from these.
class TruthByLevel {
 public:
  void add(const std::vector<float>& ao, const MeasuredView& measured) {
    for (std::size_t i = 0; i < ao.size(); ++i) {
      if (!std::isfinite(measured.view.depth[i])) continue;
      const double truth = double(measured.truth[i]);
      Level& level = levels_[std::size_t(std::lround(255 * ao[i]))];
      level.count += 1;
      level.truth += truth;
      squared_truth_ += truth * truth;
      count_ += 1;
    }
  }

  // The mean squared error of AO to a power.
  double mse(double power) const {
    double sum = squared_truth_;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double ao = std::pow(double(i) / 255, power);
      sum += ao * (ao * levels_[i].count - 2 * levels_[i].truth);
    }
    return sum / count_;
  }

 private:
  struct Level {
    double count = 0, truth = 0;
  };
  std::array<Level, 256> levels_;
  double squared_truth_ = 0, count_ = 0;
};

struct Found {
  TuningPlace place;
  double mse = never;
};

// One method on some of the views. The best contrast of each place is estimated from its image: the shaders
// apply it before the denoiser, the estimate behind it. settled: the image is drawn again with the estimate
// until it stays.
class Search {
 public:
  Search(const GladGLContext& gl, BaselinePass& pass, const std::deque<ViewOnGpu>& views, std::size_t every,
         const BaselineMethod& method, bool settled)
      : gl_(gl), pass_(pass), method_(method), settled_(settled) {
    for (std::size_t v = 0; v < views.size(); v += every) views_.push_back(&views[v]);
  }

  // Returns the place with the best contrast, and its error.
  Found with_best_power(TuningPlace place) {
    Found found = estimate(place);
    if (!settled_) return found;
    for (int again = 0; again < 4 && found.place != place; ++again) found = estimate(place = found.place);
    return {place, mse(place)};
  }

  // The error of a place as it is.
  double mse(const TuningPlace& place) { return drawn(place).mse(1); }

  // Returns whether a place is on the grids and, with its best contrast, better than `best`, which then moves
  // there.
  bool improve(Found& best, const TuningPlace& place) {
    for (std::size_t axis = 0; axis < tuned_axes; ++axis)
      if (place.at[axis] < 0 || place.at[axis] >= int(axis_values(method_.baseline, axis).size()))
        return false;
    const Found found = with_best_power(place);
    if (!(found.mse < best.mse)) return false;
    best = found;
    return true;
  }

  // Goes on in each direction while that helps, until none does.
  void descend(Found& best, const std::vector<Step>& steps) {
    for (bool moved = true; moved;) {
      moved = false;
      for (const Step& step : steps) {
        TuningPlace next;
        do {
          next = best.place;
          for (std::size_t axis = 0; axis < tuned_axes; ++axis) next.at[axis] += step[axis];
        } while (improve(best, next) && (moved = true));
      }
    }
  }

  // Tries what is no number. Returns whether something helped.
  bool flip(Found& best) {
    bool better = false;
    for (const Border border : all_borders) {
      TuningPlace place = best.place;
      place.border = border;
      better = (place != best.place && improve(best, place)) || better;
    }
    if (method_.baseline != Baseline::bitmask) return better;
    TuningPlace place = best.place;
    place.equal_weights = !place.equal_weights;
    return improve(best, place) || better;
  }

 private:
  const TruthByLevel& drawn(const TuningPlace& place) {
    if (const auto known = known_.find(place); known != known_.end()) return known->second;
    const BaselineMethod tried{method_.baseline, method_.taps, tuning_at(method_.baseline, place)};
    TruthByLevel& truth = known_[place];
    for (const ViewOnGpu* view : views_) {
      AoRequest request;
      request.radius = view->measured.radius;
      request.max_radius_px = 0.5f * float(view->image.height);
      const GLuint ao = pass_.draw(tried, view->image, request, true);
      truth.add(read_red(gl_, ao, view->image.width, view->image.height), view->measured);
    }
    return truth;
  }

  Found estimate(const TuningPlace& place) {
    constexpr int reach = 6;
    const TruthByLevel& truth = drawn(place);
    const std::span<const float> powers = axis_values(method_.baseline, power_axis);
    const double drawn_with = double(powers[std::size_t(place.at[power_axis])]);
    Found best{place, truth.mse(1)};
    for (int at = std::max(place.at[power_axis] - reach, 0);
         at <= std::min(place.at[power_axis] + reach, int(powers.size()) - 1); ++at) {
      const double mse = truth.mse(double(powers[std::size_t(at)]) / drawn_with);
      if (!(mse < best.mse)) continue;
      best.mse = mse;
      best.place.at[power_axis] = at;
    }
    return best;
  }

  const GladGLContext& gl_;
  BaselinePass& pass_;
  BaselineMethod method_;
  bool settled_;
  std::vector<const ViewOnGpu*> views_;
  std::map<TuningPlace, TruthByLevel> known_;
};

// Radii and shapes, alone and together; grids of shapes are coarser.
std::vector<Step> steps(Baseline baseline, int stride) {
  const int small = std::max(stride / 2, 1);
  std::vector<Step> all{{stride, 0, 0, 0}, {-stride, 0, 0, 0}};
  for (std::size_t axis = power_axis + 1; axis < tuned_axes; ++axis) {
    if (axis_values(baseline, axis).size() == 1) continue;
    for (const int turn : {small, -small}) {
      all.push_back({});
      all.back()[axis] = turn;
    }
  }
  if (stride > 1 || baseline == Baseline::ssao) return all;
  for (const int turn : {1, -1}) {
    all.push_back({1, 0, turn, 0});
    all.push_back({-1, 0, turn, 0});
  }
  return all;
}

// Valleys have two ends, small radii with steep falloffs and large ones with soft falloffs: the search goes
// down from both.
Found search_some(Search& search, Baseline baseline, const std::vector<TuningPlace>& before) {
  TuningPlace wide = first_place(baseline);
  wide.at[0] += 6;
  Found best;
  for (const TuningPlace& start : {first_place(baseline), wide}) {
    Found found = search.with_best_power(start);
    search.descend(found, steps(baseline, 4));
    search.flip(found);
    search.descend(found, steps(baseline, 2));
    if (found.mse < best.mse) best = found;
  }
  for (const TuningPlace& start : before)
    if (search.improve(best, start)) search.descend(best, steps(baseline, 2));
  return best;
}

// The best of each denoiser, the very best first.
std::vector<Found> by_denoiser(Search& search, Baseline baseline, const Found& start) {
  std::vector<Found> found;
  for (const Denoiser denoiser : denoisers_of(baseline)) {
    Found best = start;
    if (denoiser != start.place.denoiser) {
      best.place.denoiser = denoiser;
      best = search.with_best_power(best.place);
      search.descend(best, {{2, 0, 0, 0}, {-2, 0, 0, 0}});
    }
    found.push_back(best);
  }
  std::ranges::stable_sort(found, {}, &Found::mse);
  return found;
}

// The denoisers that come within this of the best on a part of the views are compared on all.
constexpr double near_best = 1.02;

Found tune(const GladGLContext& gl, BaselinePass& pass, const std::deque<ViewOnGpu>& views,
           const BaselineMethod& method, const std::vector<TuningPlace>& before) {
  Search some(gl, pass, views, views.size() < 12 ? 1 : 3, method, false),
      all(gl, pass, views, 1, method, true);
  std::vector<Found> candidates =
      by_denoiser(some, method.baseline, search_some(some, method.baseline, before));
  std::erase_if(candidates, [limit = near_best * candidates.front().mse](const Found& found) {
    return found.mse > limit;
  });
  Found best;
  for (const Found& candidate : candidates) all.improve(best, candidate.place);
  do {
    all.descend(best, steps(method.baseline, 1));
  } while (all.flip(best));
  // The estimate of the contrast is off where the denoiser mixes much.
  for (const int turn : {1, -1}) {
    TuningPlace place = best.place;
    place.at[power_axis] += turn;
    const std::span<const float> powers = axis_values(method.baseline, power_axis);
    if (place.at[power_axis] < 0 || place.at[power_axis] >= int(powers.size())) continue;
    if (const double mse = all.mse(place); mse < best.mse) best = {place, mse};
  }
  return best;
}

}  // namespace

std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  BaselinePass pass(gl, int(views.front().view.camera.width), int(views.front().view.camera.height));
  std::deque<ViewOnGpu> images;
  for (const MeasuredView& view : views) images.emplace_back(gl, view);
  std::vector<TunedBaseline> tuned;
  std::map<Baseline, std::vector<TuningPlace>> before;
  for (const BaselineMethod& method : methods) {
    const Found found = tune(gl, pass, images, method, before[method.baseline]);
    before[method.baseline].push_back(found.place);
    tuned.push_back({{method.baseline, method.taps, tuning_at(method.baseline, found.place)},
                     found.mse,
                     axes_at_edge(method.baseline, found.place)});
    if (!progress(tuned.size(), methods.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tuning");
  }
  return tuned;
}

std::string tuning_line(const BaselineMethod& method) {
  constexpr const char* names[] = {"ssao", "ssao_plus", "hbao", "n8ao",    "s4ao",  "vtk",
                                   "qgis", "filament",  "gtao", "bitmask", "xegtao"};
  const BaselineTuning& t = method.tuning;
  char text[160];
  std::snprintf(
      text, sizeof text, "{Baseline::%s, %d, {%.2ff, %.2ff, %.3ff, %.2ff, %s, Border::%s, Denoiser::%s}},\n",
      names[int(method.baseline)], method.taps, double(t.radius_scale), double(t.power), double(t.shape),
      double(t.thin), t.equal_weights ? "true" : "false", border_name(t.border), denoiser_name(t.denoiser));
  return text;
}

}  // namespace nook::measure
