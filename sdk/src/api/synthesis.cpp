#include <cmath>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/synthesis_handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/synthesis/coordinates.h"

using namespace nook;

nook_result nook_synthesis_load(nook_context context, const void* bytes, size_t size, nook_synthesis* out) {
  return api::enter("nook_synthesis_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    const auto shared = Ref<nook_context_s>::share(context);
    *out = Owned<nook_synthesis_s>::make(
               context->memory(), shared,
               synthesis::read_coordinates({static_cast<const std::byte*>(bytes), size}, context->memory()))
               .detach();
    context->log(NOOK_LOG_INFO, "synthesis: %u x %u texels, %zu bytes", (*out)->coordinates.side,
                 (*out)->coordinates.side, size);
  });
}

void nook_synthesis_destroy(nook_synthesis* synthesis) {
  if (!synthesis || !*synthesis) return;
  (*synthesis)->release();
  *synthesis = nullptr;
}

nook_result nook_synthesis_describe(nook_synthesis synthesis, nook_synthesis_info* info) {
  return api::enter("nook_synthesis_describe", [&] {
    need(synthesis, "synthesis");
    const synthesis::Coordinates& coordinates = synthesis->coordinates;
    nook_synthesis_info known{};
    known.side = coordinates.side;
    known.material_width = coordinates.width;
    known.material_height = coordinates.height;
    known.texture_bytes = sizeof(synthesis::Cell) * coordinates.cells.size();
    write_info(info, known);
  });
}

nook_result nook_synthesis_material_uvs(nook_synthesis synthesis, const float* plane_uvs, uint32_t count,
                                        float* material_uvs) {
  return api::enter("nook_synthesis_material_uvs", [&] {
    need(synthesis, "synthesis");
    if (count == 0) return;
    need(plane_uvs, "plane_uvs");
    need(material_uvs, "material_uvs");
    for (std::size_t i = 0; i < std::size_t(2) * count; ++i)
      if (!std::isfinite(plane_uvs[i]))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "a coordinate of point %zu is not finite (got %g)", i / 2,
                      double(plane_uvs[i]));
    for (std::size_t i = 0; i < count; ++i) {
      const synthesis::Point at =
          material_point(synthesis->coordinates, {plane_uvs[2 * i], plane_uvs[2 * i + 1]});
      material_uvs[2 * i] = at.u;
      material_uvs[2 * i + 1] = at.v;
    }
  });
}
