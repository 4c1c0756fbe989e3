// Logs poses that were accepted but are probably not what the host meant.
#pragma once

#include <atomic>
#include <cstdint>

#include "sdk/src/character/scene.h"
#include "sdk/src/core/context.h"

namespace nook::api {

// Both log the topics of the notes that were not reported yet, and mark them as reported.
void log_pose(const Context& context, Instance& instance, const PoseNotes& notes);
// subject names the object or function whose pose it is.
void log_pose(const Context& context, const char* subject, const CharacterModel& model,
              const PoseNotes& notes, std::atomic<std::uint32_t>& reported);
// Logs that instances whose poses are on the GPU do not darken the world, once for each instance.
void log_without_world_casters(const Context& context, Scene& scene);

}  // namespace nook::api
