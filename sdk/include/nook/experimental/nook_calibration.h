/* Calibration of character models. You record poses from your game, and the baker fits the model to these
 * poses. You can also read the errors that the baker measured for a model. Record a few hundred poses of
 * gameplay, spread over time:
 *     size_t size = 0;
 *     nook_scene_record_pose(scene, instance, NULL, &size);
 *     nook_scene_record_pose(scene, instance, bytes, &size);
 *     fwrite(bytes, 1, size, poses);  // opened with "ab"
 * Then `nook bake character HERO.glb --model HERO.nook --calibrate POSES -o NEW.nook` fits two numbers for
 * each vertex to these poses: the constant and the scale of its AO. It changes nothing else. */
#ifndef NOOK_CALIBRATION_H
#define NOOK_CALIBRATION_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the pose of an instance as one record. Pass `bytes` as NULL to get the size, which is the same for
 * all poses of a model. A pose file is a sequence of records, from any number of bodies; the baker uses the
 * records whose bones match its character. All numbers in a record are little-endian. A record begins with
 * the 8 bytes "NOOKPOSE". The version, which is 1, and the number of bones follow in 4 bytes each. The next 8
 * bytes are the XXH64 hash of all bone names, each followed by a zero byte. The record ends with 12 floats
 * for each bone, the matrix from rest space to world space: three rows of rotation and scale | translation.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (also if *size is too small; *size is
 * then the required size), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_record_pose(nook_scene scene, nook_instance_id instance, void* bytes,
                                            size_t* size);

/* Gives the recipe of a model (its bake settings and measured errors) as the text of a JSON object. The text
 * is valid while the model lives. The entry "judged" contains the error of the model on poses that were not
 * used for the fit. over_static and over_static_by_area are this error relative to the error of the rest
 * pose's AO. over_oracle is this error relative to the error of the best possible static bake.
 * worst_clip_over_static is the value of over_static for the worst clip. "on" names the kind of poses that
 * were used, and "poses" is their number. Your pipeline can reject a model by these values. A model from an
 * earlier version of the baker may lack "judged", and its recipe may be an empty text. Any thread. Errors:
 * INVALID_ARGUMENT. */
NOOK_API nook_result nook_model_recipe(nook_model model, const char** json);

#ifdef __cplusplus
}
#endif
#endif
