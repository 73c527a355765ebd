#include "cli/search_options.hpp"

#include "base/try.hpp"
#include "cli/options.hpp"
#include "render/frame_plan.hpp"

#include <fmt/format.h>

namespace tidemark::cli {

void add_search_options(Command command, SearchOptions& options) {
    command
        .add_option("--views", options.views,
                    "Times and places of the mouse as parts of the picture, as in 0;10@0.75,0.4")
        .type_name("LIST")
        .default_str(options.usual_views);
    command.add_option("--size", options.size, "Resolution in pixels [320x180]").type_name("WxH");
    command.add_option("--for", options.seconds, "Seconds for the search and the timing, compiling aside")
        .type_name("S")
        .capture_default_str();
    command
        .add_option("-o,--output", options.output,
                    fmt::format("Folder for the report [SCENE-{}]", command.name()))
        .type_name("FOLDER");
    command.add_flag("--write", options.write, "Writes what was chosen into the scene's files");
    add_device_options(command, options.device);
    command.add_flag("--json", options.json, "What was chosen and its study on standard output");
}

Result<lab::SearchRequest> search_request(const SearchOptions& options, const scene::Scene& scene) {
    lab::SearchRequest request;
    const std::string& unasked = render::may_have_feedback(scene) ? options.early_views : options.usual_views;
    request.views = TRY(lab::parse_views(options.views.empty() ? unasked : options.views));
    if (!options.size.empty())
        request.extent = TRY(parse_size(options.size));
    if (!(options.seconds > 0))
        return fail(ErrorCode::usage, "--for: give a number of seconds above 0");
    request.seconds = options.seconds;
    return request;
}

} // namespace tidemark::cli
