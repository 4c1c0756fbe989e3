// Files that a command writes.
#pragma once

#include "platform/output_file.h"

namespace nook::cli {

using platform::OutputFile;

}  // namespace nook::cli
