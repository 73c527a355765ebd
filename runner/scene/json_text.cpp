#include "scene/json_text.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tidemark::scene {
namespace {

// Limits. A typical large project has some 200 values, 6 levels and 15 members in its longest object.
constexpr size_t k_deepest = 64;
constexpr size_t k_most_members = 1024; // an object searches its keys one by one
constexpr size_t k_most_values = size_t{1} << 20;

/// Checks the limits by brackets, commas and strings alone, without building a tree.
class Survey {
public:
    Survey(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    Result<void> run() {
        for (; position_ < text_.size(); ++position_) {
            switch (text_[position_]) {
            case '"': skip_string(); break;
            case '\n': ++line_; break;
            case '{':
            case '[': open_.push_back({text_[position_] == '{', 0}); break;
            case '}':
            case ']':
                if (!open_.empty())
                    open_.pop_back();
                break;
            case ',':
                ++values_;
                if (!open_.empty())
                    ++open_.back().commas;
                break;
            default: break;
            }
            if (open_.size() > k_deepest)
                return refuse(fmt::format("is nested more than {} deep", k_deepest));
            if (!open_.empty() && open_.back().object && open_.back().commas >= k_most_members)
                return refuse(fmt::format("has an object with more than {} members", k_most_members));
            if (values_ >= k_most_values)
                return refuse(fmt::format("has more than {} values", k_most_values));
        }
        return {};
    }

    /// Positions of `\uXXXX` escapes that are only half of a surrogate pair.
    const std::vector<size_t>& lone_surrogates() const { return lone_surrogates_; }

private:
    struct Open {
        bool object;
        size_t commas;
    };

    tl::unexpected<Error> refuse(const std::string& what) const {
        return fail(
            error_at({file_, line_, 0}, fmt::format("this JSON {}: it is not a ShaderToy project", what)));
    }

    /// Returns the code unit of a `\uXXXX` at `at`; 0 if there is none.
    unsigned escape_at(size_t at) const {
        if (at + 6 > text_.size() || text_[at] != '\\' || text_[at + 1] != 'u')
            return 0;
        unsigned unit = 0;
        for (size_t i = at + 2; i < at + 6; ++i) {
            const char c = text_[i];
            const int digit = c >= '0' && c <= '9'   ? c - '0'
                              : c >= 'a' && c <= 'f' ? c - 'a' + 10
                              : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                     : -1;
            if (digit < 0)
                return 0;
            unit = unit * 16 + unsigned(digit);
        }
        return unit;
    }

    void skip_string() {
        const auto high = [](unsigned unit) { return unit >= 0xD800 && unit < 0xDC00; };
        const auto low = [](unsigned unit) { return unit >= 0xDC00 && unit < 0xE000; };
        for (++position_; position_ < text_.size() && text_[position_] != '"'; ++position_) {
            if (text_[position_] == '\n')
                ++line_;
            if (text_[position_] != '\\')
                continue;
            const unsigned unit = escape_at(position_);
            if (high(unit) && low(escape_at(position_ + 6)))
                position_ += 6;
            else if (high(unit) || low(unit))
                lone_surrogates_.push_back(position_);
            position_ += unit ? 5 : 1;
        }
    }

    std::string_view text_;
    const std::string& file_;
    size_t position_ = 0;
    int line_ = 1;
    size_t values_ = 0;
    std::vector<Open> open_;
    std::vector<size_t> lone_surrogates_;
};

SourceLocation locate(std::string_view text, size_t offset, const std::string& file) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const size_t line_begin = before.find_last_of('\n') + 1;
    return {file, int(std::count(before.begin(), before.end(), '\n')) + 1,
            int(before.size() - line_begin) + 1};
}

/// Returns the library's message without its prefix, its position and the quoted rest of the text.
std::string_view plain_words(std::string_view what) {
    const size_t syntax = what.find("syntax error");
    what = syntax == std::string_view::npos ? what.substr(what.find("] ") + 2) : what.substr(syntax);
    const size_t dash = what.find(" - ");
    if (dash != std::string_view::npos)
        what.remove_prefix(dash + 3);
    return what.substr(0, std::min(what.find("; last read"), size_t{200}));
}

bool is_project(const Json& json) {
    return json.is_object() && json.contains("renderpass");
}

bool is_pass(const Json& json) {
    return json.is_object() && json.contains("code");
}

} // namespace

Result<Json> parse_json(std::string_view text, const std::string& file) {
    if (text.find_first_not_of(" \t\r\n") == text.npos)
        return fail(error_at({file}, "this is not JSON: it is empty"));
    Survey survey(text, file);
    TRY(survey.run());
    std::string mended;
    if (!survey.lone_surrogates().empty()) {
        mended = text;
        for (const size_t at : survey.lone_surrogates())
            mended.replace(at, 6, "\\ufffd");
        text = mended;
    }
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        const size_t offset = error.byte > 0 ? error.byte - 1 : 0;
        return fail(error_at(locate(text, offset, file),
                             fmt::format("this is not JSON: {}", plain_words(error.what()))));
    } catch (const Json::exception& error) {
        return fail(error_at({file}, fmt::format("this is not JSON: {}", plain_words(error.what()))));
    }
}

Result<Json*> find_passes(Json& json, const std::string& file) {
    const auto refuse = [&](std::string_view why) { return fail(error_at({file}, std::string(why))); };
    Json* found = &json;
    for (int depth = 0; depth < 4; ++depth) {
        if (is_project(*found))
            return &(*found)["renderpass"];
        if (found->is_object() && found->contains("Error"))
            return refuse(fmt::format("ShaderToy answered with an error instead of a project: {}",
                                      as_text(*found, "Error")));
        if (found->is_array() && !found->empty() && is_pass(found->front()))
            return found;
        if (found->is_object() && found->contains("Shader"))
            found = &(*found)["Shader"];
        else if (found->is_object() && found->contains("shaders"))
            found = &(*found)["shaders"];
        else if (found->is_array() && found->size() == 1)
            found = &found->front();
        else
            break;
    }
    if (found->is_array() && found->size() > 1 && (is_project((*found)[0]) || (*found)[0].contains("Shader")))
        return refuse(
            fmt::format("this holds {} projects: save one of them in a file of its own", found->size()));
    if (found->is_array() && found->empty())
        return refuse("this is an empty list: the project does not exist on ShaderToy, or it is not public");
    return refuse("this is not a ShaderToy project: it has no list named renderpass");
}

std::string as_text(const Json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end())
        return {};
    if (found->is_string())
        return found->get<std::string>();
    return found->is_number() ? found->dump() : std::string();
}

} // namespace tidemark::scene
