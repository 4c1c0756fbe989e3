#include "bakers/measure/material/material_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "bakers/material/btf_error.h"
#include "sdk/src/material/reflectance.h"

namespace nook::measure {
namespace {

using bake::Colour;
using bake::Picture;
using bake::material::RawMaterial;
using nook::material::VisibilityForm;

constexpr int gap_px = 4;
constexpr Colour ground{0.3f, 0.3f, 0.32f};

// Returns the display value for a radiance that was computed under a light of irradiance pi.
float display(float radiance) {
  return std::pow(std::clamp(std::numbers::pi_v<float> * radiance, 0.0f, 1.0f), 1 / 2.2f);
}

// Draws a cell of the sheet, with `tiles` copies of the tile along each axis. y points up.
Picture cell(std::uint32_t width, std::uint32_t height, std::uint32_t tiles,
             const std::function<Colour(std::size_t x, std::size_t y)>& colour) {
  Picture p{int(width * tiles) + gap_px, int(height * tiles) + gap_px, {}};
  p.rgb.assign(3 * std::size_t(p.width) * std::size_t(p.height), 255);
  for (std::size_t y = 0; y < height * tiles; ++y)
    for (std::size_t x = 0; x < width * tiles; ++x) {
      const Colour c = colour(x % width, y % height);
      const std::size_t row = height * tiles - 1 - y;
      for (std::size_t i = 0; i < 3; ++i)
        p.rgb[3 * (row * std::size_t(p.width) + x) + i] =
            std::uint8_t(std::lround(255 * std::clamp(c[i], 0.0f, 1.0f)));
    }
  return p;
}

// Returns the index of the direction in `set` whose tilt is nearest to tilt_deg.
std::size_t of_tilt(const std::vector<Vec3>& set, float tilt_deg) {
  const float z = std::cos(tilt_deg * std::numbers::pi_v<float> / 180);
  return std::size_t(std::min_element(set.begin(), set.end(),
                                      [z](Vec3 a, Vec3 b) { return std::abs(a.z - z) < std::abs(b.z - z); }) -
                     set.begin());
}

Colour raw_radiance(const RawMaterial& raw, std::size_t light, std::size_t view, std::size_t texel) {
  Colour c;
  for (std::size_t i = 0; i < 3; ++i)
    c[i] = raw.btf[((3 * light + i) * raw.views.size() + view) * raw.texels() + texel];
  return c;
}

Colour shown(Colour radiance, bool visible) {
  if (!visible) return ground;
  for (float& c : radiance) c = display(c);
  return radiance;
}

// Returns the absolute difference of two radiances under a light of irradiance pi, multiplied by `times`.
Colour difference(Colour a, Colour b, float times) {
  Colour c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = times * std::numbers::pi_v<float> * std::abs(a[i] - b[i]);
  return c;
}

bool visible(const RawMaterial& raw, std::size_t view, std::size_t texel) {
  return raw.mask.empty() || raw.mask[view * raw.texels() + texel] > 0.5f;
}

// Draws one view of a raw material, and beside it the same view of a compressed material.
class ViewDrawing {
 public:
  ViewDrawing(const RawMaterial& raw, std::size_t light, std::size_t view)
      : raw_(raw), light_(light), view_(view) {}

  Picture traced() const {
    return draw([&](std::size_t texel) { return shown(traced_at(texel), true); });
  }
  // Returns the decoded material, and the absolute difference times three.
  std::array<Picture, 2> decoded(const nook::material::Material& material) const {
    const auto values = bake::material::decode_btf_view(material, view_);
    const auto at = [&](std::size_t texel) {
      Colour c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = values(Eigen::Index(3 * light_ + i), Eigen::Index(texel));
      return c;
    };
    return {draw([&](std::size_t texel) { return shown(at(texel), true); }),
            draw([&](std::size_t texel) { return difference(traced_at(texel), at(texel), 3); })};
  }
  // Returns the decoded mask. It is red where it differs from the traced mask.
  Picture mask(const nook::material::Material& material) const {
    const std::vector<float> value = bake::material::decode_votf_view(material.votf, view_);
    const float threshold = material.visibility == VisibilityForm::binary ? 0.5f : 0;
    return draw([&](std::size_t texel) {
      const bool truth = visible(raw_, view_, texel), got = value[texel] > threshold;
      const float grey = got ? 0.85f : 0.15f;
      return truth == got ? Colour{grey, grey, grey} : Colour{0.9f, 0.1f, 0.1f};
    });
  }

 private:
  Colour traced_at(std::size_t texel) const { return raw_radiance(raw_, light_, view_, texel); }
  Picture draw(const std::function<Colour(std::size_t texel)>& colour) const {
    return cell(raw_.width, raw_.height, 2,
                [&](std::size_t x, std::size_t y) { return colour(x * raw_.height + y); });
  }

  const RawMaterial& raw_;
  std::size_t light_, view_;
};

// Draws the rows that compare one view.
Picture compare_view(const RawMaterial& raw, const nook::material::Material& material, std::size_t light,
                     std::size_t view) {
  const ViewDrawing drawing(raw, light, view);
  const std::array<Picture, 2> decoded = drawing.decoded(material);
  std::vector<Picture> rows{drawing.traced(), decoded[0], decoded[1]};
  if (material.visibility != VisibilityForm::none && !raw.mask.empty())
    rows.push_back(drawing.mask(material));
  return below_each_other(rows);
}

}  // namespace

Picture below_each_other(std::span<const Picture> pictures) {
  Picture all{pictures.front().width, 0, {}};
  for (const Picture& p : pictures) {
    all.height += p.height;
    all.rgb.insert(all.rgb.end(), p.rgb.begin(), p.rgb.end());
  }
  return all;
}

Picture raw_sheet(const RawMaterial& raw) {
  std::vector<Picture> columns;
  for (const float view_tilt : {0.0f, 25.0f, 50.0f, 70.0f}) {
    const std::size_t view = of_tilt(raw.views, view_tilt);
    std::vector<Picture> column;
    for (const float light_tilt : {15.0f, 45.0f, 70.0f}) {
      const std::size_t light = of_tilt(raw.lights, light_tilt);
      column.push_back(cell(raw.width, raw.height, 2, [&](std::size_t x, std::size_t y) {
        const std::size_t texel = x * raw.height + y;
        return shown(raw_radiance(raw, light, view, texel), visible(raw, view, texel));
      }));
    }
    if (!raw.mask.empty())
      column.push_back(cell(raw.width, raw.height, 2, [&](std::size_t x, std::size_t y) {
        const float grey = visible(raw, view, x * raw.height + y) ? 0.85f : 0.15f;
        return Colour{grey, grey, grey};
      }));
    columns.push_back(below_each_other(column));
  }
  return bake::side_by_side(columns);
}

Picture difference_sheet(const RawMaterial& raw, const nook::material::Material& material) {
  const std::size_t light = of_tilt(raw.lights, 45);
  const Picture views[] = {compare_view(raw, material, light, of_tilt(raw.views, 15)),
                           compare_view(raw, material, light, of_tilt(raw.views, 55))};
  return bake::side_by_side(views);
}

Picture methods_sheet(const RawMaterial& raw, std::span<const nook::material::Material> materials) {
  const ViewDrawing drawing(raw, of_tilt(raw.lights, 45), of_tilt(raw.views, 55));
  const Picture traced = drawing.traced();
  Picture blank = traced;
  std::fill(blank.rgb.begin(), blank.rgb.end(), std::uint8_t{255});
  std::vector<Picture> columns{below_each_other(std::array{traced, blank})};
  for (const nook::material::Material& material : materials)
    columns.push_back(below_each_other(drawing.decoded(material)));
  return bake::side_by_side(columns);
}

Picture jump_strip(const nook::material::Material& material, const bake::material::ViewJumps& jumps) {
  const auto tables = nook::material::make_tables(material, {}, default_memory());
  const Vec3 light = material.lights[of_tilt({material.lights.begin(), material.lights.end()}, 45)];
  const auto radiance = [&](Vec3 view, std::size_t x, std::size_t y) {
    const nook::material::Radiance r =
        evaluate_btf(tables, {(float(x) + 0.5f) / float(tables.btf.width),
                              (float(y) + 0.5f) / float(tables.btf.height), 0, view, light});
    return Colour{r.red, r.green, r.blue};
  };
  const auto draw = [&](const auto& colour) { return cell(tables.btf.width, tables.btf.height, 2, colour); };
  const Picture frames[] = {
      draw([&](std::size_t x, std::size_t y) { return shown(radiance(jumps.before, x, y), true); }),
      draw([&](std::size_t x, std::size_t y) { return shown(radiance(jumps.after, x, y), true); }),
      draw([&](std::size_t x, std::size_t y) {
        return difference(radiance(jumps.before, x, y), radiance(jumps.after, x, y), 10);
      })};
  return bake::side_by_side(frames);
}

}  // namespace nook::measure
