// What the program and the plug-in of Dear ImGui say to each other: models and events in, commands out, and
// panels drawn with OpenGL. Both are built together; the version refuses a plug-in of another build.
#pragma once

#include "base/extent.hpp"
#include "live/command.hpp"
#include "live/model.hpp"
#include "platform/input.hpp"

#include <memory>

namespace tidemark::live {

/// What panels are drawn on.
struct Surface {
    Extent extent;    ///< of the window's framebuffer
    double scale = 1; ///< pixels for one of an ordinary display
};

class Panels {
public:
    virtual ~Panels() = default;

    virtual void show(Model model, const Surface& surface) = 0;
    /// Whether the event is a panel's.
    virtual bool take(const platform::InputEvent& event) = 0;
    virtual void draw() = 0;
    virtual Commands take_commands() = 0;
    /// Nothing is held down any more.
    virtual void release_all() = 0;
};

struct PanelsPlugIn {
    unsigned version;
    std::unique_ptr<Panels> (*create)();
};

inline constexpr unsigned k_panels_version = 3;
inline constexpr const char* k_panels_entry = "tidemark_panels";

} // namespace tidemark::live
