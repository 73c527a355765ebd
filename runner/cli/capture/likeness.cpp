#include "cli/capture/likeness.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/json_dump.hpp"
#include "cli/picture_facts.hpp"
#include "image/files/picture_metadata.hpp"
#include "scene/bounds.hpp"
#include "scene/sources.hpp"
#include "scene/stated_size.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace tidemark::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> refuse(const std::string& picture, std::string_view why) {
    return fail(ErrorCode::usage, fmt::format("--like {}: {}", picture, why));
}

Result<Moment> read_moment(const std::string& picture, const image::Metadata& metadata) {
    const std::string* text = image::find(metadata, k_moment);
    if (!text)
        return refuse(picture,
                      "it does not hold how it was drawn: give one that `tidemark capture` or the window's "
                      "S saved, other than .hdr, and that no other program has saved since");
    if (auto moment = moment_of(parse_or_discard(*text)))
        return *std::move(moment);
    return refuse(picture, "what it says of how it was drawn is damaged");
}

/// Removes paths that lead out of the scene's folder, which the scene's own text could not use either.
void keep_inside(const std::string& picture, const SceneRequest& typed, Moment& moment) {
    std::error_code ignored;
    const fs::path scene = typed.path;
    const scene::Bounds bounds(fs::is_directory(scene, ignored) ? scene : scene.parent_path(),
                               typed.files.allow_outside);
    const auto leads_out = [&](const std::string& option, const fs::path& file) {
        if (file.empty() || bounds.check(file))
            return false;
        say(fmt::format(
            "--like {}: left out, for it leads out of the scene's folder: {} (--allow-outside takes it)",
            picture, option));
        return true;
    };
    std::erase_if(moment.scene.channels, [&](const std::string& channel) {
        const scene::ChannelInput input = scene::input_of_name(channel.substr(channel.find('=') + 1), {});
        for (const fs::path& file : input_files(input))
            if (leads_out("--channel " + channel, file))
                return true;
        return false;
    });
    if (leads_out("--media " + moment.scene.files.media.string(), moment.scene.files.media))
        moment.scene.files.media.clear();
    if (leads_out("--input " + moment.sequence.input_file, moment.sequence.input_file))
        moment.sequence.input_file.clear();
}

/// Returns the metadata value of that name, if it is a number within the limits of its option.
template <class T>
std::optional<T> number_in(const image::Metadata& metadata, std::string_view name, T low, T high) {
    const std::string* const text = image::find(metadata, name);
    T number{};
    if (!text || std::from_chars(text->data(), text->data() + text->size(), number).ec != std::errc() ||
        !(number >= low && number <= high))
        return std::nullopt;
    return number;
}

/// Takes --samples and --shutter from the metadata if they are not given.
void take_exposure(const image::Metadata& metadata, CaptureOptions& options) {
    if (!options.samples)
        options.samples = number_in(metadata, "Samples", 1, render::k_most_samples);
    if (!options.shutter)
        options.shutter = number_in(metadata, "Shutter", 0.0, 1.0);
}

/// Fills everything not given on the command line from the moment.
SceneRequest completed(SceneRequest typed, Moment& moment) {
    SceneRequest& scene = moment.scene;
    typed.sets = merged(std::move(scene.sets), typed.sets);
    typed.defines = merged(std::move(scene.defines), typed.defines);
    typed.channels = merged(std::move(scene.channels), typed.channels);
    if (typed.files.media.empty())
        typed.files.media = scene.files.media;
    if (!typed.doubles)
        typed.doubles = scene.doubles;
    typed.double_hashes |= scene.double_hashes;
    typed.knobs_may_go = true; // another text may have other knobs
    return typed;
}

} // namespace

Result<CaptureOptions> with_likeness(CaptureOptions options) {
    SceneRequest& scene = options.scene;
    if (options.like.empty())
        return scene.path.empty()
                   ? Result<CaptureOptions>(fail(ErrorCode::usage, "capture: SCENE is required"))
                   : std::move(options);
    const auto metadata = image::read_metadata(options.like);
    if (!metadata)
        return refuse(options.like, metadata.error());
    Moment moment = TRY(read_moment(options.like, *metadata));
    const Extent size = moment.sequence.state.extent;
    if (!options.frames.size && std::max(size.width, size.height) > scene::k_largest_stated_side)
        return refuse(
            options.like,
            fmt::format("it says that it has {}x{} pixels; a file may ask for {} on a side: give --size",
                        size.width, size.height, scene::k_largest_stated_side));
    std::error_code ignored;
    if (scene.path.empty() && !fs::exists(moment.scene.path, ignored))
        return refuse(options.like,
                      fmt::format("its scene '{}' is not here: give one, as in `tidemark capture SCENE "
                                  "--like {}`",
                                  moment.scene.path.string(), options.like));
    if (scene.path.empty())
        scene.path = moment.scene.path;
    keep_inside(options.like, scene, moment);
    erase_named(scene.sets, moment.sequence.state.knobs);
    if (!moment.sequence.input_file.empty() && !options.frames.input) {
        options.frames.input = moment.sequence.input_file;
        moment.sequence.state = without_recorded(std::move(moment.sequence.state));
    }
    scene = completed(std::move(scene), moment);
    take_exposure(*metadata, options);
    const std::string* fingerprint = image::find(*metadata, k_fingerprint);
    options.likeness = Likeness{std::move(moment.sequence), fingerprint ? *fingerprint : ""};
    return options;
}

void say_what_is_unlike(const CapturePlan& plan, const Fingerprint& fingerprint) {
    if (plan.like.empty() || !plan.likeness)
        return;
    const Fingerprint there = Fingerprint::parse(plan.likeness->fingerprint).of_scene();
    if (const std::string other = fingerprint.of_scene().differences(there); !other.empty())
        say(fmt::format("not quite like {}: {}", plan.like, other));
}

} // namespace tidemark::cli
