/* Calibration of character models: the poses that your game shows, recorded for the baker, and what the baker
 * says about a model. Record some hundred poses of play, spread over time:
 *     size_t size = 0;
 *     nook_scene_record_pose(scene, instance, NULL, &size);
 *     nook_scene_record_pose(scene, instance, bytes, &size);
 *     fwrite(bytes, 1, size, poses);  // opened with "ab"
 * Then `nook bake character HERO.glb --model HERO.nook --calibrate POSES -o NEW.nook` fits the constant and
 * the scale of each vertex to them, and changes nothing else. */
#ifndef NOOK_CALIBRATION_H
#define NOOK_CALIBRATION_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the pose of an instance as one record: pass bytes as NULL to get its size, which is the same for
 * each pose of a model. A file of poses is records one after another, of any number of bodies; the baker
 * takes those whose bones are its own. All numbers are little-endian: 8 bytes "NOOKPOSE"; the version, 1, and
 * the number of bones, 4 bytes each; 8 bytes of XXH64 of the bones' names, each with a zero byte behind it;
 * and 12 floats for each bone, rest space to world, three rows of rotation and scale | translation.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (also where *size is too small; *size
 * becomes the size that is needed), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_record_pose(nook_scene scene, nook_instance_id instance, void* bytes,
                                            size_t* size);

/* Gives the recipe of a model, a JSON object, valid while the model lives. Its entry "judged" has the error
 * on poses that were not fitted: over_static and over_static_by_area, against the AO of the rest pose;
 * over_oracle, against the best static bake; worst_clip_over_static; on, the kind of poses; and poses, their
 * number. A pipeline may refuse a model by these values. Models of earlier bakes lack the entry, and the text
 * may be empty. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_model_recipe(nook_model model, const char** json);

#ifdef __cplusplus
}
#endif
#endif
