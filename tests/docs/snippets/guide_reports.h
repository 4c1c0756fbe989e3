#include <filesystem>
extern nook::Nnao pass;
extern nook_nnao_frame_desc frame;
extern std::filesystem::path folder;
