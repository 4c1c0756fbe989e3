#include "bakers/images/ubo_names.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

using Angles = std::pair<float, float>;  // tilt, azimuth

struct Pair {
  Angles light, view;
};

// Lights are moved by less than the distance of neighbouring directions.
constexpr float most_moved_deg = 15;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// The number behind a two-letter key that no other letter precedes.
std::optional<float> number_behind(std::string_view text, std::string_view key) {
  std::optional<float> found;
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    if (at > 0 && is_letter(text[at - 1])) continue;
    const char* first = text.data() + at + key.size();
    float value = 0;
    const auto [end, error] =
        std::from_chars(first, text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc() || end == first) continue;
    if (found) return std::nullopt;
    found = value;
  }
  return found;
}

// All azimuths are one direction at a tilt of 0.
Angles canonical(float tilt, float azimuth) {
  return {tilt, tilt == 0 ? 0 : azimuth};
}

std::vector<Vec3> directions_of(const std::map<Angles, std::size_t>& set) {
  std::vector<Vec3> directions;
  for (const auto& [angles, index] : set)
    directions.push_back(direction_from_angles(angles.first, angles.second));
  return directions;
}

void number(std::map<Angles, std::size_t>& set) {
  std::size_t next = 0;
  for (auto& [angles, index] : set) index = next++;
}

bool near(Angles a, Angles b) {
  const float cosine =
      dot(direction_from_angles(a.first, a.second), direction_from_angles(b.first, b.second));
  return cosine > std::cos(most_moved_deg * 3.14159265f / 180);
}

std::vector<Pair> read_pairs(std::span<const std::string> names) {
  std::vector<Pair> pairs;
  for (const std::string& name : names) {
    const auto angles = parse_ubo_name(name);
    if (!angles || angles->light_tilt < 0 || angles->light_tilt >= 90 || angles->view_tilt < 0 ||
        angles->view_tilt >= 90)
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "the name %.200s tells no directions; it needs tl, pl, tv and pv once each with degrees behind "
          "them, tilts below 90",
          name.c_str());
    pairs.push_back({canonical(angles->light_tilt, angles->light_azimuth),
                     canonical(angles->view_tilt, angles->view_azimuth)});
  }
  return pairs;
}

// A lamp cannot stand in the camera: where light and view would be equal, it is moved. Such a light is of one
// view alone, and the image takes the place of the pair that is missing.
void put_moved_lights_back(std::vector<Pair>& pairs) {
  std::map<Angles, std::set<Angles>> views_of;
  for (const Pair& p : pairs) views_of[p.light].insert(p.view);
  for (Pair& p : pairs) {
    const auto camera = views_of.find(p.view);
    if (views_of[p.light].size() == 1 && camera != views_of.end() && camera->second.size() > 1 &&
        !camera->second.contains(p.view) && near(p.light, p.view))
      p.light = p.view;
  }
}

[[noreturn]] void fail_of_missing(const UboGrid& grid, const std::map<Angles, std::size_t>& lights,
                                  const std::map<Angles, std::size_t>& views, std::size_t none) {
  const auto missing = std::size_t(std::count(grid.image.begin(), grid.image.end(), none));
  const auto first = std::size_t(std::find(grid.image.begin(), grid.image.end(), none) - grid.image.begin());
  const Angles light = std::next(lights.begin(), std::ptrdiff_t(first / views.size()))->first;
  const Angles view = std::next(views.begin(), std::ptrdiff_t(first % views.size()))->first;
  throw Failure(
      NOOK_ERROR_BAD_FILE,
      "no image for tl %g, pl %g, tv %g, pv %g (%zu of %zu are missing); every light is needed with "
      "every view",
      double(light.first), double(light.second), double(view.first), double(view.second), missing,
      grid.image.size());
}

}  // namespace

std::optional<UboAngles> parse_ubo_name(std::string_view name) {
  // The extension's dot must not pass for a decimal point.
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name = name.substr(0, dot);
  const auto tl = number_behind(name, "tl"), pl = number_behind(name, "pl");
  const auto tv = number_behind(name, "tv"), pv = number_behind(name, "pv");
  if (!tl || !pl || !tv || !pv) return std::nullopt;
  return UboAngles{*tl, *pl, *tv, *pv};
}

UboGrid arrange_ubo_names(std::span<const std::string> names) {
  if (names.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "no images; one for each light and view direction is needed");
  std::vector<Pair> pairs = read_pairs(names);
  put_moved_lights_back(pairs);
  std::map<Angles, std::size_t> lights, views;
  for (const Pair& p : pairs) {
    lights[p.light];
    views[p.view];
  }
  number(lights);
  number(views);
  UboGrid grid{directions_of(lights), directions_of(views), {}};
  const std::size_t none = names.size();
  grid.image.assign(lights.size() * views.size(), none);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t& cell = grid.image[lights[pairs[i].light] * views.size() + views[pairs[i].view]];
    if (cell != none)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%.150s and %.150s are of the same directions; one of them is needed",
                    names[cell].c_str(), names[i].c_str());
    cell = i;
  }
  if (grid.image.size() != names.size()) fail_of_missing(grid, lights, views, none);
  return grid;
}

}  // namespace nook::bake::material
