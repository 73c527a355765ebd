#include "web/page.hpp"

#include "base/try.hpp"
#include "report/html.hpp"
#include "web/parts.hpp"
#include "web/scene_data.hpp"

#include <nlohmann/json.hpp>

namespace tidemark::web {
namespace {

/// Escapes everything to ASCII, since the page around a figure need not be in UTF-8; invalid bytes are
/// replaced.
std::string in_script(const nlohmann::ordered_json& data) {
    return report::in_script(data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace

Result<std::string> make_page(const scene::Scene& scene, PageForm form) {
    const auto data = TRY(scene_data(scene));
    const bool whole = form == PageForm::whole;
    const std::string figure = report::filled(k_figure, {{"{{moment}}", whole ? "" : " data-moment=\"\""},
                                                         {"{{style}}", k_style},
                                                         {"{{scene}}", in_script(data)},
                                                         {"{{host}}", k_host}});
    if (!whole)
        return figure;
    const std::string title = report::escaped(scene.name());
    return report::filled(k_page, {{"{{title}}", title}, {"{{heading}}", title}, {"{{figure}}", figure}});
}

} // namespace tidemark::web
