#include "bakers/measure/report/pages.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

#include "bakers/measure/material/material_pictures.h"
#include "bakers/measure/material/material_report.h"
#include "bakers/measure/report/advice.h"
#include "bakers/measure/report/report_pictures.h"
#include "sdk/src/material/reflectance.h"

namespace nook::report {
namespace {

using namespace bake;
using nook::material::MaterialTables;

constexpr int panel_px = 180;
constexpr float pi = std::numbers::pi_v<float>;
// In units of the radiance of a white plane. Negative values that are closer to 0 come from rounding and are
// not visible.
constexpr float visibly_negative = -0.02f;
constexpr std::array<float, 3> view_tilts{0, 0.7f, 1.2f};      // radians from the normal, along x
constexpr std::array<float, 3> light_tilts{0.2f, 0.9f, 1.3f};  // radians from the normal, along y

Vec3 tilted_x(float angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}
Vec3 tilted_y(float angle) {
  return {0, std::sin(angle), std::cos(angle)};
}

struct Sheet {
  Picture picture;
  double negative_share = 0;
};

// Draws one column for each view and one row for each light. The tile is repeated twice along each axis.
Sheet sheet_of(const MaterialTables& tables) {
  Sheet sheet{plain_picture(int(view_tilts.size()) * panel_px, int(light_tilts.size()) * panel_px, {}), 0};
  std::atomic<std::size_t> negative{0};
  tbb::parallel_for(0, sheet.picture.height, [&](int y) {
    for (int x = 0; x < sheet.picture.width; ++x) {
      nook::material::Sample sample;
      sample.u = 2 * (float(x % panel_px) + 0.5f) / panel_px;
      sample.v = 2 * (float(y % panel_px) + 0.5f) / panel_px;
      sample.view = tilted_x(view_tilts[std::size_t(x / panel_px)]);
      sample.light = tilted_y(light_tilts[std::size_t(y / panel_px)]);
      const nook::material::Radiance c = nook::material::evaluate_btf(tables, sample);
      if (pi * std::min({c.red, c.green, c.blue}) < visibly_negative) ++negative;
      set_pixel(sheet.picture, x, y, display(pi * Vec3{c.red, c.green, c.blue}));
    }
  });
  sheet.negative_share = double(negative) / double(sheet.picture.width) / double(sheet.picture.height);
  return sheet;
}

void add_raw(PageParts& parts, Measures& measures, std::span<const std::byte> bytes,
             const nook::material::Material& material, const bake::material::RawMaterial& raw) {
  const nlohmann::ordered_json row =
      bake::material::report_row(raw.name, measure::material_file_row(raw, {bytes, material}));
  if (row.contains("se_db") && row["se_db"].is_number()) measures.value["se_db"] = row["se_db"].get<double>();
  std::vector<std::vector<Html>> rows{{Html("against the raw material"), Html("value")}};
  for (const auto& item : row.items())
    if (item.value().is_number()) rows.push_back({text(item.key()), number(item.value().get<double>())});
  parts.sections +=
      Html("<section id=\"raw\"><h2>Beside the raw material</h2>\n") +
      figure(measure::difference_sheet(raw, material),
             "The raw material, the decoded one and three times their difference, for a view from above and "
             "a tilted one; below them the visibility",
             Html("From the left: ray traced, decoded, three times the difference. The upper row shows a "
                  "view near the normal, the lower row a tilted view. Black in the third column means no "
                  "difference.")) +
      table(rows) + Html("</section>\n");
}

}  // namespace

PageParts material_parts(std::span<const std::byte> bytes, const nook::material::Material& material,
                         const bake::material::RawMaterial* raw) {
  const MaterialTables tables = nook::material::make_tables(material, {}, default_memory());
  const Sheet sheet = sheet_of(tables);
  Measures measures;
  measures.value["bytes"] = double(bytes.size());
  measures.value["negative_share"] = sheet.negative_share;
  PageParts parts;
  parts.sections =
      Html("<section id=\"views\"><h2>The material</h2>\n") +
      figure(
          sheet.picture,
          "The tile twice each way, for three views from left to right and three lights from top to bottom",
          Html("From left to right, the view tilts from above towards the horizon along x. From top to "
               "bottom, the light tilts from above towards the horizon along y. Look for seams at the middle "
               "of each panel, and for patches that change suddenly.")) +
      Html("</section>\n");
  if (raw) add_raw(parts, measures, bytes, material, *raw);
  parts.lead = text(std::to_string(tables.btf.width)) + Html(" x ") +
               text(std::to_string(tables.btf.height)) + Html(" texels in ") +
               byte_count(double(bytes.size())) + Html("; decoded, it takes ") +
               byte_count(double(nook::material::table_bytes(tables))) + Html(" of GPU memory.");
  if (measures.value.contains("se_db"))
    parts.lead += Html(" Against the raw material it has <strong>") + number(measures.value["se_db"]) +
                  Html("&nbsp;dB</strong>, the ratio of the signal to the error.");
  parts.advice = advice_list(Subject::material, measures);
  return parts;
}

}  // namespace nook::report
