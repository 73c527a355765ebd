#include "scene/scene.hpp"

#include "base/error.hpp"
#include "scene/channel.hpp"
#include "scene/names.hpp"
#include "scene/pass_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace tidemark::scene {

std::optional<Extent> size_of_text(std::string_view text) {
    const auto extent = parse_extent(text);
    return extent && std::max(extent->width, extent->height) <= k_largest_stated_side ? extent : std::nullopt;
}

std::string to_string(const Extent& size) {
    return fmt::format("{}x{}", size.width, size.height);
}

namespace fs = std::filesystem;
std::string Scene::name() const {
    const fs::path named = file.has_filename() ? file : file.parent_path(); // "folder/" has none
    return named.stem().string();
}

const Pass* Scene::find(PassKind kind) const {
    const auto found =
        std::find_if(passes.rbegin(), passes.rend(), [&](const Pass& pass) { return pass.kind == kind; });
    return found == passes.rend() ? nullptr : &*found;
}

size_t Scene::image_index() const {
    const Pass* const image = find(PassKind::image);
    return size_t((image ? image : find(PassKind::hit)) - passes.data());
}

TextureKind texture_kind(const Scene& scene, const ChannelInput& input) {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (k_traits<Kind>.from == ReadsFrom::pass)
                return scene.passes[kind.pass].kind == PassKind::cubemap ? TextureKind::cube
                                                                         : TextureKind::flat;
            else if constexpr (k_traits<Kind>.texture)
                return *k_traits<Kind>.texture;
            else
                return kind.texture();
        },
        input);
}

namespace {

bool in_range(const Knob& knob) {
    if (!knob.range)
        return true;
    for (size_t i = 0; i < size_t(info(knob.type).components); ++i)
        if (knob.value[i] < knob.range->low[i] || knob.value[i] > knob.range->high[i])
            return false;
    return true;
}

/// Suggests the right form for a setting without `=`: a number, possibly with a pass, lacks an input; an
/// input lacks a number.
std::string channel_setting_like(std::string_view setting) {
    const std::string_view number = setting.substr(setting.rfind(':') + 1);
    if (!number.empty() && number.find_first_not_of("0123456789") == number.npos)
        return fmt::format("{0}=FILE, {0}=noise or {0}=none{1}", number.size() == 1 ? setting : "N",
                           number.size() == 1 ? "" : fmt::format(", N from 0 to {}", k_channel_count - 1));
    return fmt::format("0={}", setting.empty() || setting.front() == '=' ? "noise" : setting);
}

/// Returns the inputs that only `--channel` accepts.
std::optional<ChannelInput> test_input(std::string_view name) {
    constexpr std::pair<std::string_view, Constant::Kind> k_names[] = {{"black", Constant::Kind::black},
                                                                       {"white", Constant::Kind::white},
                                                                       {"nan", Constant::Kind::nan},
                                                                       {"texel", Constant::Kind::texel}};
    if (name == "none")
        return Unbound{};
    for (const auto& [known, kind] : k_names)
        if (name == known)
            return Constant{kind};
    return std::nullopt;
}

/// Returns the pass named before the colon, or Image, and the channel's number as text.
Result<std::pair<Pass*, std::string_view>> channel_of(Scene& scene, std::string_view place) {
    const size_t colon = place.rfind(':');
    if (colon == std::string_view::npos)
        return std::pair(&scene.passes[scene.image_index()], place);
    const std::string_view name = place.substr(0, colon);
    const auto pass = std::ranges::find(scene.passes, name, &Pass::name);
    if (pass != scene.passes.end())
        return std::pair(&*pass, place.substr(colon + 1));
    std::string names;
    for (const Pass& known : scene.passes)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
    return fail(ErrorCode::usage, fmt::format("--channel {}: no such pass; the scene has {}", place, names));
}

} // namespace

Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option) {
    const size_t equals = setting.find('=');
    if (equals == 0 || equals == std::string_view::npos)
        return fail(ErrorCode::usage,
                    fmt::format("{} {}: give it as {}", option, setting,
                                option == "--channel" ? channel_setting_like(setting) : "NAME=VALUE"));
    return std::pair(setting.substr(0, equals), setting.substr(equals + 1));
}

Result<void> override_channel(Scene& scene, std::string_view setting) {
    const auto split = TRY(split_setting(setting, "--channel"));
    const std::string_view what = split.second;
    const auto place = TRY(channel_of(scene, split.first));
    const auto [pass, number] = place;
    if (number.size() != 1 || number[0] < '0' || number[0] >= '0' + k_channel_count || what.empty())
        return fail(ErrorCode::usage,
                    fmt::format("--channel {}: give it as N=FILE, N=noise or N=none, N from 0 to {}", setting,
                                k_channel_count - 1));
    const auto test = test_input(what);
    if (!test && names_a_pass(what))
        return fail(ErrorCode::usage,
                    fmt::format("--channel {}: '{}' is a pass: bind it in the scene with #iChannel{}",
                                setting, what, number));
    // The user's own path: no bounds.
    Channel channel;
    channel.input = test ? *test : input_of_name(what, {});
    if (const InputTraits& traits = traits_of(channel.input); traits.by_name)
        channel.sampling = traits.sampling;
    pass->channels[size_t(number[0] - '0')] = channel;
    note_files(scene, channel);
    return {};
}

Result<void> override_knob(Scene& scene, std::string_view setting) {
    const auto split = TRY(split_setting(setting, "--set"));
    const auto knob = TRY(find_knob(scene.knobs, split.first));
    const auto value = TRY(parse_knob_value(*knob, split.second));
    knob->value = value;
    if (!in_range(*knob))
        scene.warnings.push_back(
            {knob->where, Severity::warning,
             fmt::format("--set {}: {} has the range {} to {}; the value is used anyway", setting, knob->name,
                         to_string(*knob, knob->range->low), to_string(*knob, knob->range->high))});
    return {};
}

// The inputs of a channel.

namespace {

constexpr std::string_view k_microphone = "microphone";
constexpr std::string_view k_webcam = "webcam";

} // namespace

std::optional<ChannelInput> generated_input(std::string_view name) {
    // Without a file these are the live microphone and webcam, if the user turned them on.
    if (name == k_microphone)
        return Music{};
    if (name == k_webcam)
        return Video{};
    std::optional<ChannelInput> found;
    const auto offer = [&]<class Kind>(std::type_identity<Kind>) {
        if (k_traits<Kind>.by_name && k_traits<Kind>.name == name)
            found = Kind{};
    };
    [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        (offer(std::type_identity<Kinds>()), ...);
    }(std::type_identity<ChannelInput>());
    return found;
}

std::span<const std::filesystem::path> input_files(const ChannelInput& input) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> std::span<const std::filesystem::path> {
            if constexpr (k_traits<Kind>.from == ReadsFrom::file)
                return {&kind.file, kind.file.empty() ? size_t(0) : size_t(1)};
            else if constexpr (k_traits<Kind>.from == ReadsFrom::files)
                return kind.files;
            else
                return {};
        },
        input);
}

const size_t* source_pass(const ChannelInput& input) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const size_t* {
            if constexpr (k_traits<Kind>.from == ReadsFrom::pass)
                return &kind.pass;
            else
                return nullptr;
        },
        input);
}

size_t* source_pass(ChannelInput& input) {
    return const_cast<size_t*>(source_pass(std::as_const(input)));
}

} // namespace tidemark::scene
