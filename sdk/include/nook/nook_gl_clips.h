/* The GLSL that decodes the AO of baked clips in a vertex shader: nook_clips.h.
 *
 * An engine makes two 2D textures of its own from nook_clips_texture_size and nook_clips_read_texture,
 * without mipmaps and with GL_NEAREST, puts the GLSL of nook_gl_clips_glsl after the #version line of its
 * vertex shader, and sets the uniforms nook_clip_modes and nook_clip_weights to their texture units and
 * nook_clip_vec4s to mode_count / 4. nook_clips_frames gives the frames and their share for each character,
 * as uniforms or as attributes of its instance:
 *     float ao = nook_clip_ao(gl_VertexID, frames, share);
 * gl_VertexID counts file vertices, or a vertex attribute does. The shader reads mode_count / 4 texels of the
 * modes, and twice as many of the weights, which are the same for all vertices of a character. */
#ifndef NOOK_GL_CLIPS_H
#define NOOK_GL_CLIPS_H

#include "nook_clips.h"
#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniforms above and
 *     float nook_clip_ao(int vertex, ivec2 frames, float share);
 * Every name in it begins with nook_ or NOOK_. The text is the same for all clips and is never freed.
 * Any thread. */
NOOK_API const char* nook_gl_clips_glsl(void);

#ifdef __cplusplus
}
#endif
#endif
