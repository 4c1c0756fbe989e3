#include "bakers/lab/nnao/tuning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <map>

#include "bakers/lab/nnao/baseline_pass.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace measure;

namespace {

// Neighbouring values differ by a twentieth of a decade, which is a factor of 1.12.
constexpr float radius_scales[] = {0.28f, 0.32f, 0.36f, 0.40f, 0.45f, 0.50f, 0.56f, 0.63f, 0.71f, 0.80f,
                                   0.90f, 1.00f, 1.12f, 1.26f, 1.41f, 1.60f, 1.80f, 2.00f, 2.24f, 2.50f,
                                   2.80f, 3.20f, 3.60f, 4.00f, 4.50f, 5.00f, 5.60f, 6.30f, 7.10f, 8.00f};
constexpr float power_values[] = {0.28f, 0.32f, 0.36f, 0.40f, 0.45f, 0.50f, 0.56f, 0.63f, 0.71f, 0.80f, 0.90f,
                                  1.00f, 1.12f, 1.26f, 1.41f, 1.60f, 1.80f, 2.00f, 2.24f, 2.50f, 2.80f, 3.20f,
                                  3.60f, 4.00f, 4.50f, 5.00f, 5.60f, 6.30f, 7.10f, 8.00f, 9.00f, 10.0f};
constexpr float nothing[] = {0};
constexpr float ssao_plus_biases[] = {0,     0.005f, 0.01f, 0.02f, 0.03f, 0.045f,
                                      0.06f, 0.08f,  0.1f,  0.14f, 0.2f};
constexpr float hbao_biases[] = {0, 0.05f, 0.1f, 0.15f, 0.2f, 0.25f, 0.3f, 0.35f, 0.45f, 0.6f, 0.8f};
constexpr float gtao_falloffs[] = {0, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 0.95f};
constexpr float thicknesses[] = {0.035f, 0.05f, 0.07f, 0.1f, 0.14f, 0.2f, 0.28f,
                                 0.4f,   0.56f, 0.8f,  1.1f, 1.6f,  2.2f, 3.2f};
constexpr float xegtao_falloffs[] = {0.02f, 0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.615f, 0.7f, 0.8f, 0.9f, 1};
constexpr float n8ao_falloffs[] = {0.05f, 0.07f, 0.1f, 0.14f, 0.2f, 0.28f, 0.4f,
                                   0.56f, 0.8f,  1.1f, 1.6f,  2.2f, 3.2f};
constexpr float s4ao_falloffs[] = {0.005f, 0.007f, 0.01f, 0.014f, 0.02f, 0.028f, 0.04f, 0.056f,
                                   0.08f,  0.11f,  0.16f, 0.22f,  0.32f, 0.45f,  0.63f};
constexpr float qgis_thresholds[] = {0.2f,  0.25f, 0.3f,  0.35f, 0.4f,  0.45f, 0.5f,
                                     0.55f, 0.6f,  0.65f, 0.7f,  0.75f, 0.8f};
constexpr float compensations[] = {0, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 1, 1.4f, 2, 2.8f, 4};

std::span<const float> shapes(Baseline baseline) {
  switch (baseline) {
    case Baseline::ssao:
      return nothing;
    case Baseline::ssao_plus:
    case Baseline::vtk:
    case Baseline::filament:
      return ssao_plus_biases;
    case Baseline::n8ao:
      return n8ao_falloffs;
    case Baseline::s4ao:
      return s4ao_falloffs;
    case Baseline::qgis:
      return qgis_thresholds;
    case Baseline::hbao:
      return hbao_biases;
    case Baseline::gtao:
      return gtao_falloffs;
    case Baseline::bitmask:
      return thicknesses;
    default:
      return xegtao_falloffs;
  }
}

float value(Baseline baseline, const TuningPlace& place, std::size_t axis) {
  return axis_values(baseline, axis)[std::size_t(place.at[axis])];
}

}  // namespace

std::span<const float> axis_values(Baseline baseline, std::size_t axis) {
  switch (axis) {
    case 0:
      return radius_scales;
    case 1:
      return power_values;
    case 2:
      return shapes(baseline);
    default:
      return baseline == Baseline::xegtao ? std::span<const float>(compensations) : nothing;
  }
}

BaselineTuning tuning_at(Baseline baseline, const TuningPlace& place) {
  return {value(baseline, place, 0),
          value(baseline, place, 1),
          value(baseline, place, 2),
          value(baseline, place, 3),
          place.equal_weights,
          place.border,
          place.denoiser};
}

TuningPlace first_place(Baseline baseline) {
  TuningPlace place;
  place.at[0] = int(std::ranges::find(radius_scales, 1.0f) - radius_scales);
  place.at[1] = int(std::ranges::find(power_values, 1.0f) - power_values);
  place.at[2] = int(shapes(baseline).size() / 2);
  const std::span<const Denoiser> denoisers = denoisers_of(baseline);
  const bool has_edges = std::ranges::find(denoisers, Denoiser::edges_2) != denoisers.end();
  place.denoiser = has_edges ? Denoiser::edges_2 : denoisers.back();
  return place;
}

std::vector<std::string> axes_at_edge(Baseline baseline, const TuningPlace& place) {
  std::vector<std::string> found;
  for (std::size_t axis = 0; axis < tuned_axes; ++axis) {
    const std::span<const float> values = axis_values(baseline, axis);
    const bool first = place.at[axis] == 0, last = place.at[axis] + 1 == int(values.size());
    const bool complete = baseline == Baseline::xegtao && axis == 2;
    if (values.size() > 1 && !complete && ((first && values.front() != 0) || last))
      found.push_back(axis_names[axis]);
  }
  return found;
}

namespace {

using Step = std::array<int, tuned_axes>;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t power_axis = 1;

struct ViewOnGpu {
  ViewOnGpu(const GladGLContext& gl, const MeasuredView& of) : measured(of), image(gl, of.view) {}
  const MeasuredView& measured;
  GpuView image;
};

// For each of the 256 AO values, stores how many pixels have this value, and the sum of their true AO. From
// these sums, the error can be computed for any function that is applied to the AO.
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

  // Returns the mean squared error after AO is raised to a power.
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

// Searches for the best tuning of one method on some of the views. For each place (a point in the space of
// parameters), it estimates the best contrast from the drawn image. The estimate applies the contrast after
// the denoiser, but the shaders apply it before. If `settled` is true, the search therefore redraws the image
// with the estimated contrast until the estimate no longer changes.
class Search {
 public:
  Search(const GladGLContext& gl, BaselinePass& pass, const std::deque<ViewOnGpu>& views, std::size_t every,
         const BaselineMethod& method, bool settled)
      : gl_(gl), pass_(pass), method_(method), settled_(settled) {
    for (std::size_t v = 0; v < views.size(); v += every) views_.push_back(&views[v]);
  }

  // Finds the best contrast for the other parameters of a place. Returns this contrast and the error.
  Found with_best_power(TuningPlace place) {
    Found found = estimate(place);
    if (!settled_) return found;
    for (int again = 0; again < 4 && found.place != place; ++again) found = estimate(place = found.place);
    return {place, mse(place)};
  }

  // Returns the error of exactly this place.
  double mse(const TuningPlace& place) { return drawn(place).mse(1); }

  // Checks two things: whether a place is on the grids, and whether its error with the best contrast is lower
  // than the error of `best`. If both are true, sets `best` to the place and returns true.
  bool improve(Found& best, const TuningPlace& place) {
    for (std::size_t axis = 0; axis < tuned_axes; ++axis)
      if (place.at[axis] < 0 || place.at[axis] >= int(axis_values(method_.baseline, axis).size()))
        return false;
    const Found found = with_best_power(place);
    if (!(found.mse < best.mse)) return false;
    best = found;
    return true;
  }

  // Moves `best` along each step for as long as the error falls. Ends when no step lowers the error.
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

  // Tries other values of the non-numeric parameters. Returns whether one of them lowered the error.
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

// Returns the steps that the search tries: steps of the radius, steps of the shape, and combinations of both.
// The shape grids are coarser than the radius grid.
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

// The error often has two minima: small radii with steep falloffs, and large radii with soft falloffs. The
// search therefore descends from two starts. It also tries the places in `before`.
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

// Returns the best result with each denoiser, sorted by error.
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

// A denoiser is compared again on all views if its error on the subset of views is at most this factor above
// the lowest error.
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
  // The estimated contrast is inaccurate for strong denoisers, so neighbouring values are tried as well.
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

}  // namespace nook::lab
