#include "host/fingerprint.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "base/overloaded.hpp"
#include "host/console.hpp"
#include "host/scene_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <type_traits>

namespace tidemark::host {
namespace {

/// 64 bits: the probability that two of 1e8 different frames get the same hash is 3e-4.
constexpr size_t k_digits = 16;

constexpr std::string_view k_device = "device";

std::string hash_of(const std::string& bytes) {
    return sha256(std::as_bytes(std::span(bytes))).substr(0, k_digits);
}

std::string hash_of(const Json& json) {
    return hash_of(dump(json));
}

/// For a larger file, for example a film, only the beginning is hashed, with the size and the modification
/// time: a capture does not wait for all of it.
constexpr uintmax_t k_hashed_whole = uintmax_t{64} << 20;
constexpr size_t k_beginning = size_t{1} << 20;

/// Returns null if the file cannot be read; a silent signal has none.
Json facts_of_file(const std::filesystem::path& path) {
    std::error_code error;
    if (!why_unreadable(path).empty())
        return {};
    const uintmax_t size = std::filesystem::file_size(path, error);
    const bool whole = size <= k_hashed_whole;
    std::string bytes(whole ? size_t(size) : k_beginning, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(size_t(file.gcount()));
    const auto changed = std::filesystem::last_write_time(path, error).time_since_epoch().count();
    return Json::array({hash_of(bytes), size, whole ? Json() : Json(changed)});
}

/// Returns the settings of an input without its files, which count by their bytes. The structured bindings
/// fail to compile if a type gets a new member.
Json facts_of(const scene::ChannelInput& input) {
    using namespace scene;
    const Json facts =
        std::visit(Overloaded{[](const Picture& i) {
                                  const auto& [file, one_channel] = i;
                                  return Json(one_channel);
                              },
                              [](const StandIn& i) {
                                  const auto& [kind, width, height, channels] = i;
                                  return Json::array({int(kind), width, height, channels});
                              },
                              []<class T>(const T& i) {
                                  const auto& [only] = i;
                                  if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(only)>>)
                                      return Json(int(only));
                                  else if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(only)>>)
                                      return Json(only);
                                  else
                                      return Json(); // one or more files
                              }},
                   input);
    return Json::array({std::string(traits_of(input).name), facts});
}

Json facts_of(const scene::Sampling& sampling) {
    const auto& [magnify, minify, mipmaps, wrap, vflip] = sampling;
    return Json::array({int(magnify), int(minify), int(mipmaps), int(wrap), vflip});
}

Json text_facts(const scene::Scene& scene, const std::vector<std::string>& defines) {
    Json facts = Json::array({scene.common.text(), scene.moves_view, defines});
    for (const scene::Pass& pass : scene.passes)
        facts.push_back(Json::array(
            {int(pass.kind), pass.name, pass.text.text(), pass.keyboard_helpers, pass.bare_file}));
    return facts;
}

/// True if frames depend on recorded input through feedback: a buffer's content depends on all frames before,
/// and those on their recorded input.
bool has_history(const scene::Scene& scene, const FrameSequence& frames) {
    return frames.input && may_feed_back(scene);
}

Json input_facts(const scene::Scene& scene, const FrameSequence& frames) {
    Json facts = Json::array();
    for (const scene::Pass& pass : scene.passes)
        for (const scene::Channel& channel : pass.channels) {
            Json& fact =
                facts.emplace_back(Json::array({facts_of(channel.input), facts_of(channel.sampling)}));
            for (const std::filesystem::path& file : input_files(channel.input))
                fact.push_back(facts_of_file(file));
        }
    if (has_history(scene, frames))
        facts.push_back(facts_of_file(frames.input_file));
    return facts;
}

/// Returns the text that describes a difference in this part.
std::string_view words_of(std::string_view part) {
    constexpr std::pair<std::string_view, std::string_view> k_words[] = {
        {"version", "another version of Tidemark"},
        {k_device, "another device or driver"},
        {"text", "another text of the scene"},
        {"inputs", "other inputs"},
        {"knobs", "other knobs"},
        {"drawing", "other drawing options"},
        {"frame", "another time, size, mouse or camera"},
    };
    const auto* found =
        std::ranges::find(k_words, part, &std::pair<std::string_view, std::string_view>::first);
    return found == std::end(k_words) ? "something unknown to this version" : found->second;
}

} // namespace

Fingerprint Fingerprint::of_scene(const scene::Scene& scene, const std::vector<std::string>& defines,
                                  const FrameSequence& frames) {
    Fingerprint fingerprint;
    fingerprint.parts_ = {{"version", hash_of(std::string(k_version))},
                          {std::string(k_device), ""},
                          {"text", hash_of(text_facts(scene, defines))},
                          {"inputs", hash_of(input_facts(scene, frames))}};
    return fingerprint;
}

Fingerprint Fingerprint::of_scene(const scene::Scene& scene, const std::vector<std::string>& defines,
                                  const FrameSequence& frames, const gl::Capabilities& driver) {
    Fingerprint fingerprint = of_scene(scene, defines, frames);
    fingerprint.set_device(driver);
    return fingerprint;
}

void Fingerprint::set_device(const gl::Capabilities& driver) {
    for (auto& [part, hash] : parts_)
        if (part == k_device)
            hash = hash_of(Json::array({driver.device(), driver.version}));
}

void Fingerprint::add(std::string part, const Json& facts) {
    parts_.emplace_back(std::move(part), hash_of(facts));
}

Fingerprint Fingerprint::of_scene() const {
    Fingerprint scene = *this;
    std::erase_if(scene.parts_, [](const auto& part) {
        return part.first == "knobs" || part.first == "drawing" || part.first == "frame";
    });
    return scene;
}

Fingerprint Fingerprint::of_frame(const render::FrameState& state) const {
    Fingerprint frame = *this;
    frame.parts_.emplace_back("frame", hash_of(to_json(state)));
    return frame;
}

Fingerprint Fingerprint::of_frames(std::span<const render::FrameState> states) const {
    Json facts = Json::array();
    for (const render::FrameState& state : states)
        facts.push_back(hash_of(to_json(state)));
    Fingerprint frames = *this;
    frames.parts_.emplace_back("frame", hash_of(facts));
    return frames;
}

std::string Fingerprint::text() const {
    std::string text;
    for (const auto& [name, hash] : parts_)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, hash);
    return text;
}

Fingerprint Fingerprint::parse(std::string_view text) {
    Fingerprint fingerprint;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        const size_t equals = std::min(word.find('='), word.size());
        fingerprint.parts_.emplace_back(word.substr(0, equals),
                                        word.substr(std::min(equals + 1, word.size())));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
    }
    return fingerprint;
}

const std::string* Fingerprint::find(std::string_view part) const {
    const auto found = std::ranges::find(parts_, part, &std::pair<std::string, std::string>::first);
    return found == parts_.end() ? nullptr : &found->second;
}

Fingerprint Fingerprint::on_device_of(const Fingerprint& other) const {
    Fingerprint moved = *this;
    const std::string* device = other.find(k_device);
    for (auto& [part, hash] : moved.parts_)
        if (part == k_device && device)
            hash = *device;
    return moved;
}

std::string Fingerprint::device() const {
    const std::string* device = find(k_device);
    return device ? *device : "";
}

std::string Fingerprint::differences(const Fingerprint& other) const {
    std::vector<std::string_view> words;
    const auto add = [&](const std::string& part) {
        const std::string_view word = words_of(part);
        if (std::ranges::find(words, word) == words.end())
            words.push_back(word);
    };
    for (const auto& [part, hash] : parts_)
        if (const std::string* others = other.find(part); !others || *others != hash)
            add(part);
    for (const auto& [part, hash] : other.parts_)
        if (!find(part))
            add(part);
    return fmt::format("{}", fmt::join(words, ", "));
}

} // namespace tidemark::host
