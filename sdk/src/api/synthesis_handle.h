// The object behind the handle nook_synthesis.
#pragma once

#include <nook/experimental/nook_synthesis.h>

#include <utility>

#include "sdk/src/api/handles.h"
#include "sdk/src/synthesis/coordinates.h"

struct nook_synthesis_s : nook::RefCounted {
  explicit nook_synthesis_s(nook::synthesis::Coordinates loaded) : coordinates(std::move(loaded)) {}

  const nook::synthesis::Coordinates coordinates;
};
