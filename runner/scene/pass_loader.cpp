#include "scene/pass_loader.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "scene/names.hpp"
#include "scene/project.hpp"

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
    Error error{ErrorCode::load, fmt::format("'{}' has no {}: a {} defines {}", place, entry_name_of(kind),
                                             what, entry_of(kind))};
    error.diagnostics = scene.warnings; // the text may be written for another host
    return fail(std::move(error));
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
        TRY(check_entry(scene, drafts[draft]));
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

namespace {

/// Enough for every real scene; a chain of thousands of files is a mistake or an attack.
constexpr size_t k_most_passes = 64;

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return a == b || fs::equivalent(a, b, ignored);
}

bool contains(const std::vector<fs::path>& files, const fs::path& file) {
    return std::find(files.begin(), files.end(), file) != files.end();
}

} // namespace

PassLoader::PassLoader(Scene& scene, fs::path folder, const Bounds& bounds, Conditional conditional)
    : scene_(scene), folder_(std::move(folder)), bounds_(bounds), conditional_(conditional) {}

size_t PassLoader::add(Draft draft, Order order) {
    drafts_.push_back(std::move(draft));
    included_.emplace_back();
    order_of_.push_back(order);
    return drafts_.size() - 1;
}

Result<PassLoader::FileText> PassLoader::read(const fs::path& file, bool common) {
    const auto read_part = [&](const fs::path& path) -> Result<std::string> {
        // The path that the user gave may be a link.
        if (path != scene_.file.lexically_normal())
            TRY(bounds_.check(path));
        if (const std::string* held = bounds_.unsaved(path))
            return conditional_ == Conditional::read ? *held : plain_text(*held);
        if (conditional_ != Conditional::read)
            return read_file(path).map(plain_text);
        auto text = read_text_file(path);
        const std::string_view advice = advice_on_missing_include(path.filename().string());
        if (!text && !advice.empty())
            return fail(text.error().code, fmt::format("{}. {}", text.error().message, advice));
        return text;
    };
    const auto read_text = [&](const fs::path& path) {
        return read_part(path).map([&](std::string text) {
            return common && path == file ? text::with_plain_line_ends(std::move(text)) + '\n' : text;
        });
    };
    auto expanded = TRY(text::expand_includes(file, read_text, bounds_.library()));
    for (const auto* paths : {&expanded.files, &expanded.missing}) // a missing one may appear later
        for (const fs::path& path : *paths)
            note_file(scene_, path);
    auto directives = TRY(take_directives(expanded.text, conditional_));
    scene_.warnings.insert(scene_.warnings.end(), directives.warnings.begin(), directives.warnings.end());
    OtherHosts others;
    if (conditional_ == Conditional::read) {
        std::array<bool, k_channel_count> taken{};
        std::ranges::transform(directives.sources, taken.begin(),
                               [](const std::string& source) { return !source.empty(); });
        others = read_other_hosts(expanded.text, taken, directives.knobs);
        for (Knob& knob : others.knobs)
            if (!knob_of_name_.contains(knob.name))
                directives.knobs.push_back(std::move(knob));
        for (Diagnostic& warning : others.warnings)
            if (std::ranges::find(scene_.warnings, warning) == scene_.warnings.end())
                scene_.warnings.push_back(std::move(warning));
    }
    TRY(add_knobs(std::move(directives.knobs)));
    return FileText{std::move(expanded.text), std::move(directives), std::move(expanded.files),
                    std::move(others)};
}

/// A knob that several passes declare with the same type is one knob: it has one slider and one value.
Result<void> PassLoader::add_knobs(std::vector<Knob> knobs) {
    for (Knob& knob : knobs) {
        const auto [found, is_new] = knob_of_name_.try_emplace(knob.name, scene_.knobs.size());
        const Knob* const same = is_new ? nullptr : &scene_.knobs[found->second];
        if (is_new) {
            scene_.knobs.push_back(std::move(knob));
        } else if (same->type != knob.type) {
            Error error = error_at(
                knob.where, fmt::format("the knob '{}' is a {} here and a {} in another pass", knob.name,
                                        info(knob.type).directive_name, info(same->type).directive_name));
            error.diagnostics.push_back({same->where, Severity::note, "first declared here"});
            return fail(std::move(error));
        }
    }
    return {};
}

Result<void> PassLoader::load_common(const fs::path& file) {
    auto read_file = TRY(read(file, true));
    TRY(take_size(read_file.directives, {}));
    commons_.push_back({file.lexically_normal(), std::move(read_file.text)});
    return {};
}

/// Only `#iSize` in Image's own file counts: a text that several scenes share must not set one scene's size.
Result<void> PassLoader::take_size(const Directives& directives, const fs::path& image) {
    const StatedSize* taken = nullptr;
    for (const StatedSize& size : directives.sizes) {
        if (image.empty() || !is_same_file(size.where.file, image)) {
            scene_.warnings.push_back({size.where, Severity::warning,
                                       "#iSize is ignored: it only has an effect in the file of Image"});
            continue;
        }
        if (taken) {
            Error error = error_at(size.where, "#iSize is given twice");
            error.diagnostics.push_back({taken->where, Severity::note, "first given here"});
            return fail(std::move(error));
        }
        taken = &size;
        scene_.size = size.extent;
    }
    return {};
}

Result<void> PassLoader::load(size_t draft) {
    if (!drafts_[draft].file.empty()) {
        auto file = TRY(read(drafts_[draft].file));
        drafts_[draft].pass.text = std::move(file.text);
        drafts_[draft].pass.keyboard_helpers = file.directives.keyboard_helpers;
        drafts_[draft].pass.bare_file = conditional_ == Conditional::read;
        TRY(take_size(file.directives,
                      drafts_[draft].pass.kind == PassKind::image ? drafts_[draft].file : fs::path()));
        scene_.moves_view = scene_.moves_view || file.directives.moves_view;
        included_[draft] = std::move(file.files);
        loading_.push_back(draft);
        drafts_[draft].pass.definitions = std::move(file.others.definitions);
        auto bound =
            bind(draft, file.directives).and_then([&] { return bind_other_hosts(draft, file.others); });
        loading_.pop_back();
        if (!bound)
            return bound;
    }
    order_.push_back(draft);
    return {};
}

Result<void> PassLoader::bind(size_t draft, const Directives& directives) {
    for (size_t i = 0; i < directives.sources.size(); ++i) {
        Channel channel = directives.channels[i];
        if (directives.sources[i].empty()) {
            // No directive names it. In a file that is not part of a project it reads noise, perhaps with
            // another sampler.
            if (conditional_ == Conditional::read)
                drafts_[draft].pass.channels[i] = std::move(channel);
            continue;
        }
        auto input = TRY(input_of(draft, channel, directives.sources[i]));
        channel.input = std::move(input);
        drafts_[draft].pass.channels[i] = std::move(channel);
    }
    return {};
}

Result<void> PassLoader::bind_other_hosts(size_t draft, const OtherHosts& others) {
    constexpr Sampling k_clamped = k_buffer_sampling;
    if (others.last_frame) {
        drafts_[draft].pass.channels[*others.last_frame] = {PassOutput{draft}, k_clamped, {}};
        drafts_[draft].pass.stores_bytes = true;
    }
    if (drafts_[draft].buffer)
        drafts_[draft].pass.definitions += fmt::format("#define BUFFER_{}\n", *drafts_[draft].buffer);
    else if (!others.buffers.empty() && viewer_buffers_.empty()) {
        for (size_t i = 0; i < others.buffers.size(); ++i) {
            Draft buffer;
            buffer.pass.kind = PassKind::buffer;
            buffer.pass.name = fmt::format("BUFFER_{}", i);
            buffer.file = drafts_[draft].file;
            buffer.buffer = i;
            viewer_buffers_.push_back(add(std::move(buffer)));
        }
        for (const size_t buffer : viewer_buffers_)
            TRY(load(buffer));
    }
    for (size_t i = 0; i < std::min(others.buffers.size(), viewer_buffers_.size()); ++i)
        if (others.buffers[i])
            drafts_[draft].pass.channels[*others.buffers[i]] = {
                PassOutput{viewer_buffers_[i]}, k_clamped, {}};
    return {};
}

Result<ChannelInput> PassLoader::input_of(size_t draft, const Channel& channel, const std::string& source) {
    if (source == "self")
        return PassOutput{draft};
    if (is_shader_file(source))
        return output_of_file(draft, (fs::path(channel.where.file).parent_path() / source).lexically_normal(),
                              channel.where);
    if (names_a_pass(source))
        return output_of_name(source, channel.where);
    ChannelInput found = channel.input;
    if (!find_faces(found))
        return fail(
            error_at(channel.where,
                     fmt::format("there are no six files for '{}': their names end in e w u d n s, in east "
                                 "west up down north south, in px nx py ny pz nz or in posx negx posy "
                                 "negy posz negz",
                                 source)));
    for (const fs::path& file : input_files(found))
        if (auto inside = bounds_.check(file); !inside)
            return fail(error_at(channel.where, inside.error().message));
    return found;
}

Result<ChannelInput> PassLoader::output_of_file(size_t reader, const fs::path& file,
                                                const SourceLocation& where) {
    for (size_t i = 0; i < drafts_.size(); ++i) {
        if (drafts_[i].file.empty() || !is_same_file(drafts_[i].file, file))
            continue;
        const bool waits = std::find(loading_.begin(), loading_.end(), i) != loading_.end();
        if (waits && i != reader && order_of_[i] == Order::by_reading)
            return fail(
                error_at(where, fmt::format("{}: files that read each other cannot be put in an order; a "
                                            "file may read its own last frame as \"self\"",
                                            cycle_from(i))));
        return PassOutput{i};
    }
    if (auto inside = bounds_.check(file); !inside)
        return fail(error_at(where, inside.error().message));
    if (drafts_.size() >= k_most_passes)
        return fail(error_at(where, fmt::format("the scene has more than {} passes", k_most_passes)));
    Draft draft;
    draft.pass.kind = PassKind::buffer;
    draft.pass.name = unique_name(file);
    draft.file = file;
    const size_t added = add(std::move(draft), Order::by_reading);
    if (auto loaded = load(added); !loaded) {
        // the file itself cannot be read: the error is at the directive
        if (loaded.error().diagnostics.empty())
            return fail(error_at(where, loaded.error().message));
        return fail(std::move(loaded.error()));
    }
    return PassOutput{added};
}

Result<ChannelInput> PassLoader::output_of_name(const std::string& source,
                                                const SourceLocation& where) const {
    const auto wanted = parse_pass_name(source);
    const std::string name = wanted ? to_string(*wanted) : source;
    for (size_t i = 0; i < drafts_.size(); ++i)
        if (drafts_[i].pass.name == name)
            return PassOutput{i};
    return fail(error_at(where, fmt::format("there is no pass '{}': in a scene folder it is the file '{}'; a "
                                            "single file names another file by its path, as in \"blur.glsl\"",
                                            name, file_name_of(name))));
}

std::string PassLoader::unique_name(const fs::path& file) const {
    const auto is_free = [&](const std::string& name) {
        return std::none_of(drafts_.begin(), drafts_.end(),
                            [&](const Draft& draft) { return draft.pass.name == name; });
    };
    const std::string short_name = file.filename().string();
    return is_free(short_name) ? short_name : file.lexically_proximate(folder_).string();
}

std::string PassLoader::cycle_from(size_t draft) const {
    std::string chain;
    const auto first = std::find(loading_.begin(), loading_.end(), draft);
    for (auto waiting = first; waiting != loading_.end(); ++waiting)
        chain += fmt::format("'{}' reads ", drafts_[*waiting].file.filename().string());
    return chain + fmt::format("'{}'", drafts_[draft].file.filename().string());
}

Result<void> PassLoader::finish() {
    for (const Common& common : commons_) {
        const auto includes_it = [&](size_t draft) { return contains(included_[draft], common.file); };
        const bool is_included = std::any_of(order_.begin(), order_.end(), includes_it);
        if (!is_included) {
            scene_.common.append(common.text);
            continue;
        }
        for (const size_t draft : order_)
            if (!includes_it(draft)) {
                text::MappedText whole = common.text;
                whole.append(drafts_[draft].pass.text);
                drafts_[draft].pass.text = std::move(whole);
            }
    }
    return finish_scene(scene_, std::move(drafts_), order_);
}

} // namespace tidemark::scene
