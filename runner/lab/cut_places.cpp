#include "base/error.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/simplify.hpp"
#include "lab/text_findings.hpp"
#include "render/frame_stepper.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/cuts.hpp"
#include "shader/rewrite.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

namespace tidemark::lab {
namespace {

/// Limit for one pass: each expression costs one drawing of every view.
constexpr size_t k_most_replaced = 32;

/// The mean of an expression's last values, component by component.
struct Mean {
    std::array<double, 4> sums{};
    double count = 0;

    void add(const image::Image& picture) {
        const auto samples = picture.f32();
        for (size_t i = 0; i + 3 < samples.size(); i += 4) {
            if (!std::isfinite(samples[i] + samples[i + 1] + samples[i + 2] + samples[i + 3]))
                continue;
            for (size_t k = 0; k < 4; ++k)
                sums[k] += samples[i + k];
            ++count;
        }
    }
    std::vector<double> values(int number) const {
        std::vector<double> values;
        for (int k = 0; k < number; ++k)
            values.push_back(sums[size_t(k)] / count);
        return values;
    }
};

/// A pass's text, parsed.
struct Followed {
    std::unique_ptr<const glsl::ParsedText> text;
    glsl::TreeFacts facts;
    glsl::Cutter cutter;

    explicit Followed(std::unique_ptr<const glsl::ParsedText> read)
        : text(std::move(read)), facts(glsl::find_facts(*text)), cutter(*text, facts) {}
};

/// Returns the samplers by which a pass reads the buffer `read`; nullopt if a sampler depends on the buffer's
/// size (mipmaps or mirrored repeat).
std::optional<std::vector<glsl::BufferSampler>> samplers_of(const scene::Pass& pass, size_t read) {
    std::vector<glsl::BufferSampler> samplers;
    for (size_t i = 0; i < pass.channels.size(); ++i) {
        const scene::Channel& channel = pass.channels[i];
        const size_t* const source = scene::source_pass(channel.input);
        if (!source || *source != read)
            continue;
        if (channel.sampling.mipmaps != scene::Mipmaps::none || channel.sampling.wrap == scene::Wrap::mirror)
            return std::nullopt;
        samplers.push_back({scene::k_channel_names[i], channel.sampling.wrap == scene::Wrap::repeat});
    }
    return samplers;
}

class PlaceFinder {
public:
    PlaceFinder(const scene::Scene& scene, const std::vector<View>& views, const KeepGoing& keep_going)
        : scene_(scene), views_(views), keep_going_(keep_going) {}

    Result<CutPlaces> run(Extent extent) {
        auto renderer =
            TRY(render::Renderer::create(scene_, {.extent = extent, .samples = image::SampleType::f32}));
        for (const render::PlannedPass& planned : renderer.plan().passes)
            add_pass(renderer, planned.pass);
        for (const auto& [pass, followed] : followed_)
            if (scene_.passes[pass].kind == scene::PassKind::buffer)
                add_half_size(pass);
        std::ranges::stable_sort(found_.cuts, std::greater<>(), [](const glsl::Cut& cut) {
            return std::pair(cut.keeps_values, cut.work * cut.chance);
        });
        return std::move(found_);
    }

private:
    void add_pass(render::Renderer& renderer, size_t pass) {
        const std::string& name = scene_.passes[pass].name;
        auto text = read_text(renderer, pass, true);
        if (!text) {
            found_.left.push_back(
                fmt::format("{}: the text cannot be analysed: {}", name, to_string(text.error())));
            return;
        }
        const Followed& followed = followed_.try_emplace(pass, *std::move(text)).first->second;
        const auto& [parsed, facts, cutter] = followed;
        for (const glsl::NodeId loop : cutter.endless()) {
            const SourceLocation where = parsed->spelled(parsed->tree()[loop].begin);
            found_.left.push_back(fmt::format("{}:{}: this loop may be endless by its head: its body and the "
                                              "functions that it calls are left unchanged",
                                              where.file, where.line));
        }
        for (glsl::Cut& cut : cutter.cuts())
            add(std::move(cut));
        for (glsl::Cut& cut : cutter.levels(which_have_mipmaps(scene_.passes[pass])))
            add(std::move(cut));
        if (auto cut = glsl::once_a_pixel(*parsed, facts, cutter.work()))
            add(*std::move(cut));
        if (scene_.passes[pass].kind != scene::PassKind::cubemap)
            add_replaced(renderer, pass, *parsed, cutter);
    }

    void add_half_size(size_t buffer) {
        std::vector<glsl::BufferReader> readers;
        size_t own = 0;
        for (size_t pass = 0; pass < scene_.passes.size(); ++pass) {
            const auto samplers = samplers_of(scene_.passes[pass], buffer);
            const auto followed = followed_.find(pass);
            if (!samplers || (followed == followed_.end() && !samplers->empty()))
                return;
            if (pass == buffer)
                own = readers.size();
            if (followed != followed_.end())
                readers.push_back({*followed->second.text, followed->second.facts, *samplers});
        }
        if (auto cut = glsl::half_size(readers, own, followed_.at(buffer).cutter.work()))
            add(*std::move(cut));
    }

    /// Adds a cut once: Common is part of several passes.
    void add(glsl::Cut cut) {
        const glsl::Wrap& wrap = cut.change.wraps.front();
        std::string words;
        for (const glsl::Wrap& each : cut.change.wraps)
            words += each.front;
        const auto place = [](const glsl::WrittenWord& word) {
            return std::tuple(word.where.file, word.where.line, word.where.column);
        };
        if (known_.insert({place(wrap.first), place(wrap.last), words}).second)
            found_.cuts.push_back(std::move(cut));
    }

    void add_replaced(render::Renderer& renderer, size_t pass, const glsl::ParsedText& text,
                      const glsl::Cutter& cutter) {
        std::vector<glsl::Replaceable> all = cutter.replaceables();
        all.resize(std::min(all.size(), k_most_replaced));
        const auto means = means_of(renderer, pass, text, all);
        if (!means) {
            found_.left.push_back(fmt::format("{}: no expression was replaced by a number: {}",
                                              scene_.passes[pass].name, to_string(means.error())));
            return;
        }
        for (size_t i = 0; i < means->size(); ++i)
            if ((*means)[i].count > 0)
                add(cutter.replaced(all[i], (*means)[i].values(all[i].type.rows)));
    }

    /// Returns the means over all views; empty if the text has no place for them.
    Result<std::vector<Mean>> means_of(render::Renderer& renderer, size_t pass, const glsl::ParsedText& text,
                                       const std::vector<glsl::Replaceable>& all) {
        std::vector<glsl::NodeId> nodes;
        for (const glsl::Replaceable& each : all)
            nodes.push_back(each.node);
        const glsl::SeenValues seen = glsl::see_values(text, nodes, glsl::k_output);
        std::vector<Mean> means(seen.text.empty() ? 0 : all.size());
        std::optional<StandIn> stand_in;
        for (const View& view : views_) {
            if (means.empty() || !keep_going_())
                break;
            const render::FrameState state = state_of(view, renderer.extent());
            const PassPreview preview = render::FrameStepper(renderer, state).preview(state.frame, pass);
            if (!stand_in)
                stand_in = TRY(StandIn::link(preview, seen.text, "the text that shows its values"));
            for (size_t i = 0; i < means.size() && keep_going_(); ++i) {
                stand_in->set(seen.which_uniform, double(i));
                stand_in->draw(preview);
                means[i].add(stand_in->picture());
            }
        }
        return means;
    }

    const scene::Scene& scene_;
    const std::vector<View>& views_;
    const KeepGoing& keep_going_;
    CutPlaces found_{};
    std::map<size_t, Followed> followed_{}; ///< by pass
    std::set<std::tuple<std::tuple<std::string, int, int>, std::tuple<std::string, int, int>, std::string>>
        known_{};
};

std::pair<int, int> begin_of(const glsl::Wrap& wrap) {
    return {wrap.first.where.line, wrap.first.where.column};
}
std::pair<int, int> end_of(const glsl::Wrap& wrap) {
    return {wrap.last.where.line, wrap.last.where.column};
}

} // namespace

Result<CutPlaces> find_cuts(const scene::Scene& scene, const std::vector<View>& views, Extent extent,
                            const KeepGoing& keep_going) {
    return PlaceFinder(scene, views, keep_going).run(extent);
}

bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer) {
    return std::ranges::all_of(inner.wraps, [&](const glsl::Wrap& in) {
        return std::ranges::any_of(outer.wraps, [&](const glsl::Wrap& out) {
            return in.first.where.file == out.first.where.file && begin_of(out) <= begin_of(in) &&
                   end_of(in) <= end_of(out);
        });
    });
}

} // namespace tidemark::lab
