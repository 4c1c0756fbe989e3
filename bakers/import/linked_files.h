// The files that a glTF file names.
#pragma once

namespace nook::bake {

// folder: files that lie in the folder of the file that names them, or below it, so that a file from
// elsewhere cannot have others read. Symbolic links are followed as long as they stay there, because an
// archive may bring its own. anywhere: "../", absolute names and links that lead outside as well.
enum class LinkedFiles { folder, anywhere };

}  // namespace nook::bake
