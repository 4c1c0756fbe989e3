// The objects behind the public handles of probes.
#pragma once

#include <nook/nook_probe.h>

#include <utility>

#include "sdk/src/api/handles.h"
#include "sdk/src/core/ref.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe.h"

struct nook_probe_fit_s : nook::RefCounted {
  nook_probe_fit_s(nook_context_s* made_by, const nook::probe::Basis& basis,
                   const nook::probe::FitSettings& settings)
      : context(made_by), fit(basis, settings, made_by->memory()) {}

  nook_context_s* context;  // kept alive by this object's owner reference
  nook::probe::Fit fit;
};

struct nook_probe_s : nook::RefCounted {
  explicit nook_probe_s(nook::probe::Probes loaded) : probes(std::move(loaded)) {}

  const nook::probe::Probes probes;
};
