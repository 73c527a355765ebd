#include "scene/scene.hpp"

#include "base/file.hpp"
#include "scene/directives.hpp"
#include "text/includes.hpp"
#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

Result<void> check_has_main_image(const fs::path& path, const text::MappedText& text) {
    const auto tokens = text::tokenize(text.text());
    if (tokens.empty())
        return fail(ErrorCode::load, fmt::format("'{}' is empty: a scene defines mainImage", path.string()));
    if (std::none_of(tokens.begin(), tokens.end(),
                     [](const text::Token& token) { return token.is("mainImage"); }))
        return fail(ErrorCode::load, fmt::format("'{}' has no mainImage: a scene defines "
                                                 "void mainImage(out vec4 fragColor, in vec2 fragCoord)",
                                                 path.string()));
    return {};
}

void note_pictures(Scene& scene) {
    for (const Pass& pass : scene.passes)
        for (const Channel& channel : pass.channels)
            if (const auto* picture = std::get_if<Picture>(&channel.input))
                if (std::find(scene.files.begin(), scene.files.end(), picture->file) == scene.files.end())
                    scene.files.push_back(picture->file);
}

} // namespace

Result<Scene> load_scene(const fs::path& path) {
    auto expanded = text::expand_includes(path, read_text_file);
    if (!expanded)
        return fail(std::move(expanded.error()));
    const auto with_files = [&](Error error) {
        for (const fs::path& file : expanded->files)
            error.files.push_back(file.string());
        return error;
    };
    Pass image{"Image", std::move(expanded->text), {}};
    auto directives = take_directives(image.text);
    if (!directives)
        return fail(with_files(std::move(directives.error())));
    if (auto checked = check_has_main_image(path, image.text); !checked)
        return fail(with_files(std::move(checked.error())));
    image.channels = std::move(directives->channels);
    Scene scene{path, {}, std::move(directives->knobs), std::move(expanded->files)};
    scene.passes.push_back(std::move(image));
    note_pictures(scene);
    return scene;
}

Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option) {
    const size_t equals = setting.find('=');
    if (equals == 0 || equals == std::string_view::npos)
        return fail(ErrorCode::usage, fmt::format("{} {}: give it as NAME=VALUE", option, setting));
    return std::pair(setting.substr(0, equals), setting.substr(equals + 1));
}

Result<void> override_channel(Scene& scene, std::string_view setting) {
    const auto split = split_setting(setting, "--channel");
    if (!split)
        return fail(split.error());
    const auto [number, what] = *split;
    if (number.size() != 1 || number[0] < '0' || number[0] >= '0' + k_channel_count || what.empty())
        return fail(ErrorCode::usage,
                    fmt::format("--channel {}: give it as N=FILE, N=noise or N=none, N from 0 to {}", setting,
                                k_channel_count - 1));
    Channel channel;
    if (what == "none")
        channel.input = Unbound{};
    else if (what != "noise")
        channel.input = Picture{fs::path(what)};
    scene.passes.back().channels[size_t(number[0] - '0')] = channel;
    note_pictures(scene);
    return {};
}

Result<void> override_knob(Scene& scene, std::string_view setting) {
    const auto split = split_setting(setting, "--set");
    if (!split)
        return fail(split.error());
    const auto knob = find_knob(scene.knobs, split->first);
    if (!knob)
        return fail(knob.error());
    const auto value = parse_knob_value(**knob, split->second);
    if (!value)
        return fail(value.error());
    (*knob)->value = *value;
    return {};
}

} // namespace tidemark::scene
