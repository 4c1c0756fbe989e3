#include "platform/file_attributes.h"

#include <sys/xattr.h>
#include <unistd.h>

#include <vector>

namespace platform {
namespace {

void copy_extended(int descriptor, const std::filesystem::path& old) {
  const ssize_t size = listxattr(old.c_str(), nullptr, 0);
  if (size <= 0) return;
  std::vector<char> names(static_cast<std::size_t>(size));
  const ssize_t got = listxattr(old.c_str(), names.data(), names.size());
  for (ssize_t at = 0; at < got; at += ssize_t(std::string(names.data() + at).size()) + 1) {
    const char* const name = names.data() + at;
    std::vector<char> value(std::size_t{1} << 16);  // the maximum on Linux
    const ssize_t bytes = getxattr(old.c_str(), name, value.data(), value.size());
    // Some attributes belong to the system and cannot be set.
    if (bytes >= 0 && fsetxattr(descriptor, name, value.data(), std::size_t(bytes), 0) != 0) continue;
  }
}

}  // namespace

std::string take_attributes(int descriptor, const std::filesystem::path& old, const struct stat& there) {
  std::string note;
  const bool group = fchown(descriptor, uid_t(-1), there.st_gid) == 0;
  if (fchown(descriptor, there.st_uid, gid_t(-1)) != 0)
    note =
        "the new file belongs to you, because you may not create files for the owner of the old file, user " +
        std::to_string(there.st_uid);
  mode_t mode = there.st_mode & 0777;
  // If the group could not be set, the new file has another group. This group must not get the permissions of
  // the old group.
  if (!group) mode = (mode & 0707) | ((mode & 07) << 3 & mode);
  if (fchmod(descriptor, mode) != 0)
    note += note.empty() ? "its mode is not kept" : ", and it has another mode than the old file";
  copy_extended(descriptor, old);
  if (there.st_nlink > 1)
    note += (note.empty() ? "" : "; ") + ("it has " + std::to_string(there.st_nlink) +
                                          " names (hard links); the other names keep the old file");
  return note;
}

}  // namespace platform
