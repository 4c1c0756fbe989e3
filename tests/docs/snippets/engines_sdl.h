// What the page about SDL uses of SDL_video.h of SDL 3.
struct SDL_Window;
typedef struct SDL_GLContextState* SDL_GLContext;
typedef void (*SDL_FunctionPointer)(void);
enum SDL_GLAttr { SDL_GL_CONTEXT_MAJOR_VERSION, SDL_GL_CONTEXT_MINOR_VERSION, SDL_GL_CONTEXT_PROFILE_MASK };
enum { SDL_GL_CONTEXT_PROFILE_CORE = 1, SDL_WINDOW_OPENGL = 2 };
bool SDL_GL_SetAttribute(SDL_GLAttr attribute, int value);
SDL_Window* SDL_CreateWindow(const char* title, int width, int height, uint64_t flags);
SDL_GLContext SDL_GL_CreateContext(SDL_Window* window);
extern "C" SDL_FunctionPointer SDL_GL_GetProcAddress(const char* name);
