#include "scene/saved_project.hpp"

#include "base/try.hpp"
#include "scene/json_text.hpp"
#include "scene/page_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace tidemark::scene {
namespace {

constexpr size_t k_id_length = 6;

bool is_id(std::string_view text) {
    return text.size() == k_id_length &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
}

/// Returns an empty text if the project does not state its id.
std::string id_of(const Json& project) {
    const Json* inner = &project;
    for (const char* key : {"Shader", "info"}) {
        const auto found = inner->is_object() ? inner->find(key) : inner->end();
        if (found != inner->end())
            inner = &*found;
    }
    return inner == &project ? "" : as_text(*inner, "id");
}

/// Returns the entries of a list or an export; any other JSON is returned as one project, and its reader
/// reports errors.
std::vector<Json> projects_of(Json json) {
    if (json.is_object() && json.contains("shaders"))
        json = Json(std::move(json["shaders"]));
    const bool is_list =
        json.is_array() && !json.empty() && !(json[0].is_object() && json[0].contains("code"));
    if (!is_list)
        return {std::move(json)};
    return {std::make_move_iterator(json.begin()), std::make_move_iterator(json.end())};
}

Result<std::vector<Json>> projects_in(std::string_view text, const std::string& file) {
    if (!is_page(text))
        return parse_json(text, file).map(projects_of);
    std::vector<Json> projects;
    for (const std::string& project : projects_in_page(text))
        if (auto json = parse_json(project, file))
            projects.push_back(*std::move(json));
    if (projects.empty())
        return fail(error_at(
            {file},
            "there is no project in this page: ShaderToy's pages load theirs later. Save what "
            "https://www.shadertoy.com/api/v1/shaders/ID?key=KEY shows, or a browser extension's export"));
    return projects;
}

Result<Json> choose(std::vector<Json> projects, std::string_view id, const std::string& file) {
    std::vector<std::string> ids;
    for (Json& project : projects) {
        ids.push_back(id_of(project));
        if (!id.empty() && ids.back() == id)
            return std::move(project);
    }
    if (projects.size() == 1 && (id.empty() || ids[0].empty()))
        return std::move(projects[0]);
    if (id.empty())
        return fail(
            error_at({file}, fmt::format("this holds {} projects ({}): say which with `import ID --via FILE`",
                                         ids.size(), fmt::join(ids, ", "))));
    return fail(error_at({file}, fmt::format("this holds {}, and not {}", fmt::join(ids, ", "), id)));
}

/// Returns whether an address is an id alone or on ShaderToy's own site.
bool is_of_site(std::string_view address) {
    const size_t scheme = address.find("://");
    if (scheme != address.npos)
        address.remove_prefix(scheme + 3);
    const size_t slash = address.find('/');
    const std::string_view host = address.substr(0, slash);
    return slash == address.npos || host == "www.shadertoy.com" || host == "shadertoy.com";
}

} // namespace

Result<std::string> project_id(std::string_view address) {
    std::string_view last = address.substr(0, address.find_first_of("?#"));
    while (last.ends_with('/'))
        last.remove_suffix(1);
    const bool of_site = is_of_site(last);
    last.remove_prefix(last.rfind('/') + 1);
    if (of_site && is_id(last))
        return std::string(last);
    return fail(ErrorCode::usage,
                fmt::format("'{}' is no address of a ShaderToy project: give one as in "
                            "https://www.shadertoy.com/view/XxXxXx, or its last six characters",
                            address));
}

Result<std::string> saved_project(std::string text, std::string_view id, const std::string& file) {
    if (id.empty() && !is_page(text))
        return text;
    auto projects = TRY(projects_in(text, file));
    const Json chosen = TRY(choose(std::move(projects), id, file));
    return chosen.dump(k_json_indent) + "\n";
}

} // namespace tidemark::scene
