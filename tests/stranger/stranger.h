/* A program that follows the documents to the letter: README.md, docs/start.md, docs/poses.md and docs/guide.
 * It includes public headers only. Its functions are the snippets of those pages. */
#ifndef STRANGER_H
#define STRANGER_H

#include <nook/nook_character.h>

#include "tests/stranger/engine.h"

typedef struct stranger {
  engine engine;
  nook_context context;
  nook_model model; /* in the order of the engine's own vertices */
  nook_scene scene;
  nook_instance_id hero, neighbour;
  float unit; /* of the world, in units for each metre */
  nook_model_info info;
  uint32_t* order; /* the file's vertex of each of the engine's vertices */
  int32_t* transform_of_bone;
  uint32_t unnamed_bones; /* bones without a node of their name */
  int failures;
} stranger;

/* Loads both files. Returns 0 on failure and prints the reason. */
int stranger_start(stranger* s, const char* model_path, const char* engine_path);
void stranger_stop(stranger* s);

/* Counts and prints a failure unless ok. */
void stranger_expect(stranger* s, int ok, const char* format, ...);
/* Ends the program with Nook's message unless the result is NOOK_OK. */
void stranger_need(nook_result result, const char* what);

/* The engine's matrices, and the descriptor that names their kind and layout. */
typedef struct stranger_pose {
  nook_pose_desc desc;
  float* transforms;
} stranger_pose;

/* The skinning matrices of a skin of the file, or the world matrices of all nodes. `place` is 3x4, row-major,
 * and may be NULL. */
stranger_pose stranger_skinning_pose(const stranger* s, uint32_t frame, uint32_t skin, const float* place);
stranger_pose stranger_joint_pose(const stranger* s, uint32_t frame, const float* place);
/* Writes the transforms, which are columns of 4x4, in another layout. */
void stranger_change_layout(stranger_pose* pose, nook_transform_layout layout);
void stranger_free_pose(stranger_pose* pose);

/* Poses an instance by one pose for each skin; the bones of rigid meshes take joint matrices. */
void stranger_set_skinning_pose(stranger* s, nook_instance_id instance, uint32_t frame,
                                nook_transform_layout layout, const float* place);
void stranger_set_joint_pose(stranger* s, nook_instance_id instance, uint32_t frame,
                             nook_transform_layout layout, const float* place);
/* Updates the scene and reads the AO of the engine's vertices. */
void stranger_read_ao(stranger* s, float* ao);

/* The place in the file's order of one of the engine's vertices. */
uint32_t stranger_file_vertex(const stranger* s, uint32_t own);
/* Where the engine's skinning puts the model's check vertices, in the engine's model space. */
float* stranger_check_positions(const stranger* s, uint32_t frame);
/* place: of the positions. */
nook_pose_check_info stranger_check(const stranger* s, const nook_pose_desc* pose, const float* positions,
                                    const float* place);

/* The parts of the program. */
/* The AO of each frame in each kind, layout and place; writes it in the order of the file. */
void stranger_run_layouts(stranger* s, const char* ao_path);
/* The error against ray tracing, alone and beside another body on the ground; bound: the largest mse_visible.
 */
void stranger_run_truth(stranger* s, float bound);
void stranger_run_checks(stranger* s);
void stranger_run_mistakes(stranger* s);
void stranger_run_pictures(stranger* s);
/* The lines of the pages, on a file of one mesh and one skin. */
void stranger_run_documents(stranger* s, const char* model_path);

#endif
