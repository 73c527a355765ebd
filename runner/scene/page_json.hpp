// A saved web page as a place where JSON stands: text in, the texts of the projects in it out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// Whether a text is a page rather than JSON.
bool is_page(std::string_view text);

/// The JSON objects in a page that have the key `renderpass`: in its scripts; else in what it shows, as a
/// browser saves JSON that it was asked to show; else in attributes. In time linear in the page.
std::vector<std::string> projects_in_page(std::string_view page);

} // namespace tidemark::scene
