#include "scene/project_drafts.hpp"

#include "base/try.hpp"
#include "scene/stated_size.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace {

using Kind = ProjectPass::Kind;

/// Returns nullopt if the project states no size.
Result<std::optional<Extent>> read_size(const std::string& text, const std::string& file) {
    const auto size = size_of_text(text);
    if (!text.empty() && !size)
        return fail(error_at(
            {file},
            fmt::format("the size of Image is '{}': give WIDTHxHEIGHT in pixels, as in 800x450", text)));
    return size;
}

/// Returns whether a later pass replaces this one: ShaderToy has one pass of each kind, except buffers and
/// Common.
bool is_replaced(const Project& project, size_t pass) {
    const Kind kind = project.passes[pass].kind;
    return kind != Kind::buffer && kind != Kind::common &&
           std::any_of(project.passes.begin() + std::ptrdiff_t(pass) + 1, project.passes.end(),
                       [&](const ProjectPass& later) { return later.kind == kind; });
}

std::string_view word_for(Kind kind) {
    return kind == Kind::image ? "Image" : kind == Kind::cubemap ? "Cube A" : "Sound";
}

} // namespace

PassKind kind_of(PassName::Kind kind) {
    switch (kind) {
    case Kind::buffer: return PassKind::buffer;
    case Kind::cubemap: return PassKind::cubemap;
    case Kind::sound: return PassKind::sound;
    case Kind::common:
    case Kind::image: break;
    }
    return PassKind::image;
}

Result<ProjectDrafts> draft_project(Scene& scene, InputReader::Context context) {
    const Project& project = context.project;
    const std::string file = context.file;
    scene.warnings.insert(scene.warnings.end(), project.warnings.begin(), project.warnings.end());
    if (std::none_of(project.passes.begin(), project.passes.end(),
                     [](const ProjectPass& pass) { return pass.kind == Kind::image; }))
        return fail(error_at({file}, "this project has no Image pass: there is nothing to show"));

    ProjectDrafts result;
    for (size_t i = 0; i < project.passes.size(); ++i) {
        const ProjectPass& pass = project.passes[i];
        if (pass.kind == Kind::common) {
            result.of_pass.emplace_back();
            continue;
        }
        result.of_pass.emplace_back(result.drafts.size());
        Draft draft;
        draft.pass.kind = kind_of(pass.kind);
        draft.pass.name = context.names[i];
        result.drafts.push_back(std::move(draft));
        if (pass.kind == Kind::image)
            scene.size = TRY(read_size(pass.size, file));
        if (!is_replaced(project, i)) {
            result.order.push_back(result.drafts.size() - 1);
            result.drafts.back().pass.name =
                pass.kind == Kind::buffer ? context.names[i] : word_for(pass.kind);
            continue;
        }
        scene.warnings.push_back({{file},
                                  Severity::warning,
                                  fmt::format("the project has several {} passes: only the last one is drawn",
                                              word_for(pass.kind))});
    }
    InputReader inputs(std::move(context));
    for (size_t i = 0; i < project.passes.size(); ++i) {
        if (!result.of_pass[i])
            continue;
        Channels& channels = result.drafts[*result.of_pass[i]].pass.channels;
        for (Channel& channel : channels)
            channel.input = Unbound{};
        for (const ProjectInput& input : project.passes[i].inputs) {
            auto channel = TRY(inputs.read(input));
            if (size_t* read = source_pass(channel.input))
                *read = *result.of_pass[*read];
            channels[size_t(input.channel)] = std::move(channel);
        }
    }
    auto warnings = inputs.take_warnings();
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
    return result;
}

std::string plain_text(std::string text) {
    std::replace(text.begin(), text.end(), '\0', ' ');
    return text::with_plain_line_ends(std::move(text));
}

} // namespace tidemark::scene
