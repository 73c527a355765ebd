// Window events for Dear ImGui 1.86, which reads a state instead of a queue.
#pragma once

#include "platform/input.hpp"

struct ImGuiIO;

namespace tidemark::live {

/// Tells which of our keys its own names for keys are.
void name_keys(ImGuiIO& io);

/// `height` of what is drawn on: our pixels count from the bottom, its from the top.
void feed(ImGuiIO& io, const platform::InputEvent& event, int height);

/// Nothing is held down any more, and the pointer is nowhere.
void release_all(ImGuiIO& io);

} // namespace tidemark::live
