#include "bakers/material/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/material/btf_error.h"
#include "bakers/material/seen_views.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

using nook::material::Material;
using tensor::Matrix;

constexpr std::uint32_t trial_side = 24;
constexpr std::size_t hold_every = 5, hold_first = 2;  // directions 2, 7, 12, ... are held out
constexpr std::size_t fewest_directions = 10;
// The view moves in steps of one degree along arcs through the hemisphere.
constexpr int arcs = 6, arc_steps = 10;
constexpr double degree = std::numbers::pi / 180;

// A verdict mentions values above these bounds.
constexpr double many_negative = 0.05, large_step = 0.25;
// About this many directions are enough to show the gloss of most materials.
constexpr std::size_t enough_directions = 100;

std::vector<std::size_t> indices(std::size_t count, bool held_out) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i)
    if ((i % hold_every == hold_first) == held_out) chosen.push_back(i);
  return chosen;
}

std::vector<Vec3> chosen_of(const std::vector<Vec3>& all, const std::vector<std::size_t>& chosen) {
  std::vector<Vec3> out;
  for (const std::size_t i : chosen) out.push_back(all[i]);
  return out;
}

// Returns the middle of a material, without its mask. The result has either only the held-out views and
// lights, or only the others.
RawMaterial part_of(const RawMaterial& raw, bool held_out) {
  const std::vector<std::size_t> lights = indices(raw.lights.size(), held_out),
                                 views = indices(raw.views.size(), held_out);
  RawMaterial part;
  part.name = raw.name;
  part.lights = chosen_of(raw.lights, lights);
  part.views = chosen_of(raw.views, views);
  part.width = std::min(raw.width, trial_side);
  part.height = std::min(raw.height, trial_side);
  const std::size_t x0 = (raw.width - part.width) / 2, y0 = (raw.height - part.height) / 2;
  part.btf.reserve(part.light_rows() * views.size() * part.texels());
  for (const std::size_t light : lights)
    for (std::size_t c = 0; c < 3; ++c)
      for (const std::size_t view : views)
        for (std::size_t x = 0; x < part.width; ++x) {
          const std::size_t image = (3 * light + c) * raw.views.size() + view;
          const float* const row = &raw.btf[(image * raw.width + x0 + x) * raw.height + y0];
          part.btf.insert(part.btf.end(), row, row + part.height);
        }
  return part;
}

// Scales a rank by the same factor as the size of its mode.
std::uint32_t scaled(std::uint32_t rank, std::size_t size, std::size_t whole) {
  const double share = double(size) / double(whole);
  return std::clamp(std::uint32_t(std::ceil(double(rank) * share)), 1u, std::uint32_t(size));
}

CompressionSettings trial_settings(CompressionSettings s, const RawMaterial& raw, const RawMaterial& part) {
  s.visibility = nook::material::VisibilityForm::none;
  s.relief = ReliefSource::none;
  s.rank_x = scaled(s.rank_x, part.width, raw.width);
  s.rank_y = scaled(s.rank_y, part.height, raw.height);
  s.rank_light = std::min(s.rank_light, std::uint32_t(part.light_rows()));
  if (s.method == Method::n_svd) {
    s.rank_view = std::min(s.rank_view, std::uint32_t(part.views.size()));
    return s;
  }
  // The total rank of all clusters is at most the number of views.
  const auto views = std::uint32_t(part.views.size());
  s.cluster_rank_view = std::min(s.cluster_rank_view, views);
  s.clusters =
      std::min(scaled(s.cluster_count(), views, raw.views.size()), std::max(views / s.cluster_rank_view, 1u));
  s.rank_view = s.clusters * s.cluster_rank_view;
  s.mixture = std::min(s.mixture, s.clusters);
  return s;
}

// Returns the share of radiances that are below -0.1 % of `rms`.
double negative_share(const Material& seen, double rms) {
  std::size_t negative = 0, all = 0;
  for (std::size_t view = 0; view < seen.views.size(); ++view) {
    const Matrix decoded = decode_btf_view(seen, view);
    negative += std::size_t((decoded.array() < -1e-3f * float(rms)).count());
    all += std::size_t(decoded.size());
  }
  return all > 0 ? double(negative) / double(all) : 0;
}

// Returns views on an arc over the hemisphere, in steps of one degree. `number` chooses the arc.
std::vector<Vec3> arc_of(int number) {
  const double azimuth = 2 * std::numbers::pi * number / arcs, first = 5 + 8 * number;
  std::vector<Vec3> views;
  for (int i = 0; i <= arc_steps; ++i) {
    const double tilt = degree * (first + i), turn = azimuth + degree * i;
    views.push_back({float(std::sin(tilt) * std::cos(turn)), float(std::sin(tilt) * std::sin(turn)),
                     float(std::cos(tilt))});
  }
  return views;
}

double largest_step(const Material& material) {
  double largest = 0;
  for (int number = 0; number < arcs; ++number) {
    const Material seen = as_seen_from(material, arc_of(number));
    Matrix before = decode_btf_view(seen, 0);
    for (std::size_t view = 1; view < seen.views.size(); ++view) {
      Matrix after = decode_btf_view(seen, view);
      const double size = double(before.norm());
      if (size > 0) largest = std::max(largest, double((after - before).norm()) / size);
      before = std::move(after);
    }
  }
  return largest;
}

bool at_cap(const CompressionSettings& s, const RawMaterial& raw) {
  return s.rank_x >= raw.width || s.rank_y >= raw.height || s.rank_light >= raw.light_rows() ||
         s.rank_view >= raw.views.size();
}

Grade grade_of(double db) {
  return db >= good_db ? Grade::good : db >= bad_db ? Grade::poor : Grade::bad;
}

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Returns advice for a material with wrong colours in unseen views.
std::string cure(const RawMaterial& raw) {
  const std::size_t directions = std::min(raw.lights.size(), raw.views.size());
  std::string text = "this material needs ";
  if (directions < enough_directions) text += "about 100 view and light directions, or ";
  return text + "--method neural, or an ordinary PBR material";
}

std::string words_of(const Verdict& v, const RawMaterial& raw) {
  std::string text = std::string(grade_name(v.grade)) + ": " + number("%.1f dB", v.held_out_db) +
                     " in views and lights that were held out";
  if (v.negative > many_negative) text += ", " + number("%.0f %%", 100 * v.negative) + " negative values";
  if (v.largest_step > large_step)
    text += ", a jump of " + number("%.0f %%", 100 * v.largest_step) + " when the view turns by one degree";
  if (v.one_cluster) text += ", one cluster, which is N-SVD with a view map";
  if (v.ranks_at_cap) text += ", ranks at their upper limits, which compress nothing";
  return v.grade == Grade::good ? text : text + "; " + cure(raw);
}

Verdict not_judged(const char* why) {
  Verdict verdict;
  verdict.words = std::string("not judged: ") + why;
  return verdict;
}

}  // namespace

const char* grade_name(Grade grade) {
  switch (grade) {
    case Grade::good:
      return "good";
    case Grade::poor:
      return "poor";
    case Grade::bad:
      return "bad";
    case Grade::not_judged:
      break;
  }
  return "not judged";
}

Verdict judge(const RawMaterial& raw, const CompressionSettings& settings, const StageProgress& progress) {
  if (settings.method == Method::neural)
    return not_judged(
        "not measured, because a second network would have to be trained; use `evaluate material --unseen`");
  if (raw.lights.size() < fewest_directions || raw.views.size() < fewest_directions)
    return not_judged("with fewer than ten views or lights, none can be held out");
  const RawMaterial fitted = part_of(raw, false), unseen = part_of(raw, true);
  const CompressionSettings s = trial_settings(settings, raw, fitted);
  const auto held_out = [&](const char*, std::size_t done, std::size_t total) {
    return !progress || progress("held-out views", done, total);
  };
  try {
    check_settings(s, fitted);
  } catch (const Failure& failure) {
    return not_judged(failure.what());
  }
  const Material trial = compress(fitted, s, held_out);
  Material seen = as_seen_from(trial, unseen.views);
  light_from(seen, unseen.lights);
  const BtfError error = measure_btf(unseen, seen);
  if (!(error.squared_signal > 0)) return not_judged("the material is black");
  Verdict verdict;
  verdict.held_out_db = error.se_db();
  verdict.negative = negative_share(seen, std::sqrt(error.squared_signal / double(error.values)));
  verdict.largest_step = largest_step(trial);
  verdict.one_cluster = settings.method == Method::k_cta && settings.cluster_count() == 1;
  verdict.ranks_at_cap = at_cap(settings, raw);
  verdict.grade = grade_of(verdict.held_out_db);
  verdict.words = words_of(verdict, raw);
  return verdict;
}

nlohmann::ordered_json describe(const Verdict& v) {
  nlohmann::ordered_json json{{"verdict", grade_name(v.grade)}, {"verdict_words", v.words}};
  if (!v.judged()) return json;
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  json["held_out_db"] = rounded(v.held_out_db);
  json["negative_share"] = rounded(v.negative);
  json["largest_step"] = rounded(v.largest_step);
  json["one_cluster"] = v.one_cluster;
  json["ranks_at_cap"] = v.ranks_at_cap;
  return json;
}

}  // namespace nook::bake::material
