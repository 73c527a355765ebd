#include "web/scene_data.hpp"

#include "base/try.hpp"
#include "web/input_data.hpp"
#include "web/knob_data.hpp"
#include "web/pass_data.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::web {
namespace {

using scene::PassKind;

/// Leaves a Sound pass only inputs that never change, like ShaderToy.
scene::Channel heard(const scene::Scene& scene, scene::Channel channel) {
    if (traits_of(channel.input).changes != scene::Changes::never)
        channel.input = scene::Unbound{texture_kind(scene, channel.input)};
    return channel;
}

Json sampler_of(const scene::Sampling& sampling) {
    constexpr std::string_view k_filter[] = {"nearest", "linear"};
    constexpr std::string_view k_mipmaps[] = {"none", "nearest", "linear"};
    constexpr std::string_view k_wrap[] = {"repeat", "clamp", "mirror"};
    return {{"magnify", k_filter[size_t(sampling.magnify)]},
            {"minify", k_filter[size_t(sampling.minify)]},
            {"mipmaps", k_mipmaps[size_t(sampling.mipmaps)]},
            {"wrap", k_wrap[size_t(sampling.wrap)]}};
}

class Collector {
public:
    explicit Collector(const scene::Scene& scene)
        : scene_(scene), named_(scene.passes.size()), place_(scene.passes.size(), k_nowhere) {}

    Result<Json> collect() {
        need(scene_.image_index());
        if (const scene::Pass* sound = scene_.find(PassKind::sound))
            need(size_t(sound - scene_.passes.data()));
        number_passes();
        Json passes = Json::array();
        for (size_t pass = 0; pass < place_.size(); ++pass) {
            if (place_[pass] == k_nowhere)
                continue;
            Json data = pass_data(scene_, scene_.passes[pass]);
            data["channels"] = TRY(channels_of(pass));
            passes.push_back(std::move(data));
        }
        Json knobs = Json::array();
        for (const scene::Knob& knob : scene_.knobs)
            knobs.push_back(knob_data(knob));
        Json data{{"name", scene_.name()},
                  {"passes", std::move(passes)},
                  {"inputs", std::move(inputs_)},
                  {"knobs", std::move(knobs)}};
        if (scene_.size)
            data["size"] = {scene_.size->width, scene_.size->height};
        return data;
    }

private:
    static constexpr size_t k_nowhere = size_t(-1);
    static constexpr size_t k_needed = 0;

    void need(size_t pass) {
        if (place_[pass] == k_needed)
            return;
        place_[pass] = k_needed;
        named_[pass] = channels_named(scene_, scene_.passes[pass]);
        for (const size_t channel : named_[pass])
            if (const size_t* source = source_pass(scene_.passes[pass].channels[channel].input))
                need(*source);
    }

    /// Numbers the needed passes in their order on the page.
    void number_passes() {
        size_t count = 0;
        for (size_t& place : place_)
            if (place == k_needed)
                place = count++;
    }

    Result<Json> channels_of(size_t pass) {
        Json channels = Json::array();
        for (const size_t number : named_[pass]) {
            const scene::Channel& given = scene_.passes[pass].channels[number];
            const scene::Channel channel =
                scene_.passes[pass].kind == PassKind::sound ? heard(scene_, given) : given;
            Json data = {{"number", number}, {"sampler", sampler_of(channel.sampling)}};
            if (const size_t* source = source_pass(channel.input))
                data["pass"] = place_[*source];
            else
                data["input"] = TRY(place_of(channel));
            channels.push_back(std::move(data));
        }
        return channels;
    }

    /// Returns the index among the inputs; several channels share an equal input.
    Result<size_t> place_of(const scene::Channel& channel) {
        const auto known = std::ranges::find_if(known_, [&](const scene::Channel& other) {
            return other.input == channel.input && other.sampling.vflip == channel.sampling.vflip;
        });
        if (known != known_.end())
            return size_t(known - known_.begin());
        inputs_.push_back(TRY(input_data(channel)));
        known_.push_back(channel);
        return known_.size() - 1;
    }

    const scene::Scene& scene_;
    std::vector<std::vector<size_t>> named_; ///< channels that each pass's text names
    std::vector<size_t> place_;              ///< index of each pass on the page
    std::vector<scene::Channel> known_;
    Json inputs_ = Json::array();
};

} // namespace

Result<Json> scene_data(const scene::Scene& scene) {
    return Collector(scene).collect();
}

} // namespace tidemark::web
