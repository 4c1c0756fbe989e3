// The OpenGL functions that Nook calls: one list for each tier, and one table for each context, which the
// host's loader fills. glad supplies only the types and constants; its loader is not linked, so that none of
// its symbols and none of its memory exists.
#pragma once

#include <glad/gl.h>
#include <nook/nook_gl.h>

namespace nook::gl {

// The functions that every context needs: OpenGL 3.3 core.
#define NOOK_GL_FUNCTIONS_33(X)          \
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
  X(ColorMaski)                          \
  X(CompileShader)                       \
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
  X(Disablei)                            \
  X(DrawArrays)                          \
  X(DrawElementsInstanced)               \
  X(Enable)                              \
  X(EnableVertexAttribArray)             \
  X(Enablei)                             \
  X(EndTransformFeedback)                \
  X(FramebufferRenderbuffer)             \
  X(FramebufferTexture2D)                \
  X(GenBuffers)                          \
  X(GenFramebuffers)                     \
  X(GenQueries)                          \
  X(GenRenderbuffers)                    \
  X(GenSamplers)                         \
  X(GenTextures)                         \
  X(GenVertexArrays)                     \
  X(GetBooleani_v)                       \
  X(GetBufferParameteri64v)              \
  X(GetBufferSubData)                    \
  X(GetError)                            \
  X(GetFloatv)                           \
  X(GetFramebufferAttachmentParameteriv) \
  X(GetInteger64i_v)                     \
  X(GetIntegeri_v)                       \
  X(GetIntegerv)                         \
  X(GetProgramInfoLog)                   \
  X(GetProgramiv)                        \
  X(GetQueryObjectiv)                    \
  X(GetQueryObjectui64v)                 \
  X(GetShaderInfoLog)                    \
  X(GetShaderiv)                         \
  X(GetString)                           \
  X(GetTexLevelParameteriv)              \
  X(GetTexParameteriv)                   \
  X(GetUniformLocation)                  \
  X(IsEnabled)                           \
  X(IsEnabledi)                          \
  X(IsFramebuffer)                       \
  X(IsProgram)                           \
  X(IsTexture)                           \
  X(LinkProgram)                         \
  X(MapBufferRange)                      \
  X(PixelStorei)                         \
  X(PolygonMode)                         \
  X(QueryCounter)                        \
  X(RenderbufferStorage)                 \
  X(SamplerParameteri)                   \
  X(ShaderSource)                        \
  X(TexBuffer)                           \
  X(TexImage2D)                          \
  X(TexImage3D)                          \
  X(TexParameteri)                       \
  X(TexSubImage2D)                       \
  X(TransformFeedbackVaryings)           \
  X(Uniform1f)                           \
  X(Uniform1i)                           \
  X(Uniform1ui)                          \
  X(Uniform2i)                           \
  X(Uniform4fv)                          \
  X(UnmapBuffer)                         \
  X(UseProgram)                          \
  X(VertexAttribIPointer)                \
  X(VertexAttribPointer)                 \
  X(Viewport)

// The functions that OpenGL 4.3 needs in addition, if the tier may be 43.
#define NOOK_GL_FUNCTIONS_43(X) \
  X(DispatchCompute)            \
  X(MemoryBarrier)

// Functions that are used only if they exist.
#define NOOK_GL_FUNCTIONS_OPTIONAL(X) \
  X(BindImageTexture)                 \
  X(BindTransformFeedback)            \
  X(BlendEquationSeparatei)           \
  X(BlendFuncSeparatei)               \
  X(DeleteTransformFeedbacks)         \
  X(GenTransformFeedbacks)            \
  X(GetFloati_v)                      \
  X(ObjectLabel)                      \
  X(ViewportIndexedf)

// Abilities of a context beyond the minimum that Nook needs. load_functions derives them once from the
// version, the loader and the host's limit; all other code reads them and compares no version.
struct Abilities {
  bool compute = false;            // compute shaders and shader storage
  bool compute_images = false;     // compute shaders that write images, too
  bool indexed_viewports = false;  // viewport and scissor test exist once for each index
  bool query_buffers = false;      // GL_QUERY_BUFFER
  bool stencil_textures = false;   // GL_DEPTH_STENCIL_TEXTURE_MODE
};

struct Functions {
#define NOOK_X(name) decltype(GladGLContext::name) name = nullptr;
  NOOK_GL_FUNCTIONS_33(NOOK_X)
  NOOK_GL_FUNCTIONS_43(NOOK_X)
  NOOK_GL_FUNCTIONS_OPTIONAL(NOOK_X)
#undef NOOK_X
  int version = 0;  // of the context, 10 * major + minor
  Abilities can;
  bool limited_by_host = false;  // could compute, if max_tier did not forbid it
};

// Throws Failure: UNSUPPORTED names the function that get_proc did not return, or the version that is too
// low.
Functions load_functions(nook_gl_proc_fn get_proc, void* user, int max_tier);

}  // namespace nook::gl
