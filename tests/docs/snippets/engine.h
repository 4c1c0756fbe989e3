// The snippets of the documents stand in an engine; this is the part of it that they use.
#ifdef __cplusplus
#include <nook/nook.hpp>
#endif
#include <nook/experimental/nook_capture.h>
#include <nook/experimental/nook_clip_crowds.h>
#include <nook/experimental/nook_gl_poses.h>
#include <nook/experimental/nook_streaming.h>
#include <nook/experimental/nook_synthesis.h>
#include <nook/experimental/nook_transfer.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_bake.h>
#include <nook/nook_character.h>
#include <nook/nook_clips.h>
#include <nook/nook_gl.h>
#include <nook/nook_material.h>
#include <nook/nook_nnao.h>
#include <nook/nook_probe.h>
#include <nook/nook_world.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* OpenGL as an engine's loader declares it. */
typedef unsigned GLuint;
typedef unsigned GLenum;
typedef int GLint;
typedef int GLsizei;
enum {
  GL_ARRAY_BUFFER = 0x8892,
  GL_TEXTURE_3D = 0x806F,
  GL_TEXTURE_BUFFER = 0x8C2A,
  GL_FLOAT = 0x1406,
  GL_FALSE = 0
};
void glBindBuffer(GLenum target, GLuint buffer);
void glEnableVertexAttribArray(GLuint slot);
void glBindTexture(GLenum target, GLuint texture);
void glVertexAttribPointer(GLuint slot, GLint size, GLenum type, unsigned char normalized, GLsizei stride,
                           const void* at);
GLint glGetUniformLocation(GLuint program, const char* name);
void glUniform1i(GLint location, GLint value);
void glUniform4fv(GLint location, GLsizei count, const float* values);

extern nook_context context;
extern nook_model model;
extern int8_t* occluded;
extern uint32_t file_vertex_count;
extern nook_scene scene;
extern nook_gl gl;
extern void* get_proc(void* user, const char* name);
extern const void* bytes;
extern size_t size;
extern nook_instance_id hero, horse, instance, id, ids[10000];
extern nook_instance_clip crowd[10000];
extern nook_gl_pool_view pool_views[10000];
extern nook_occluder_id shield;
extern float centre_ws[3], camera_position_ws[3], position_ws[3];
extern float skinning_matrices[16], model_to_world[12], projection[16], view[16];
extern uint32_t joint_count, vertex_count, point_count, slot, count, float_count;
extern float ao[4], positions[12], normals[12];
extern int width, height, first_unit;
extern double seconds;
extern void* texels;
extern GLuint depth, program, motion, character_ao, character_mask;
