// The interface between the program and the Dear ImGui plug-in: models and events go in, commands and panels
// drawn with OpenGL come out. Both are built together; a plug-in with another version is refused.
#pragma once

#include "base/extent.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"

#include <memory>

namespace tidemark::overlay {

/// The framebuffer that panels are drawn on.
struct Surface {
    Extent extent;    ///< of the window's framebuffer, in pixels
    double scale = 1; ///< pixels for one pixel of an ordinary display
};

class Panels {
public:
    virtual ~Panels() = default;

    virtual void show(Model model, const Surface& surface) = 0;
    /// Returns whether the event belongs to a panel.
    virtual bool take(const host::InputEvent& event) = 0;
    virtual void draw() = 0;
    virtual Commands take_commands() = 0;
    /// Releases all keys and buttons.
    virtual void release_all() = 0;
};

struct PanelsPlugIn {
    unsigned version;
    std::unique_ptr<Panels> (*create)();
};

inline constexpr unsigned k_panels_version = 6;
inline constexpr const char* k_panels_entry = "tidemark_panels";

} // namespace tidemark::overlay
