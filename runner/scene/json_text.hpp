// Parses JSON as ShaderToy writes it and finds the one project in it. Includes the whole JSON library; other
// headers only forward-declare it.
#pragma once

#include "base/error.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace tidemark::scene {

/// Keeps the members of an object in the order of the text.
using Json = nlohmann::ordered_json;

/// Blanks per level of indentation in the projects that the program writes.
constexpr int k_json_indent = 2;

/// Parses any text in linear time: input that no project needs (deep nesting, long objects, a million values)
/// is rejected before the library parses it. Half of a surrogate pair, which is not valid text, becomes
/// U+FFFD. `file` is for messages.
Result<Json> parse_json(std::string_view text, const std::string& file);

/// Returns the list of passes: `renderpass` of the tree itself, of `{"Shader": …}`, or of the only entry of a
/// list or of the site's export (`{"shaders": […]}`); or the tree itself if it is a list of passes. Fails on
/// `{"Error": …}`, on several shaders, and on other JSON. The result may still not be a list.
Result<Json*> find_passes(Json& json, const std::string& file);

/// Returns a string, or a number as its digits; empty for anything else.
std::string as_text(const Json& object, const char* key);

} // namespace tidemark::scene
