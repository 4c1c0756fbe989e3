#include <nook/nook_nnao.h>
#include <filesystem>
extern nook::Nnao nnao;
extern nook_gl_frame_desc frame;
extern nook_nnao_frame_desc nnao_frame;
extern std::filesystem::path folder;
