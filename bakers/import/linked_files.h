// The files that a glTF file names.
#pragma once

namespace nook::bake {

// folder: files that lie in the folder of the file that names them, or below it, so that a file from
// elsewhere cannot have others read. Symbolic links are followed: who made them decides. anywhere: "../" as
// well.
enum class LinkedFiles { folder, anywhere };

}  // namespace nook::bake
