// The object behind the public handle of a recorded frame.
#pragma once

#include <nook/experimental/nook_recording.h>

#include <utility>

#include "sdk/src/api/handles.h"
#include "sdk/src/core/ref.h"
#include "sdk/src/nnao/recording.h"

struct nook_nnao_recording_s : nook::RefCounted {
  explicit nook_nnao_recording_s(nook::nnao::Recording recorded) : recording(std::move(recorded)) {}

  const nook::nnao::Recording recording;
};
