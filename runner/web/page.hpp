// JSON for a page's scripts, with members in the order in which they were written.
#pragma once

#include "base/error.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::web {

using Json = nlohmann::ordered_json;

// A knob as JSON, from which host/controls.js makes its widgets.

Json knob_data(const scene::Knob& knob);

// Exports a scene as a page that draws it in any browser: texts, textures and sounds are in the page, and it
// makes no network requests. Returns text; writes no file and uses no driver.

enum class PageForm {
    whole,    ///< `<!doctype html>`: a file to open
    fragment, ///< a `<div>` with its style and script, to be pasted into another page
};

/// `numbers`: those of the run by name (cli::run_numbers), which the page's uniforms are computed from. Fails
/// (ErrorCode::load) if a file that the scene reads cannot be read, or is too large for a page.
Result<std::string> make_page(const scene::Scene& scene, PageForm form, const Json& numbers);

} // namespace tidemark::web
