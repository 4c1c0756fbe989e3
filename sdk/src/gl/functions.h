// The OpenGL functions that Nook calls. There is a list of functions for each tier, and a table of pointers
// for each context. The host's loader fills the table. glad provides only types and constants. The loader of
// glad is not linked, so Nook contains no symbols and no global variables of glad.
#pragma once

#include <glad/gl.h>
#include <nook/nook_gl.h>

namespace nook::gl {

// The functions that every context needs, OpenGL 3.3 core or OpenGL ES 3.0.
#define NOOK_GL_FUNCTIONS_COMMON(X)      \
  X(ActiveTexture)                       \
  X(AttachShader)                        \
  X(BeginTransformFeedback)              \
  X(BindBuffer)                          \
  X(BindBufferBase)                      \
  X(BindBufferRange)                     \
  X(BindFramebuffer)                     \
  X(BindRenderbuffer)                    \
  X(BindSampler)                         \
  X(BindTexture)                         \
  X(BindVertexArray)                     \
  X(BlendEquationSeparate)               \
  X(BlendFuncSeparate)                   \
  X(BufferData)                          \
  X(BufferSubData)                       \
  X(CheckFramebufferStatus)              \
  X(ClearBufferfv)                       \
  X(ColorMask)                           \
  X(CompileShader)                       \
  X(CompressedTexImage3D)                \
  X(CopyBufferSubData)                   \
  X(CreateProgram)                       \
  X(CreateShader)                        \
  X(DeleteBuffers)                       \
  X(DeleteFramebuffers)                  \
  X(DeleteProgram)                       \
  X(DeleteQueries)                       \
  X(DeleteRenderbuffers)                 \
  X(DeleteSamplers)                      \
  X(DeleteShader)                        \
  X(DeleteTextures)                      \
  X(DeleteVertexArrays)                  \
  X(DetachShader)                        \
  X(Disable)                             \
  X(DrawArrays)                          \
  X(DrawArraysInstanced)                 \
  X(DrawElementsInstanced)               \
  X(Enable)                              \
  X(EnableVertexAttribArray)             \
  X(EndTransformFeedback)                \
  X(FramebufferRenderbuffer)             \
  X(FramebufferTexture2D)                \
  X(FramebufferTextureLayer)             \
  X(GenBuffers)                          \
  X(GenFramebuffers)                     \
  X(GenQueries)                          \
  X(GenRenderbuffers)                    \
  X(GenSamplers)                         \
  X(GenTextures)                         \
  X(GenVertexArrays)                     \
  X(GetBooleanv)                         \
  X(GetBufferParameteri64v)              \
  X(GetError)                            \
  X(GetFloatv)                           \
  X(GetFramebufferAttachmentParameteriv) \
  X(GetInteger64i_v)                     \
  X(GetIntegeri_v)                       \
  X(GetIntegerv)                         \
  X(GetProgramInfoLog)                   \
  X(GetProgramiv)                        \
  X(GetShaderInfoLog)                    \
  X(GetShaderiv)                         \
  X(GetString)                           \
  X(GetTexParameteriv)                   \
  X(GetUniformLocation)                  \
  X(IsEnabled)                           \
  X(IsFramebuffer)                       \
  X(IsProgram)                           \
  X(IsTexture)                           \
  X(LinkProgram)                         \
  X(PixelStorei)                         \
  X(ReadPixels)                          \
  X(RenderbufferStorage)                 \
  X(SamplerParameteri)                   \
  X(ShaderSource)                        \
  X(TexImage2D)                          \
  X(TexImage3D)                          \
  X(TexParameteri)                       \
  X(TexSubImage2D)                       \
  X(TexSubImage3D)                       \
  X(TransformFeedbackVaryings)           \
  X(Uniform1f)                           \
  X(Uniform1i)                           \
  X(Uniform1ui)                          \
  X(Uniform2f)                           \
  X(Uniform2i)                           \
  X(Uniform4i)                           \
  X(Uniform4fv)                          \
  X(UseProgram)                          \
  X(VertexAttribIPointer)                \
  X(VertexAttribPointer)                 \
  X(Viewport)

// Additional functions of OpenGL 3.3. Some of these functions also exist in OpenGL ES 3.2, and Nook uses them
// there.
#define NOOK_GL_FUNCTIONS_33(X) \
  X(ColorMaski)                 \
  X(Disablei)                   \
  X(Enablei)                    \
  X(GetBooleani_v)              \
  X(GetBufferSubData)           \
  X(GetQueryObjectui64v)        \
  X(GetTexLevelParameteriv)     \
  X(IsEnabledi)                 \
  X(PolygonMode)                \
  X(QueryCounter)               \
  X(TexBuffer)

// Additional functions of OpenGL ES 3.0.
#define NOOK_GL_FUNCTIONS_ES30(X) X(TexStorage2D)

// Additional functions that the tiers with compute shaders need, in OpenGL 4.3 and OpenGL ES 3.1.
#define NOOK_GL_FUNCTIONS_COMPUTE(X) \
  X(DispatchCompute)                 \
  X(MemoryBarrier)

// Functions that map buffers. All APIs except WebGL have them.
#define NOOK_GL_FUNCTIONS_MAPS(X) \
  X(MapBufferRange)               \
  X(UnmapBuffer)

// Optional functions, which are used only if they exist.
#define NOOK_GL_FUNCTIONS_OPTIONAL(X) \
  X(BindImageTexture)                 \
  X(BindTransformFeedback)            \
  X(BlendEquationSeparatei)           \
  X(BlendFuncSeparatei)               \
  X(ClientWaitSync)                   \
  X(DeleteSync)                       \
  X(DeleteTransformFeedbacks)         \
  X(FenceSync)                        \
  X(GenTransformFeedbacks)            \
  X(GetFloati_v)                      \
  X(InvalidateFramebuffer)            \
  X(ObjectLabel)                      \
  X(ViewportIndexedf)

// Functions that nook_gl_desc.debug needs. Every context has them.
#define NOOK_GL_FUNCTIONS_DEBUG(X) \
  X(BeginQuery)                    \
  X(EndQuery)                      \
  X(GetQueryObjectuiv)             \
  X(GetVertexAttribiv)             \
  X(IsVertexArray)                 \
  X(VertexAttribDivisor)

#define NOOK_GL_FUNCTIONS_ALL(X) \
  NOOK_GL_FUNCTIONS_COMMON(X)    \
  NOOK_GL_FUNCTIONS_33(X)        \
  NOOK_GL_FUNCTIONS_ES30(X)      \
  NOOK_GL_FUNCTIONS_MAPS(X)      \
  NOOK_GL_FUNCTIONS_COMPUTE(X)   \
  NOOK_GL_FUNCTIONS_DEBUG(X)     \
  NOOK_GL_FUNCTIONS_OPTIONAL(X)

// The three APIs. They differ in the features that a context guarantees, and in the #version line of shaders.
enum class Profile { desktop, es, webgl };

// Features of a context beyond the minimum that Nook needs. load_functions sets them once, from the profile,
// the version, the loader and the host's limit. All other code must read these flags and never compare
// versions.
struct Abilities {
  bool compute = false;           // compute shaders and shader storage
  bool compute_images = false;    // compute shaders can also write images
  bool texture_buffers = false;   // if false, tables of texels are 2D textures
  bool maps = false;              // buffers can be mapped; if false, writes copy
  bool buffer_reads = false;      // glGetBufferSubData; if false, reads map the buffer
  bool indexed_feedback = false;  // draws may use indices during transform feedback, which OpenGL ES forbids
                                  // before 3.2
  bool norm16_targets = false;    // GL_RG16 can be drawn into
  bool r8_images = false;         // compute shaders write GL_R8
  bool texture_sizes = false;     // glGetTexLevelParameteriv
  bool sample_textures = false;   // GL_TEXTURE_2D_MULTISAMPLE
  bool sample_arrays = false;     // GL_TEXTURE_2D_MULTISAMPLE_ARRAY
  bool timestamps = false;        // glQueryCounter, and fences that show when its results are available
  bool indexed_draw_buffers = false;  // each draw buffer has its own blending and colour mask
  bool indexed_viewports = false;     // each viewport has its own rectangle and scissor test
  bool desktop_raster =
      false;  // polygon mode, primitive restart by index, sRGB switch, logic op, clip distances
  bool query_buffers = false;     // GL_QUERY_BUFFER
  bool stencil_textures = false;  // GL_DEPTH_STENCIL_TEXTURE_MODE
  bool rgtc_textures = false;     // GL_COMPRESSED_SIGNED_RG_RGTC2
  bool eac_textures = false;      // GL_COMPRESSED_SIGNED_RG11_EAC
};

struct Functions {
#define NOOK_X(name) decltype(GladGLContext::name) name = nullptr;
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
  Profile profile = Profile::desktop;
  int version = 0;  // version of the context, 10 * major + minor
  Abilities can;
  bool limited_by_host = false;  // the context has compute shaders, but max_tier excludes them
};

// Returns the value of nook_gl_info.tier.
int tier_of(const Functions& gl);
// Returns "OpenGL" or "OpenGL ES", for messages.
const char* api_name(const Functions& gl);

// Throws Failure. The message of UNSUPPORTED names the function that get_proc did not return, or the version
// that is too low. If `debug` is true, the functions for nook_gl_desc.debug are loaded too.
Functions load_functions(nook_gl_proc_fn get_proc, void* user, int max_tier, bool debug);

// Small functions with which the state guard reads and sets OpenGL state.

inline GLint integer(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

inline void set_enabled(const Functions& gl, GLenum capability, bool enabled) {
  enabled ? gl.Enable(capability) : gl.Disable(capability);
}

}  // namespace nook::gl
