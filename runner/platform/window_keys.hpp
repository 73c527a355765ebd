// From GLFW's keys to ours. Included by the window only.
#pragma once

#include "platform/input.hpp"

namespace tidemark::platform {

/// The key's JavaScript code by what the person's keyboard layout prints on it (Z is where a German
/// looks for it), and by its place on an American keyboard where that is no plain letter or digit.
/// `key_name` is what glfwGetKeyName says of the key; it may be null.
Key key_from_glfw(int glfw_key, const char* key_name);

} // namespace tidemark::platform
