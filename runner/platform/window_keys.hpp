// Converts GLFW's keys. Only the windows include it.
#pragma once

#include "platform/input.hpp"

#include <optional>

namespace tidemark::platform {

/// Returns the key's JavaScript code: by the letter or digit that the user's keyboard layout prints on it (so
/// Z is where German keyboards have it), else by its place on an American keyboard. `key_name` is
/// glfwGetKeyName's result; it may be null.
Key key_from_glfw(int glfw_key, const char* key_name);

/// Converts the arguments of GLFW's key callback; nullopt for a key without a code.
std::optional<InputEvent> key_event(int glfw_key, int scancode, int action);

} // namespace tidemark::platform
