// The objects behind the public handles of radiance transfer.
#pragma once

#include <nook/experimental/nook_transfer.h>

#include <utility>

#include "sdk/src/api/handles.h"
#include "sdk/src/core/isa.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

struct nook_transfer_s : nook::RefCounted {
  nook_transfer_s(nook_context_s* made_by, nook::transfer::Transfer loaded)
      : context(made_by), transfer(std::move(loaded)) {}

  nook_context_s* context;  // kept alive by this object's owner reference
  const nook::transfer::Transfer transfer;
};

struct nook_transfer_light_s : nook::RefCounted {
  static constexpr std::uint32_t side = 64;

  // If has_cells is false, the light comes from a single direction.
  nook_transfer_light_s(nook_context_s* made_by, bool has_cells)
      : context(made_by),
        cells(has_cells ? side : 0, made_by->memory()),
        radiance(made_by->memory()),
        suns(made_by->memory()) {}

  bool is_directional() const { return cells.size() == 0; }

  nook_context_s* context;  // kept alive by this object's owner reference
  nook::Vec3 direction, irradiance;
  nook::transfer::CubeCells cells;
  nook::Vector<nook::Vec3> radiance;  // radiance of each cell
  nook::Vector<nook::MapSun> suns;
};

struct nook_transfer_response_s : nook::RefCounted {
  nook_transfer_response_s(nook_context_s* made_by, nook::Isa chosen, nook::transfer::Response made)
      : context(made_by), isa(chosen), response(std::move(made)) {}

  nook_context_s* context;  // kept alive by this object's owner reference
  const nook::Isa isa;
  const nook::transfer::Response response;
};
