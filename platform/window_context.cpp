// Creates a window on the desktop with GLFW.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <stdexcept>

#include "platform/kinds.h"

namespace platform {
namespace {

std::runtime_error glfw_failure(const char* what) {
  const char* text = nullptr;
  glfwGetError(&text);
  return std::runtime_error(std::string("create_context: ") + what + " (" +
                            (text ? text : "no reason given") +
                            "); start a display or use xvfb-run, or choose the kind egl");
}

class WindowContext final : public Context {
 public:
  WindowContext(const ContextRequest& request, GLFWwindow* window)
      : Context(request.width, request.height, true), window_(window) {
    make_current();
    glfwSwapInterval(1);
    load_functions();
  }
  ~WindowContext() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  void make_current() override { glfwMakeContextCurrent(window_); }
  void clear_current() override { glfwMakeContextCurrent(nullptr); }
  void present(double wait_s) override {
    glfwSwapBuffers(window_);
    wait_s > 0 ? glfwWaitEventsTimeout(wait_s) : glfwPollEvents();
  }
  bool should_close() const override { return glfwWindowShouldClose(window_) != 0; }
  GLFWwindow* window() const override { return window_; }
  void size(int* width, int* height) const override { glfwGetFramebufferSize(window_, width, height); }
  void* proc(const char* name) const override { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

 private:
  GLFWwindow* window_;
};

}  // namespace

std::unique_ptr<Context> create_window_context(const ContextRequest& request) {
  if (!glfwInit()) throw glfw_failure("GLFW found no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, request.major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, request.minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, request.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  GLFWwindow* window =
      glfwCreateWindow(request.width, request.height, request.title.c_str(), nullptr, nullptr);
  if (!window) {
    const std::runtime_error failure = glfw_failure("the window could not be created");
    glfwTerminate();
    throw failure;
  }
  return std::make_unique<WindowContext>(request, window);
}

}  // namespace platform
