// Declares one function for each kind of context. Only context.cpp calls them.
#pragma once

#include "platform/platform.h"

namespace platform {

std::unique_ptr<Context> create_egl_context(const ContextRequest& request);
std::unique_ptr<Context> create_window_context(const ContextRequest& request);
std::unique_ptr<Context> create_osmesa_context(const ContextRequest& request);

}  // namespace platform
