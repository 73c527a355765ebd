// A scene as a page that draws it in any browser: texts, textures and sounds lie in the page, and it asks no
// network for anything. Text out; no file is written and no driver is asked.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <string>

namespace tidemark::web {

enum class PageForm {
    whole,    ///< `<!doctype html>`: a file to open
    fragment, ///< a `<div>` with its style and script: to be pasted into a page of one's own
};

/// Fails (ErrorCode::load) where a file that the scene reads cannot be read, or is too large for a page.
Result<std::string> make_page(const scene::Scene& scene, PageForm form);

} // namespace tidemark::web
