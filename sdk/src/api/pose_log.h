// Logs warnings about poses and grounds that were accepted, but that are probably not what the host meant.
#pragma once

#include <atomic>
#include <cstdint>

#include "sdk/src/character/scene.h"
#include "sdk/src/core/context.h"

namespace nook::api {

// Both overloads log the topics of `notes` that were not logged before, and mark these topics as logged.
void log_pose(const Context& context, Instance& instance, const PoseNotes& notes);
// `subject` is the name of the object or function to which the pose belongs.
void log_pose(const Context& context, const char* subject, const CharacterModel& model,
              const PoseNotes& notes, std::atomic<std::uint32_t>& reported);
// For each instance whose pose is on the GPU, logs once that the instance does not darken the world.
void log_without_world_casters(const Context& context, Scene& scene);
// Logs faults of bodies, each once per instance. A body may be mostly below its ground, or far above it. It
// may be far larger than in the rest pose, inside an occluder, or at the place of a body that darkens it. If
// the maximum distance of links is too short for all bodies, logs this once for the scene. Call it after each
// update. Each call checks only the next few instances, so its cost does not depend on the size of the crowd.
void log_bodies(nook_scene_s& scene);

// Logs once per instance if its AO is read before the first update on the CPU. You may call it on every
// thread that may read the instance.
void log_missing_update(const Context& context, Instance& instance);

}  // namespace nook::api
