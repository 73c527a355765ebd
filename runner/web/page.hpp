// A scene as a page for browsers, and the files that pages are made of.
#pragma once

#include "base/error.hpp"
#include "lab/device_difference.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::web {

/// Keeps the order in which members were written.
using Json = nlohmann::ordered_json;

// A knob as JSON, from which host/controls.js makes its widgets.

Json knob_data(const scene::Knob& knob);

// Exports a scene as a page that draws it in any browser: texts, textures and sounds are in the page, and it
// makes no network requests. Returns text; writes no file and uses no driver.

enum class PageForm {
    whole,    ///< `<!doctype html>`: a file to open
    fragment, ///< a `<div>` with its style and script, to be pasted into another page
};

/// `numbers`: those of the run by name (host::run_numbers), which the page's uniforms are computed from.
/// Fails (ErrorCode::load) if a file that the scene reads cannot be read, or is too large for a page.
Result<std::string> make_page(const scene::Scene& scene, PageForm form, const Json& numbers);

// Draws exported pages in headless Chromium, by WebGL 2.

/// Returns whether `device` names a browser: "chromium" (with the driver that it chooses),
/// "chromium:swiftshader" or "chromium:egl" (with the machine's EGL driver).
bool is_browser(std::string_view device);

/// Returns the names that is_browser knows, or none if Chromium is not installed.
std::vector<std::string> usable_browsers();

/// A running browser. It ends with the object.
class Browser {
public:
    /// `device` is one that is_browser knows. ErrorCode::no_context if Chromium is missing or does not start.
    static Result<Browser> start(std::string_view device);
    Browser(Browser&&) noexcept;
    Browser& operator=(Browser&&) noexcept;
    ~Browser();

    /// Draws a whole page's passes in a state, those with feedback from frame `first` on, like
    /// lab::draw_frame. Fails with the page's message if it does not compile, and with
    /// ErrorCode::timed_out after `seconds`; the browser may then be busy and should be started anew.
    Result<lab::FramePictures> draw(const std::string& page, const render::FrameState& state, int first,
                                    double seconds);

private:
    struct State;
    explicit Browser(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

// The files from which a page is made, as texts compiled into the program (CMakeLists.txt).

extern const std::string_view k_page;   ///< page.html
extern const std::string_view k_figure; ///< figure.html
extern const std::string_view k_style;  ///< style.css
extern const std::string_view k_host;   ///< host/*.js, joined

} // namespace tidemark::web

namespace tidemark::web {

/// The viewers' page: page/ and the shared files of web/host, joined by CMakeLists.txt.
extern const std::string_view k_viewer_page;

} // namespace tidemark::web
