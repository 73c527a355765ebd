#include "scene/page_json.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

namespace tidemark::scene {
namespace {

constexpr std::string_view k_key = "\"renderpass\"";
// Limits that keep the time linear on pages that hold no project. A project has its key within some
// kilobytes, after its description.
constexpr size_t k_most_keys = 16;
constexpr size_t k_most_braces = 256;
constexpr size_t k_farthest_key = size_t{1} << 16;

/// Returns the position after the string that begins at `at`; JSON strings have no line ends.
size_t string_end(std::string_view text, size_t at) {
    for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at)
        if (text[at] == '\\')
            ++at;
    return at + 1;
}

struct Walked {
    size_t at;
    int depth; ///< number of brackets open there
};

/// Walks from the bracket at `begin` to its counterpart, and past it, or to `end`.
Walked walk(std::string_view text, size_t begin, size_t end) {
    Walked walked = {begin, 0};
    do {
        const char c = text[walked.at];
        walked.depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        walked.at = c == '"' ? string_end(text, walked.at) : walked.at + 1;
    } while (walked.at < end && walked.depth > 0);
    return walked;
}

/// Returns the object that has the key at `key` as a direct member; empty if there is none. The text before
/// it may be any script, so its brace is searched backwards.
std::string_view object_around(std::string_view text, size_t key) {
    size_t brace = key;
    for (size_t tried = 0; tried < k_most_braces && brace > 0; ++tried) {
        brace = text.rfind('{', brace - 1);
        if (brace == text.npos || key - brace > k_farthest_key)
            break;
        const Walked to_key = walk(text, brace, key);
        if (to_key.at != key || to_key.depth != 1)
            continue;
        const Walked whole = walk(text, brace, text.size());
        return whole.depth == 0 ? text.substr(brace, whole.at - brace) : std::string_view();
    }
    return {};
}

std::vector<std::string> objects_in(std::string_view text) {
    std::vector<std::string> objects;
    size_t key = text.find(k_key);
    for (size_t count = 0; count < k_most_keys && key != text.npos; ++count) {
        const std::string_view object = object_around(text, key);
        if (!object.empty())
            objects.emplace_back(object);
        const size_t behind = object.empty() ? key + 1 : size_t(object.end() - text.begin());
        key = text.find(k_key, behind);
    }
    return objects;
}

/// The scripts of a page, and its text without them.
struct Page {
    std::string scripts;
    std::string rest;
};

size_t find_tag(std::string_view page, std::string_view tag, size_t from) {
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    const auto found =
        std::search(page.begin() + std::ptrdiff_t(from), page.end(), tag.begin(), tag.end(), same);
    return found == page.end() ? page.size() : size_t(found - page.begin());
}

Page take_apart(std::string_view text) {
    Page page;
    for (size_t at = 0; at < text.size();) {
        const size_t script = find_tag(text, "<script", at);
        const size_t end = find_tag(text, "</script", script);
        page.rest.append(text.substr(at, script - at)).append("\n");
        page.scripts.append(text.substr(script, end - script)).append("\n");
        at = end;
    }
    return page;
}

/// Replaces HTML entities by their characters.
std::string without_entities(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 7> k_entities = {{{"&quot;", '"'},
                                                                              {"&#34;", '"'},
                                                                              {"&lt;", '<'},
                                                                              {"&gt;", '>'},
                                                                              {"&#39;", '\''},
                                                                              {"&nbsp;", ' '},
                                                                              {"&amp;", '&'}}};
    std::string plain;
    while (!text.empty()) {
        const auto* entity = std::find_if(k_entities.begin(), k_entities.end(),
                                          [&](const auto& each) { return text.starts_with(each.first); });
        const bool found = entity != k_entities.end();
        plain += found ? entity->second : text.front();
        text.remove_prefix(found ? entity->first.size() : 1);
    }
    return plain;
}

} // namespace

bool is_page(std::string_view text) {
    const size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
    return first != text.npos && text[first] == '<';
}

std::vector<std::string> projects_in_page(std::string_view text) {
    Page page = take_apart(text);
    auto found = objects_in(page.scripts);
    if (found.empty())
        found = objects_in(without_entities(page.rest));
    if (!found.empty())
        return found;
    // In an attribute, quotes are entities; a plain quote ends the attribute.
    std::replace(page.rest.begin(), page.rest.end(), '"', '\n');
    return objects_in(without_entities(page.rest));
}

} // namespace tidemark::scene
