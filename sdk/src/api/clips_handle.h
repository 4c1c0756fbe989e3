// The object behind nook_clips.
#pragma once

#include <nook/nook_clips.h>

#include <atomic>

#include "sdk/src/api/handles.h"
#include "sdk/src/character/loaded_clips.h"

struct nook_clips_s : Meter, nook::LoadedClips {
  // make(Memory*) must return the ClipSet, allocated from that memory.
  template <class Make>
  nook_clips_s(nook_context_s* made_by, nook::Ref<const nook::LoadedModel> of, Make&& make)
      : Meter(made_by->memory()), LoadedClips(make(&metered), std::move(of), &metered), context(made_by) {}

  nook_context_s* context;                 // kept alive by this object's owner reference
  std::atomic<std::uint32_t> reported{0};  // topics of PoseNotes that were already logged, for the functions
                                           // that read poses and capsules
};
