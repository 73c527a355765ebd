#include "web/page.hpp"

#include "base/try.hpp"
#include "web/parts.hpp"
#include "web/scene_data.hpp"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string_view>
#include <utility>

namespace tidemark::web {
namespace {

struct Filling {
    std::string_view mark;
    std::string_view text;
};

/// Each mark of the form once, in their order; what is filled in is not looked at again.
std::string filled(std::string_view form, std::initializer_list<Filling> fillings) {
    std::string page;
    for (const auto& [mark, text] : fillings) {
        const size_t at = form.find(mark);
        page.append(form.substr(0, at)).append(text);
        form.remove_prefix(at + mark.size());
    }
    return page.append(form);
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return safe;
}

/// What stands in a `<script>` ends at the first `</script`, whatever it is to JSON.
std::string in_script(const nlohmann::ordered_json& data) {
    using Json = nlohmann::ordered_json;
    std::string safe;
    for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace))
        safe += c == '<' ? "\\u003c" : std::string(1, c);
    return safe;
}

} // namespace

Result<std::string> make_page(const scene::Scene& scene, PageForm form) {
    const auto data = TRY(scene_data(scene));
    const bool whole = form == PageForm::whole;
    const std::string figure = filled(k_figure, {{"{{moment}}", whole ? "" : " data-moment=\"\""},
                                                 {"{{style}}", k_style},
                                                 {"{{scene}}", in_script(data)},
                                                 {"{{host}}", k_host}});
    if (!whole)
        return figure;
    const std::string title = escaped(scene.name());
    return filled(k_page, {{"{{title}}", title}, {"{{heading}}", title}, {"{{figure}}", figure}});
}

} // namespace tidemark::web
