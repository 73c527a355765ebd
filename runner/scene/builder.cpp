#include "scene/builder.hpp"

#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

/// Image pass for a file that reads itself: such a file was written as a buffer that is shown directly.
constexpr const char* k_show_buffer =
    "void mainImage(out vec4 fragColor, in vec2 fragCoord) {\n"
    "    fragColor = vec4(texelFetch(iChannel0, ivec2(fragCoord), 0).rgb, 1.0);\n"
    "}\n";
constexpr Sampling k_one_to_one{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp, true};

std::string_view entry_of(PassKind kind) {
    switch (kind) {
    case PassKind::cubemap:
        return "void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir)";
    case PassKind::sound: return "vec2 mainSound(int samp, float time)";
    case PassKind::buffer:
    case PassKind::image:
    case PassKind::hit: break;
    }
    return "void mainImage(out vec4 fragColor, in vec2 fragCoord)";
}

std::string_view entry_name_of(PassKind kind) {
    return kind == PassKind::cubemap ? "mainCubemap" : kind == PassKind::sound ? "mainSound" : "mainImage";
}

/// Returns whether `name` occurs in the text; if `exactly`, as a token outside comments.
bool mentions(const std::string& text, std::string_view name, bool exactly) {
    if (text.find(name) == std::string::npos || !exactly)
        return text.find(name) != std::string::npos;
    const auto tokens = text::tokenize(text);
    return std::any_of(tokens.begin(), tokens.end(),
                       [&](const text::Token& token) { return token.is(name); });
}

/// Checks here, because the driver would only report a missing function, in a line that the author did not
/// write. Sound passes are left to the driver: a silent one does not stop the picture.
Result<void> check_entry(const Scene& scene, const Draft& draft) {
    const PassKind kind = draft.pass.kind;
    if (kind == PassKind::sound)
        return {};
    const std::string& text = draft.pass.text.text();
    const bool by_hand = !draft.file.empty(); // a ShaderToy project compiled there, so a plain search will do
    for (const std::string* part : {&text, &scene.common.text()})
        if (mentions(*part, entry_name_of(kind), by_hand) ||
            mentions(*part, "main", true)) // the oldest shaders have main
            return {};
    const std::string place =
        draft.file.empty() ? draft.pass.text.lines().locate(1).file : draft.file.string();
    if (place.empty())
        return fail(ErrorCode::load, fmt::format("'{}': the pass '{}' is empty: it defines {}",
                                                 scene.file.string(), draft.pass.name, entry_of(kind)));
    const bool empty = text::tokenize(text).empty();
    const std::string what = draft.file.empty() ? "pass" : "scene";
    if (empty)
        return fail(ErrorCode::load,
                    fmt::format("'{}' is empty: a {} defines {}", place, what, entry_name_of(kind)));
    return fail(ErrorCode::load, fmt::format("'{}' has no {}: a {} defines {}", place, entry_name_of(kind),
                                             what, entry_of(kind)));
}

bool is_read(const std::vector<Draft>& drafts, size_t wanted) {
    for (const Draft& draft : drafts)
        for (const Channel& channel : draft.pass.channels)
            if (const size_t* read = source_pass(channel.input); read && *read == wanted)
                return true;
    return false;
}

/// If a pass reads Image, makes Image a buffer and adds a pass that shows it. Returns the number of the Image
/// pass.
size_t show_image_that_is_read(std::vector<Draft>& drafts, size_t image) {
    if (!is_read(drafts, image))
        return image;
    Pass& buffer = drafts[image].pass;
    buffer.kind = PassKind::buffer;
    buffer.name = drafts[image].file.empty() ? "Image buffer" : drafts[image].file.filename().string();
    Draft shown;
    shown.pass.name = "Image";
    shown.pass.text.append_generated(k_show_buffer);
    for (Channel& channel : shown.pass.channels)
        channel.input = Unbound{};
    shown.pass.channels[0] = {PassOutput{image}, k_one_to_one, {}};
    drafts.push_back(std::move(shown));
    return drafts.size() - 1;
}

} // namespace

void note_file(Scene& scene, const fs::path& file) {
    if (!file.empty() && std::find(scene.files.begin(), scene.files.end(), file) == scene.files.end())
        scene.files.push_back(file);
}

void note_files(Scene& scene, const Channel& channel) {
    for (const fs::path& file : input_files(channel.input))
        note_file(scene, file);
}

Result<void> finish_scene(Scene& scene, std::vector<Draft> drafts, const std::vector<size_t>& order) {
    for (const size_t draft : order)
        if (auto checked = check_entry(scene, drafts[draft]); !checked)
            return checked;
    std::vector<size_t> drawn = order;
    for (const size_t draft : order)
        if (drafts[draft].pass.kind == PassKind::image)
            if (const size_t image = show_image_that_is_read(drafts, draft); image != draft)
                drawn.push_back(image);
    std::stable_sort(drawn.begin(), drawn.end(),
                     [&](size_t a, size_t b) { return drafts[a].pass.kind < drafts[b].pass.kind; });
    std::vector<size_t> place(drafts.size());
    for (size_t i = 0; i < drawn.size(); ++i)
        place[drawn[i]] = i;
    for (const size_t draft : drawn) {
        for (Channel& channel : drafts[draft].pass.channels) {
            if (size_t* read = source_pass(channel.input))
                *read = place[*read];
            note_files(scene, channel);
        }
        scene.passes.push_back(std::move(drafts[draft].pass));
    }
    return {};
}

} // namespace tidemark::scene
