// Finds ShaderToy projects in a saved web page: text in, the JSON texts of the projects out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// Returns whether a text is HTML rather than JSON.
bool is_page(std::string_view text);

/// Returns the JSON objects in a page that have the key `renderpass`: from its scripts; if there are none,
/// from its visible text, as when a browser saves a page of JSON; if there are none, from attributes. Takes
/// time linear in the page.
std::vector<std::string> projects_in_page(std::string_view page);

} // namespace tidemark::scene
