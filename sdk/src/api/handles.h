// The objects behind the public handles.
#pragma once

#include <nook/nook_character.h>

#include <atomic>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/context.h"
#include "sdk/src/transfer/lobe_fit.h"

struct nook_context_s final : nook::Context {
  using Context::Context;

  // A cache of fits for nook_transfer_light_project.
  nook::transfer::FitCache lobe_fits{memory()};

 private:
  // This object contains the allocator from which its own memory comes. So `destroy` first copies the
  // allocator, and then frees the memory with the copy.
  void destroy() noexcept override {
    nook::HostMemory memory(allocator());
    this->~nook_context_s();
    static_cast<nook::Memory&>(memory).deallocate(this, sizeof *this, alignof(nook_context_s));
  }
};

// The meter is in a base class, so that it is destroyed after the arrays of the derived object, which use it.
struct Meter {
  explicit Meter(nook::Memory* source) noexcept : metered(source) {}
  nook::MeteredMemory metered;
};

struct nook_model_s : Meter, nook::LoadedModel {
  // make(Memory*) must return the CharacterModel, allocated from that memory.
  template <class Make>
  nook_model_s(nook::Ref<nook_context_s> made_by, Make&& make)
      : Meter(made_by->memory()), LoadedModel(make(&metered), &metered), context(made_by.get()) {}

  nook_context_s* context;  // kept alive by this object's owner reference
  // Bits of the PoseNotes topics that were already logged for conversions with this model.
  std::atomic<std::uint32_t> reported{0};
};

namespace nook {

// Throws Failure for a setting that is out of range.
SceneSettings settings_of(const nook_scene_desc& desc, const Context& context);

}  // namespace nook

struct nook_scene_s : Meter, nook::RefCounted {
  nook_scene_s(nook_context_s* made_by, const nook::SceneSettings& settings)
      : Meter(made_by->memory()), context(made_by), scene(settings, made_by->parallel(), &metered) {}

  nook_context_s* context;  // kept alive by this object's owner reference
  // True after the host destroyed the scene. Data that other objects still keep for the scene must then not
  // be used.
  std::atomic<bool> destroyed{false};
  // True after the log has said that the distance of nook_scene_link_nearest links nobody.
  bool links_reported = false;
  nook::Scene scene;
};
