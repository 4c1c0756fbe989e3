#include <nook/nook_nnao.h>
#include <filesystem>
extern nook::Nnao pass;
extern nook_gl_frame_desc frame;
extern nook_nnao_frame_desc desc;
extern std::filesystem::path folder;
