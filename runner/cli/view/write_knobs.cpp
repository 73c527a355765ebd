#include "cli/view/write_knobs.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "scene/knob_defaults.hpp"

#include <fmt/format.h>

#include <map>

namespace tidemark::cli {
namespace {

Result<std::string> write_into(const std::string& file, const std::vector<scene::Knob>& knobs) {
    const std::string text = TRY(read_text_file(file));
    const auto changed = scene::with_defaults(text, knobs);
    if (!changed)
        return fail(ErrorCode::write,
                    fmt::format("cannot write knobs into '{}': {}", file, changed.error().message));
    TRY(replace_text(OutputPath::typed(file), text, *changed));
    std::string line = fmt::format("{}:", file);
    for (const scene::Knob& knob : knobs)
        line += fmt::format(" {} = {}", knob.name, to_string(knob));
    return line;
}

} // namespace

Result<std::vector<std::string>> write_knobs(const std::vector<scene::Knob>& knobs) {
    std::map<std::string, std::vector<scene::Knob>> by_file;
    for (const scene::Knob& knob : knobs)
        if (knob.value != knob.initial)
            by_file[knob.where.file].push_back(knob);
    if (by_file.empty())
        return std::vector<std::string>{"nothing to write: every knob is as the file has it"};
    std::vector<std::string> lines;
    for (const auto& [file, turned] : by_file)
        lines.push_back(TRY(write_into(file, turned)));
    return lines;
}

} // namespace tidemark::cli
