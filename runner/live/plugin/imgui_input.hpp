// Passes window events on to Dear ImGui: 1.86, which reads a state, or 1.89 and later, which have a queue.
#pragma once

#include "platform/input.hpp"

struct ImGuiIO;

namespace tidemark::live {

/// Maps Tidemark's keys to those of Dear ImGui; called once, before the first frame.
void set_up_input(ImGuiIO& io);

/// Passes one event on. `height` of the framebuffer: Tidemark counts pixels from the bottom, Dear ImGui from
/// the top.
void feed(ImGuiIO& io, const platform::InputEvent& event, int height);

/// Releases all keys and buttons and moves the pointer outside.
void release_all(ImGuiIO& io);

} // namespace tidemark::live
