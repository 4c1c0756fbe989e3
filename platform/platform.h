// OpenGL contexts and images for the tool, the samples and the tests. Each thread has one current context.
// Use a context only on the thread that created it. On failure, functions throw std::runtime_error with a
// text that says what to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;
typedef struct GladGLContext GladGLContext;

namespace platform {

struct ContextRequest {
  std::string kind = "egl";  // "egl" (no display needed), "osmesa" or "window"
  int width = 1280;          // pixels
  int height = 720;
  int major = 4;  // version of the core profile; Mesa's software renderer supports at most 4.5
  int minor = 5;
  bool es = false;     // true: OpenGL ES of this version; only the kind "egl" supports it
  bool debug = false;  // true: a debug context if the driver supports one
  std::string title = "Nook";
};

class Context {
 public:
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context();

  virtual void make_current() = 0;
  virtual void clear_current() = 0;
  // Shows the drawn image, and handles the events of the window. Waits at most `wait_s` seconds for events.
  // Does nothing if there is no window.
  virtual void present(double wait_s = 0) { static_cast<void>(wait_s); }
  virtual bool should_close() const { return false; }
  virtual bool is_es() const { return false; }
  // Returns null unless the kind is "window".
  virtual GLFWwindow* window() const { return nullptr; }
  // Gets the size of the drawable in pixels. It changes when the user resizes the window.
  virtual void size(int* width, int* height) const;
  virtual void* proc(const char* name) const = 0;

  // Returns the framebuffer to draw into. This is 0 if the context has a default framebuffer. Otherwise the
  // first call creates a framebuffer with RGBA8 and a 24-bit depth buffer, and leaves it bound.
  unsigned framebuffer();
  const GladGLContext& gl() const { return *gl_; }
  std::string version() const;
  std::string renderer() const;

  // Loads one OpenGL function. `user` must be the Context.
  static void* loader(void* user, const char* name);

 protected:
  Context(int width, int height, bool has_framebuffer);
  // Each kind of context must call this when it is current for the first time.
  void load_functions();

  int width_;
  int height_;

 private:
  bool has_framebuffer_;
  unsigned framebuffer_ = 0;
  unsigned renderbuffers_[2] = {};
  std::unique_ptr<GladGLContext> gl_;
};

// Creates a context and makes it current.
std::unique_ptr<Context> create_context(const ContextRequest& request);
// Returns the list of kinds that this build supports, for a message.
const char* context_kinds();

// Rows run from top to bottom. A pixel has three or four bytes.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 4;
  std::vector<std::uint8_t> pixels;
};

// Linear RGB. Rows run from top to bottom.
struct FloatImage {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
};

// Reads the first three channels of an image of floating-point values (.hdr, .exr).
FloatImage read_float_image(const std::filesystem::path& path);

// Reads the pixels of the framebuffer that is bound for reading. Waits for the GPU. Changes the pixel-pack
// state and does not restore it.
Image read_pixels(const Context& context, int width, int height, int channels = 3);
// The file's extension, such as .png, determines the format. If writing fails, no half-written file remains.
void write_image(const std::filesystem::path& path, const Image& image);

}  // namespace platform
