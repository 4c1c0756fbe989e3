#include "sdk/src/gl/nnao/host_images.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/gl/touched_state.h"

namespace nook::gl {
namespace {

// Clears the error that OpenGL reports if it rejects a bind. Errors that the host left before are logged.
void clear_refusal(const Device& device) {
  for (int i = 0; i < 16; ++i) {
    const GLenum error = device.gl.GetError();
    if (error == GL_NO_ERROR) return;
    if (error != GL_INVALID_OPERATION)
      device.context.log(NOOK_LOG_WARNING, "nook_nnao: the OpenGL error 0x%04x was pending before the call",
                         error);
  }
}

// A kind of texture that a pass reads.
struct TextureKind {
  GLenum target = GL_TEXTURE_2D, binding = GL_TEXTURE_BINDING_2D;
  GLuint unit = 0;  // the texture unit where it is bound for queries
  const char* name = "2D texture without layers or samples";
};
constexpr TextureKind texture_array{GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY, host_depth_unit,
                                    "2D texture array"};
constexpr TextureKind sample_texture{GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                                     host_depth_unit, "multisample texture"};

constexpr TextureKind sample_array{GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
                                   host_depth_unit, "multisample texture array"};

TextureKind kind_of(const HostImages& images) {
  return images.layers > 0 ? texture_array : TextureKind{};
}
TextureKind sampled_kind_of(const HostImages& images, int samples) {
  if (samples == 0) return kind_of(images);
  return images.layers > 0 ? sample_array : sample_texture;
}
bool is_array(const TextureKind& kind) {
  return kind.target == GL_TEXTURE_2D_ARRAY || kind.target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
}
bool has_samples(const TextureKind& kind) {
  return kind.target == GL_TEXTURE_2D_MULTISAMPLE || kind.target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
}

// A texture that is bound for queries. Each answer is added to ImageFacts::answers.
struct BoundTexture {
  const Device& device;
  GLenum target;
  std::uint32_t name;
  GLuint framebuffer;  // without attachments
  std::uint32_t& answers;

  GLint told(GLint value) const {
    answers = 31 * answers + static_cast<std::uint32_t>(value);
    return value;
  }
  GLint level(GLenum what) const {
    GLint value = 0;
    device.gl.GetTexLevelParameteriv(target, 0, what, &value);
    return told(value);
  }
};

// Queries a texture as an attachment of a framebuffer. OpenGL ES 3.0 and WebGL cannot query textures, but
// they can query attachments. The framebuffer need not be complete. Binds `texture.framebuffer`. Returns 0 if
// the driver refuses to attach the texture.
GLint ask_attached(const BoundTexture& texture, GLenum attachment, GLenum what) {
  const Functions& gl = texture.device.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, texture.framebuffer);
  const auto attach = [&](GLuint name) {
    if (texture.target == GL_TEXTURE_2D_ARRAY)
      gl.FramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, attachment, name, 0, 0);
    else
      gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, attachment, texture.target, name, 0);
  };
  attach(texture.name);
  GLint value = 0;
  gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &value);
  attach(0);
  clear_refusal(texture.device);
  return texture.told(value);
}

int depth_bits_of(const BoundTexture& texture) {
  return texture.device.gl.can.texture_sizes
             ? texture.level(GL_TEXTURE_DEPTH_SIZE)
             : ask_attached(texture, GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
}

// `channel` is 0 for red, 1 for green, 2 for blue. If the format does not have the channel, bits_of returns 0
// and type_of returns GL_NONE.
GLint bits_of(const BoundTexture& texture, GLenum channel) {
  return texture.device.gl.can.texture_sizes
             ? texture.level(GL_TEXTURE_RED_SIZE + channel)
             : ask_attached(texture, GL_COLOR_ATTACHMENT0, GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE + channel);
}
GLint type_of(const BoundTexture& texture, GLenum channel) {
  if (texture.device.gl.can.texture_sizes) return texture.level(GL_TEXTURE_RED_TYPE + channel);
  // All channels have the same type.
  if (bits_of(texture, channel) == 0) return GL_NONE;
  return ask_attached(texture, GL_COLOR_ATTACHMENT0, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE);
}

// Returns true if the texture belongs to the given kind.
bool is_of_kind(const Device& device, const TextureKind& kind, std::uint32_t name) {
  GLint before = 0, bound = 0;
  device.gl.GetIntegerv(kind.binding, &before);
  device.gl.BindTexture(kind.target, name);
  device.gl.GetIntegerv(kind.binding, &bound);
  clear_refusal(device);
  device.gl.BindTexture(kind.target, static_cast<GLuint>(before));
  return static_cast<std::uint32_t>(bound) == name;
}

// Says how to pass a multisample texture, if it is one.
const char* advice_for_samples(const Device& device, const HostImages& images, const TextureKind& needed,
                               std::uint32_t name, bool is_depth) {
  const auto& can = device.gl.can;
  if (has_samples(needed) || !can.sample_textures ||
      !(is_of_kind(device, sample_texture, name) ||
        (can.sample_arrays && is_of_kind(device, sample_array, name))))
    return "";
  if (!images.may_have_samples)
    return "; it is multisampled, which this pass cannot read: resolve it to a texture without samples, such "
           "as with glBlitFramebuffer";
  return is_depth ? "; it is multisampled: set nook_nnao_desc.depth_samples to its number of samples, or "
                    "resolve it to a texture without samples"
                  : "; it is multisampled: only depth and normals may be (nook_nnao_desc.depth_samples and "
                    "normal_samples)";
}

// Binds and checks a texture. The texture is still bound when the function returns.
BoundTexture bind_checked(const Device& device, const HostImages& images, ImageFacts& facts,
                          const TextureKind& kind, std::uint32_t name, GLuint framebuffer,
                          const char* field) {
  const Functions& gl = device.gl;
  const BoundTexture texture{device, kind.target, name, framebuffer, facts.answers};
  if (!gl.IsTexture(name))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s is not a texture of this OpenGL context (got %u, need the name of a 2D texture)", field,
                  name);
  gl.ActiveTexture(GL_TEXTURE0 + kind.unit);
  gl.BindTexture(kind.target, name);
  GLint bound = 0;
  gl.GetIntegerv(kind.binding, &bound);
  if (static_cast<std::uint32_t>(bound) != name) {
    clear_refusal(device);
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is a texture of another kind (got %u, need a %s)%s", field,
                  name, kind.name, advice_for_samples(device, images, kind, name, name == images.depth));
  }
  GLint base_level = 0;
  gl.GetTexParameteriv(kind.target, GL_TEXTURE_BASE_LEVEL, &base_level);
  if (base_level != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s does not begin at level 0 (its GL_TEXTURE_BASE_LEVEL is %d)", field, base_level);
  if (!gl.can.texture_sizes) return texture;
  const GLint width = texture.level(GL_TEXTURE_WIDTH), height = texture.level(GL_TEXTURE_HEIGHT);
  if (width != images.width || height != images.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s has another size (got %d x %d, need frame.width x frame.height, %d x %d)", field, width,
                  height, images.width, images.height);
  if (is_array(kind) && texture.level(GL_TEXTURE_DEPTH) < images.layers)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s has another size (got %d layers, need desc.views, %d)",
                  field, texture.level(GL_TEXTURE_DEPTH), images.layers);
  if (has_samples(kind) && texture.level(GL_TEXTURE_SAMPLES) != images.samples)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s has another size (got %d samples, need desc.depth_samples, %d)", field,
                  texture.level(GL_TEXTURE_SAMPLES), images.samples);
  return texture;
}

bool is_float_or_normalised(GLint type) {
  return type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
}

[[noreturn]] void refuse_format(const BoundTexture& texture, const char* field, const char* need) {
  if (!texture.device.gl.can.texture_sizes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s has a format that does not fit (got texture %u, need %s)",
                  field, texture.name, need);
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s has a format that does not fit (got 0x%04x, need %s)", field,
                static_cast<unsigned>(texture.level(GL_TEXTURE_INTERNAL_FORMAT)), need);
}

// Throws Failure unless the first `count` channels of the texture are floats or normalised integers.
void check_channels(const BoundTexture& texture, GLenum count, const char* field, const char* need) {
  for (GLenum channel = 0; channel < count; ++channel)
    if (!is_float_or_normalised(type_of(texture, channel))) refuse_format(texture, field, need);
}

// Throws Failure if a texture contains depth and stencil, and shaders would read its stencil.
void check_shows_depth(const BoundTexture& texture) {
  const Functions& gl = texture.device.gl;
  if (!gl.can.stencil_textures) return;
  GLint mode = GL_DEPTH_COMPONENT;
  gl.GetTexParameteriv(texture.target, GL_DEPTH_STENCIL_TEXTURE_MODE, &mode);
  if (mode != GL_DEPTH_COMPONENT)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.depth_texture returns its stencil instead of its depth "
                  "(GL_DEPTH_STENCIL_TEXTURE_MODE is 0x%04x, need GL_DEPTH_COMPONENT)",
                  static_cast<unsigned>(mode));
}

// Checks the depth texture. Returns the number of bits of its depth channel.
int check_depth(const BoundTexture& texture, nook_depth_kind kind) {
  const int depth_bits = depth_bits_of(texture);
  const bool red_float = depth_bits == 0 && type_of(texture, 0) == GL_FLOAT;
  const GLint red_bits = red_float ? bits_of(texture, 0) : 0;
  if (kind == NOOK_DEPTH_LINEAR) {
    if (!red_float)
      refuse_format(texture, "frame.depth_texture", "red in floats, such as GL_R32F, for NOOK_DEPTH_LINEAR");
  } else if (depth_bits == 0 && red_bits < 32) {
    refuse_format(texture, "frame.depth_texture",
                  kind == NOOK_DEPTH_HARDWARE ? "a depth format or GL_R32F for NOOK_DEPTH_HARDWARE"
                                              : "a depth format or GL_R32F for NOOK_DEPTH_LOGARITHMIC");
  }
  if (depth_bits == 0) return red_bits;
  check_shows_depth(texture);
  return depth_bits;
}

// Checks the normal texture. Returns true if its format has normalised integers.
bool check_normal(const BoundTexture& texture) {
  bool normalised = false;
  for (GLenum channel = 0; channel < 3; ++channel) {
    const GLint type = type_of(texture, channel);
    if (!is_float_or_normalised(type))
      refuse_format(texture, "frame.normal_texture", "red, green and blue in floats or normalised integers");
    normalised = normalised || type != GL_FLOAT;
  }
  return normalised;
}

void check_layer(const BoundTexture& texture, nook_gbuffer_ao layer) {
  constexpr const char* field = "frame.gbuffer_ao_texture";
  check_channels(texture, 1, field, "red in floats or normalised integers");
  if (layer >= NOOK_GBUFFER_AO_REPLACE)
    check_channels(texture, 2, field, "red and green for NOOK_GBUFFER_AO_REPLACE and _EXCLUDE");
}

void check_complete(const Functions& gl, const HostImages& images) {
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.target_name cannot be drawn into (got %u, its framebuffer has the status 0x%04x, need "
        "GL_FRAMEBUFFER_COMPLETE)",
        images.target_name, status);
}

// Throws Failure if an input texture is the target or an attachment of the target.
void check_apart(const HostImages& images, std::uint32_t target, const char* target_field) {
  const struct {
    std::uint32_t name;
    const char* field;
  } inputs[] = {{images.depth, "frame.depth_texture"},
                {images.normal, "frame.normal_texture"},
                {images.layer_texture, "frame.gbuffer_ao_texture"},
                {images.motion, "desc.motion_vectors"},
                {images.ao, "desc.ao_texture"}};
  for (const auto& input : inputs)
    if (input.name != 0 && input.name == target)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s is %s as well (got %u for both); a texture cannot be read and drawn into at once",
                    input.field, target_field, target);
}

std::uint32_t attached_texture(const Functions& gl, GLenum attachment) {
  GLint kind = GL_NONE, name = 0;
  gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                         GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
  if (kind != GL_TEXTURE) return 0;
  gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                         GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
  return static_cast<std::uint32_t>(name);
}

void check_framebuffer(const Device& device, const HostImages& images) {
  const Functions& gl = device.gl;
  if (images.target_name != 0 && !gl.IsFramebuffer(images.target_name))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target_name is not a framebuffer of this OpenGL context (got %u, need a name or 0)",
                  images.target_name);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, images.target_name);
  check_complete(gl, images);
  GLint buffer = GL_NONE;
  gl.GetIntegerv(GL_DRAW_BUFFER0, &buffer);
  if (buffer == GL_NONE)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.target_name has no draw buffer (its first draw buffer is GL_NONE); set one with glDrawBuffer");
  if (images.target_name == 0) return;
  check_apart(images, attached_texture(gl, static_cast<GLenum>(buffer)), "attached to frame.target_name");
  // The depth attachment of the target must not be the depth texture: reading a texture while it is attached
  // is undefined in OpenGL.
  check_apart(images, attached_texture(gl, GL_DEPTH_ATTACHMENT), "attached to frame.target_name");
}

void check_renderable(const Functions& gl, const HostImages& images, std::uint32_t framebuffer) {
  const std::uint32_t texture = images.target_name;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (images.layers > 0)
    attach_layer(gl, texture, 0);
  else
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target_name cannot be drawn into (got %u with the framebuffer status 0x%04x, need a "
                  "colour format that OpenGL renders to)",
                  texture, status);
}

void check_target_texture(const Device& device, const HostImages& images, ImageFacts& facts,
                          std::uint32_t own_texture, GLuint framebuffer) {
  if (images.target_name == own_texture)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target_name is the pass's own texture (got %u); use NOOK_TARGET_OWN", own_texture);
  check_apart(images, images.target_name, "frame.target_name");
  constexpr const char* field = "frame.target_name";
  check_channels(bind_checked(device, images, facts, kind_of(images), images.target_name, framebuffer, field),
                 1, field, "a colour format in floats or normalised integers");
}

}  // namespace

HostImages images_of(const NnaoFrame& frame, const nook_nnao_desc& pass) {
  HostImages images;
  images.width = frame.width;
  images.height = frame.height;
  images.layers = pass.views;
  images.samples = pass.depth_samples;
  images.normal_samples = pass.normal_samples;
  images.depth_kind = frame.depth_kind;
  images.layer = frame.gbuffer_ao;
  images.target = frame.target;
  images.depth = frame.depth_texture;
  images.normal = frame.normal_texture;
  if (frame.gbuffer_ao != NOOK_GBUFFER_AO_NONE) images.layer_texture = frame.gbuffer_ao_texture;
  if (frame.target != NOOK_TARGET_OWN) images.target_name = frame.target_name;
  if (pass.max_history_frames) images.motion = frame.motion_vectors;
  return images;
}

void check_images_of(const Functions& gl, const nook_nnao_desc& pass) {
  if (pass.depth_samples == 0) return;
  const int major = gl.version / 10, minor = gl.version % 10;
  if (!gl.can.sample_textures)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.depth_samples needs multisample textures (got %s %d.%d, need 3.1 or newer); resolve "
                  "depth to a 2D texture",
                  api_name(gl), major, minor);
  if (pass.views != 0 && !gl.can.sample_arrays)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.views with desc.depth_samples needs multisample texture arrays (got %s %d.%d, need "
                  "3.2 or newer); resolve depth to a 2D texture array",
                  api_name(gl), major, minor);
}

ImageFacts check_images(const Device& device, const HostImages& images, std::uint32_t own_texture,
                        std::uint32_t target_framebuffer) {
  ImageFacts facts;
  const TextureKind kind = kind_of(images);
  check_apart(images, own_texture, "the pass's own texture");
  const auto bind = [&](const TextureKind& of, std::uint32_t name, const char* field) {
    return bind_checked(device, images, facts, of, name, target_framebuffer, field);
  };
  facts.depth_bits = check_depth(
      bind(sampled_kind_of(images, images.samples), images.depth, "frame.depth_texture"), images.depth_kind);
  if (images.normal)
    facts.normalised_normals = check_normal(
        bind(sampled_kind_of(images, images.normal_samples), images.normal, "frame.normal_texture"));
  if (images.layer_texture)
    check_layer(bind(kind, images.layer_texture, "frame.gbuffer_ao_texture"), images.layer);
  if (images.motion)
    check_channels(bind(kind, images.motion, "desc.motion_vectors"), 2, "desc.motion_vectors",
                   "red and green in floats or normalised integers");
  if (images.ao)
    check_channels(bind(kind, images.ao, "desc.ao_texture"), 1, "desc.ao_texture",
                   "red in floats or normalised integers");
  if (images.target == NOOK_TARGET_TEXTURE) {
    check_target_texture(device, images, facts, own_texture, target_framebuffer);
    check_renderable(device.gl, images, target_framebuffer);
  }
  if (images.target == NOOK_TARGET_FRAMEBUFFER) check_framebuffer(device, images);
  return facts;
}

}  // namespace nook::gl
