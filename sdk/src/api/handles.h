// The objects behind the public handles.
#pragma once

#include <nook/nook_character.h>

#include <atomic>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/context.h"

struct nook_context_s final : nook::Context {
  using Context::Context;

 private:
  // It lies in memory of its own allocator, which a copy outlives.
  void destroy() noexcept override {
    nook::HostMemory memory(allocator());
    this->~nook_context_s();
    static_cast<std::pmr::memory_resource&>(memory).deallocate(this, sizeof *this, alignof(nook_context_s));
  }
};

struct nook_character_model_s : nook::LoadedModel {
  nook_character_model_s(nook::Ref<nook_context_s> made_by, nook::CharacterModel loaded)
      : LoadedModel(std::move(loaded), made_by->memory()), context(made_by.get()) {}

  nook_context_s* context;  // kept alive by this object's owner reference
};

struct nook_scene_s : nook::RefCounted {
  nook_scene_s(nook_context_s* made_by, const nook::SceneSettings& settings)
      : context(made_by), scene(settings, made_by->parallel(), made_by->memory()) {}

  nook_context_s* context;             // kept alive by this object's owner reference
  std::atomic<bool> destroyed{false};  // the host let go of it; what others hold for it is of no more use
  nook::Scene scene;
};
