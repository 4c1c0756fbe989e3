#include "bakers/material/seen_views.h"

#include <algorithm>

#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/material/view_cells.h"

namespace nook::bake::material {
namespace {

using nook::material::ClusteredTensor;
using nook::material::Material;
using nook::material::VisibilityForm;

void replace_views(ClusteredTensor& tensor, const Material& material, const std::vector<Vec3>& views) {
  const nook::material::ViewCells cells =
      nook::material::view_cells(tensor, material.views, nook::material::default_map_side, default_memory());
  const std::size_t terms = cells.terms, count = terms * tensor.shape.rank_view;
  nook::material::ViewRows rows;
  for (const Vec3 view : views) {
    const nook::material::ParabolicPoint p = nook::material::to_parabolic(view);
    const auto place = [&](float at) { return std::clamp(0.5f * at + 0.5f, 0.0f, 1.0f) * float(cells.side); };
    const std::size_t cell = nook::material::cell_of(view, cells.side);
    const nook::material::CellBlend blend = nook::material::blend_at(
        place(p.x), place(p.y), cells.side,
        cells.neighbours.empty() ? nook::material::no_neighbours : cells.neighbours[cell]);
    const auto first = cells.rows.membership.begin() + std::ptrdiff_t(cell * terms);
    rows.membership.insert(rows.membership.end(), first, first + std::ptrdiff_t(terms));
    for (std::size_t i = 0; i < count; ++i) {
      float sum = 0;
      for (int n = 0; n < 3; ++n) sum += blend.weight[n] * cells.rows.coefficients[blend.cell[n] * count + i];
      rows.coefficients.push_back(sum);
    }
  }
  tensor.rows = std::move(rows);
  tensor.map = nook::material::ViewMap();
  tensor.shape.views = std::uint32_t(views.size());
  tensor.shape.mixture = std::uint32_t(terms);
}

}  // namespace

Material as_seen_from(const Material& material, const std::vector<Vec3>& views) {
  Material seen = material;
  if (!material.neural.is_used()) replace_views(seen.btf, material, views);
  if (material.visibility != VisibilityForm::none) replace_views(seen.votf, material, views);
  seen.views.assign(views.begin(), views.end());
  return seen;
}

void light_from(Material& material, const std::vector<Vec3>& lights) {
  const nook::material::DirectionMesh mesh(material.lights);
  const std::size_t rank = material.btf.shape.rank_light;
  Vector<float> basis;
  std::size_t hint = 0;
  for (const Vec3 light : lights) {
    const nook::material::DirectionMix mix = mesh.locate(nook::material::to_parabolic(light), hint);
    const float share = nook::material::low_light_share(material.lights, mix, light.z);
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (std::size_t a = 0; a < rank; ++a) {
        float sum = 0;
        for (int i = 0; i < 3; ++i)
          sum += mix.weight[i] * material.light_basis[(3 * std::size_t(mix.index[i]) + channel) * rank + a];
        basis.push_back(share * sum);
      }
  }
  material.light_basis = std::move(basis);
  material.lights.assign(lights.begin(), lights.end());
}

}  // namespace nook::bake::material
