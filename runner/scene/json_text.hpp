// JSON as ShaderToy writes it: text in, a tree out, and the one project inside it found. The only header that
// brings the JSON library along.
#pragma once

#include "base/result.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace tidemark::scene {

/// Keeps the members of an object in the order of the text.
using Json = nlohmann::ordered_json;

/// Of a line in the projects that we write.
constexpr int k_json_indent = 2;

/// Parses in linear time whatever the text is: what no project needs (nesting, long objects, a million
/// values) is refused before the library sees it. Half of a surrogate pair, which is no text, becomes
/// U+FFFD. `file` is for the messages.
Result<Json> parse_json(std::string_view text, const std::string& file);

/// The list of passes: `renderpass` of the tree itself, of `{"Shader": …}`, of a list of one of these or of
/// the site's export of all (`{"shaders": […]}`) with one; or the tree where it is such a list. Fails on
/// `{"Error": …}`, on several shaders, and on JSON that is something else; what it finds may still be no
/// list.
Result<Json*> find_passes(Json& json, const std::string& file);

/// A string, or a number as its digits; empty for everything else.
std::string as_text(const Json& object, const char* key);

} // namespace tidemark::scene
