// Defines which other files a glTF file may refer to.
#pragma once

namespace nook::bake {

// With `folder`, a glTF file may refer only to files in its own folder or in subfolders. So a downloaded file
// cannot make Nook read other files of the user. Symbolic links are followed if they lead to a place in that
// folder, because an archive may contain such links. With `anywhere`, "../", absolute paths and links to
// other folders are allowed as well.
enum class LinkedFiles { folder, anywhere };

}  // namespace nook::bake
