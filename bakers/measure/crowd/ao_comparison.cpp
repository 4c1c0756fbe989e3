#include "bakers/measure/crowd/ao_comparison.h"

#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "bakers/measure/crowd/sheet.h"

namespace nook::measure::crowd {
namespace {

constexpr std::uint32_t kRays = 128;         // for the errors
constexpr std::uint32_t kPictureRays = 256;  // for the sheets, in which noise would be seen
constexpr std::uint32_t kFloorSide = 320;    // points of the floor, about 2 cm apart

VertexValues ao_of(const EvaluatedCrowd& evaluated, std::span<const std::uint32_t> characters) {
  VertexValues ao;
  for (const std::uint32_t character : characters) ao.push_back(evaluated.ao(character));
  return ao;
}

VertexValues difference_grey(const VertexValues& a, const VertexValues& b) {
  VertexValues grey = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t v = 0; v < a[i].size(); ++v)
      grey[i][v] = std::max(0.0f, 1 - 4 * std::abs(a[i][v] - b[i][v]));
  return grey;
}

std::string gamma_label(const EvaluatedCrowd& evaluated, const char* rest) {
  char text[96];
  std::snprintf(text, sizeof text, "gamma %.2f, %s", double(evaluated.gamma()), rest);
  return text;
}

std::string screen_space_label(const ScreenSpaceSettings& settings) {
  return "screen-space AO (NNAO) alone, " + std::to_string(settings.taps) + " taps" +
         (settings.half_resolution ? ", half resolution" : "");
}

// Draws panels of one group and keeps them for a sheet.
class Painter {
 public:
  explicit Painter(const Subject& subject) : subject_(subject), group_(choose_group(subject.places)) {}

  const Group& group() const { return group_; }

  void add(const std::string& label, AoPanel panel) {
    panels_.push_back(subject_.renderer.draw(group_, panel));
    draw_label(panels_.back(), label);
  }
  void add(const std::string& label, const EvaluatedCrowd& evaluated,
           ScreenSpace screen_space = ScreenSpace::kNowhere) {
    add(label, {ao_of(evaluated, group_.members), screen_space, {}});
  }
  platform::Image sheet(int columns) const { return tile(panels_, columns); }

 private:
  const Subject& subject_;
  Group group_;
  std::vector<platform::Image> panels_;
};

}  // namespace

AoErrors measure_ao(const Subject& subject) {
  const PosedCrowd& crowd = subject.crowd;
  const auto [sample, have_neighbours] = choose_sample(subject.places);
  const VertexValues reference = traced_ao(crowd, sample, {kRays, subject.seed});
  const VertexValues again = traced_ao(crowd, sample, {kRays, subject.seed + 1});
  AoErrors result;
  result.rays = kRays;
  // The mean square difference of two independent estimates is twice the variance of one.
  result.noise_floor_mse = compare(crowd, sample, again, reference).mse / 2;
  result.characters = sample.size();
  result.have_neighbours = have_neighbours;
  const std::pair<const char*, std::uint32_t> forms[4] = {{"self", NOOK_TERM_SELF},
                                                          {"self_ground", NOOK_TERM_SELF | NOOK_TERM_GROUND},
                                                          {"self_links", NOOK_TERM_SELF | NOOK_TERM_LINKS},
                                                          {"all", NOOK_TERM_ALL}};
  for (const auto& [name, terms] : forms) {
    subject.evaluated.update(terms);
    result.forms.push_back({name, compare(crowd, sample, ao_of(subject.evaluated, sample), reference)});
  }
  const VertexValues static_ao(sample.size(), subject.evaluated.static_ao());
  result.forms.push_back({"static", compare(crowd, sample, static_ao, reference)});
  // Both of these forms have the ground's term.
  result.links_cut_mse_area = 1 - result.forms[3].errors.mse_area / result.forms[1].errors.mse_area;
  return result;
}

platform::Image ao_sheet(const Subject& subject, const ScreenSpaceSettings* screen_space) {
  Painter painter(subject);
  const std::vector<std::uint32_t>& members = painter.group().members;
  const TraceSettings trace{kPictureRays, subject.seed};
  const VertexValues reference = traced_ao(subject.crowd, members, trace);
  painter.add("no AO", AoPanel{});
  painter.add("static AO, baked in the rest pose",
              AoPanel{VertexValues(members.size(), subject.evaluated.static_ao()), {}, {}});
  if (screen_space) painter.add(screen_space_label(*screen_space), AoPanel{{}, ScreenSpace::kEverywhere, {}});
  subject.evaluated.update(NOOK_TERM_SELF);
  painter.add("Nook, self only", subject.evaluated);
  subject.evaluated.update(NOOK_TERM_ALL);
  painter.add("Nook, self + neighbours + ground", subject.evaluated);
  if (screen_space) {
    painter.add("the same, screen-space AO on the floor", subject.evaluated, ScreenSpace::kOnFloor);
    const FloorPatch patch = floor_under(painter.group(), subject.places, screen_space->radius_m, kFloorSide);
    const std::vector<float> floor =
        traced_floor_ao(subject.crowd, members, patch, screen_space->radius_m, trace);
    painter.add("ray traced, the floor to 0.5 m like screen-space AO",
                AoPanel{reference, {}, FloorValues{patch, floor}});
  } else {
    painter.add("ray traced", AoPanel{reference, {}, {}});
  }
  painter.add("error of Nook x 4, dark is wrong",
              AoPanel{difference_grey(ao_of(subject.evaluated, members), reference), {}, {}});
  return painter.sheet(screen_space ? 4 : 3);
}

platform::Image double_shadowing_sheet(const Subject& subject, EvaluatedCrowd& one_norm,
                                       EvaluatedCrowd& one_norm_gamma_2) {
  constexpr std::uint32_t kNoGround = NOOK_TERM_SELF | NOOK_TERM_LINKS;
  Painter painter(subject);
  const auto add_one_norm = [&](EvaluatedCrowd& evaluated) {
    evaluated.update(NOOK_TERM_SELF);
    painter.add(gamma_label(evaluated, "self"), evaluated);
    evaluated.update(kNoGround);
    painter.add(gamma_label(evaluated, "self + neighbours in one norm"), evaluated);
  };
  add_one_norm(one_norm);
  const VertexValues reference =
      traced_ao(subject.crowd, painter.group().members, {kPictureRays, subject.seed, false});
  painter.add("ray traced, no ground", AoPanel{reference, {}, {}});
  add_one_norm(one_norm_gamma_2);
  subject.evaluated.update(kNoGround);
  painter.add(gamma_label(subject.evaluated, "composed (default)"), subject.evaluated);
  return painter.sheet(3);
}

}  // namespace nook::measure::crowd
