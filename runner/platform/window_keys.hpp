// From GLFW's keys to ours. Included by the window only.
#pragma once

#include "platform/input.hpp"

#include <optional>

namespace tidemark::platform {

/// The key's JavaScript code by what the person's keyboard layout prints on it (Z is where a German
/// looks for it), and by its place on an American keyboard where that is no plain letter or digit.
/// `key_name` is what glfwGetKeyName says of the key; it may be null.
Key key_from_glfw(int glfw_key, const char* key_name);

/// What GLFW's key callback tells of; nothing for a key that has no code.
std::optional<InputEvent> key_event(int glfw_key, int scancode, int action);

} // namespace tidemark::platform
