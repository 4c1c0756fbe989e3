// Which other files a glTF file may name.
#pragma once

namespace nook::bake {

// folder: only files in the folder of the file that names them, or below it, so that a downloaded file cannot
// have others read. Symbolic links are followed as long as they stay there, because an archive may bring its
// own. anywhere: "../", absolute names and links that lead outside as well.
enum class LinkedFiles { folder, anywhere };

}  // namespace nook::bake
