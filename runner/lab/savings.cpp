#include "lab/savings.hpp"

#include "image/files/png_codec.hpp"
#include "lab/stopwatch.hpp"

#include <GL/glcorearb.h>

#include <array>

namespace tidemark::lab {
namespace {

constexpr int k_frame = 60; ///< the first that is drawn: everything moves by then
constexpr int k_frames_before = 10;
constexpr size_t k_most_rounds = 60;

constexpr Omission k_omissions[] = {
    {"passes", "passes that nobody reads, drawn", [](Way& way) { way.options.extras.passes = true; }},
    {"unchanged", "passes that read what they read in the frame before, drawn",
     [](Way& way) { way.options.extras.unchanged = true; }},
    {"frames", "ten frames before the one that is wanted, drawn",
     [](Way& way) { way.frames_before = k_frames_before; }},
    {"uniforms", "uniforms and knobs that the programs do not have, handed over",
     [](Way& way) { way.options.extras.uniforms = true; }},
    {"channels", "pictures, noise and sounds that the programs do not read, loaded",
     [](Way& way) { way.options.extras.channels = true; }},
    {"mipmaps", "mipmaps of buffers that nobody filters between, made",
     [](Way& way) { way.options.extras.mipmaps = true; }},
    {"second-textures", "a second texture for buffers that do not read themselves",
     [](Way& way) { way.options.extras.second_textures = true; }},
    {"code", "code that main cannot reach, compiled",
     [](Way& way) { way.options.specialise = glsl::Specialise::nothing; }},
    {"alpha", "alpha that is 1 all over, encoded", [](Way& way) { way.alpha = true; }},
};

render::FrameInputs inputs_of(int frame) {
    return render::inputs_of_frame(frame, render::FrameInputs{}.frame_rate);
}

/// A frame as it is written.
struct Encoded {
    std::vector<unsigned char> file;
    Elapsed time;

    /// What is in it, without alpha; the encoder's own files have no errors.
    image::Image colours() const {
        const auto picture = image::decode_png(std::as_bytes(std::span(file)));
        return picture->has_alpha() ? image::without_alpha(*picture) : *picture;
    }
};

Result<Encoded> encode(const image::Image& picture, bool opaque_alpha_too) {
    const Stopwatch watch;
    const bool alpha = opaque_alpha_too || !image::has_opaque_alpha(picture);
    image::Image stored = alpha ? picture : image::without_alpha(picture);
    auto file = image::encode_png({image::FileFormat::png,
                                   image::SampleDepth::u8,
                                   stored.extent,
                                   stored.channels,
                                   std::move(stored.bytes),
                                   {}});
    if (!file)
        return fail(ErrorCode::write, file.error());
    return Encoded{*std::move(file), watch.elapsed()};
}

/// A way of drawing a scene that is drawn and timed.
class Contender {
public:
    Contender(const scene::Scene& scene, Way way) : scene_(scene), way_(std::move(way)) {}

    /// From the scene to its first frame.
    Result<Elapsed> start() {
        renderer_.reset();
        const Stopwatch watch;
        auto renderer = render::Renderer::create(scene_, way_.options);
        if (!renderer)
            return fail(std::move(renderer.error()));
        renderer_ = *std::move(renderer);
        renderer_->draw(inputs_of(k_frame));
        glFinish();
        return watch.elapsed();
    }

    Elapsed draw(int frame) {
        const Stopwatch watch;
        for (int before = way_.frames_before; before >= 0; --before)
            renderer_->draw(inputs_of(frame - before));
        glFinish();
        return watch.elapsed();
    }

    image::Image picture() const { return renderer_->read_back(); }
    Result<Encoded> encoded() const { return encode(picture(), way_.alpha); }
    bool steps() const { return renderer_->plan().feedback; }

    render::FrameWork work() const {
        render::FrameWork work = renderer_->work();
        work.draws *= size_t(way_.frames_before + 1);
        work.uniforms *= size_t(way_.frames_before + 1);
        work.channels *= size_t(way_.frames_before + 1);
        return work;
    }

private:
    scene::Scene scene_;
    Way way_;
    std::optional<render::Renderer> renderer_;
};

/// Rounds of both ways; which of them comes first changes with the round.
class Rounds {
public:
    void add(const Elapsed& without, const Elapsed& with_it) {
        wall_.add(without.wall, with_it.wall);
        cpu_.add(without.cpu, with_it.cpu);
    }
    size_t count() const { return wall_.without.size(); }
    SavedTime saved() const { return {wall_.saved(), cpu_.saved()}; }

private:
    struct Clock {
        std::vector<double> without;
        std::vector<double> more;

        void add(double time_without, double time_with) {
            without.push_back(time_without);
            more.push_back(time_with - time_without);
        }
        Saved saved() const { return {median(without), median(more), bootstrap_median(more)}; }
    };
    Clock wall_;
    Clock cpu_;
};

bool more_rounds(const Rounds& rounds, const Stopwatch& watch, double seconds) {
    return rounds.count() < k_fewest_runs ||
           (rounds.count() < k_most_rounds && watch.elapsed().wall < seconds * 1e3);
}

/// One round to warm the driver's cache, then those that count.
Result<SavedTime> time_starts(Contender& without, Contender& with_it, double seconds) {
    Rounds rounds;
    const Stopwatch watch;
    for (int round = 0; round == 0 || more_rounds(rounds, watch, seconds); ++round) {
        const bool swapped = round % 2 != 0;
        const auto first = (swapped ? with_it : without).start();
        const auto second = (swapped ? without : with_it).start();
        if (!first || !second)
            return fail(first ? second.error() : first.error());
        if (round > 0)
            rounds.add(swapped ? *second : *first, swapped ? *first : *second);
    }
    return rounds.saved();
}

SavedTime time_frames(Contender& without, Contender& with_it, double seconds, bool& same_pixels) {
    Rounds rounds;
    const Stopwatch watch;
    for (int frame = k_frame + 2; more_rounds(rounds, watch, seconds); ++frame) {
        Contender& first = frame % 2 ? without : with_it;
        Contender& second = frame % 2 ? with_it : without;
        const Elapsed costs[] = {first.draw(frame), second.draw(frame)};
        rounds.add(costs[frame % 2 ? 0 : 1], costs[frame % 2 ? 1 : 0]);
        same_pixels = same_pixels && without.picture().bytes == with_it.picture().bytes;
    }
    return rounds.saved();
}

/// Encoding alone: the drawing between is nobody's.
Result<SavedTime> time_files(Contender& without, Contender& with_it, double seconds, bool& same_pixels) {
    Rounds rounds;
    const Stopwatch watch;
    for (int frame = k_frame + 2; more_rounds(rounds, watch, seconds); ++frame) {
        without.draw(frame);
        with_it.draw(frame);
        const bool in_turn = frame % 2 != 0;
        const auto first = (in_turn ? without : with_it).encoded();
        const auto second = (in_turn ? with_it : without).encoded();
        if (!first || !second)
            return fail(first ? second.error() : first.error());
        rounds.add((in_turn ? first : second)->time, (in_turn ? second : first)->time);
        same_pixels = same_pixels && first->colours().bytes == second->colours().bytes;
    }
    return rounds.saved();
}

Result<void> weigh_files(const Contender& without, const Contender& with_it, Saving& saving) {
    const auto small = without.encoded();
    const auto large = with_it.encoded();
    if (!small || !large)
        return fail(small ? large.error() : small.error());
    saving.without.file_bytes = small->file.size();
    saving.with_it.file_bytes = large->file.size();
    return {};
}

Result<void> time_all(Contender& without, Contender& with_it, double seconds, Saving& saving) {
    const double share = seconds / (saving.in_frame() ? saving.in_file() ? 3 : 2 : 1);
    if (saving.in_frame()) {
        auto start = time_starts(without, with_it, share);
        if (!start)
            return fail(std::move(start.error()));
        saving.start = *start;
        saving.frame = time_frames(without, with_it, share, saving.same_pixels);
    }
    if (saving.in_file()) {
        auto file = time_files(without, with_it, share, saving.same_pixels);
        if (!file)
            return fail(std::move(file.error()));
        saving.file = *file;
    }
    return {};
}

} // namespace

std::span<const Omission> omissions() {
    return k_omissions;
}

Result<Saving> measure_saving(const scene::Scene& scene, const render::RenderOptions& options,
                              std::span<const Omission> things, double seconds) {
    Way way{options};
    Contender without(scene, way);
    if (auto started = without.start(); !started)
        return fail(std::move(started.error()));
    for (const Omission& thing : things)
        thing.put_back(way);
    if (without.steps()) // a frame needs those before it: none is left out
        way.frames_before = 0;
    Contender with_it(scene, way);
    if (auto started = with_it.start(); !started)
        return fail(std::move(started.error()));
    without.draw(k_frame + 1); // a frame that another one precedes
    with_it.draw(k_frame + 1);
    Saving saving{{without.work()}, {with_it.work()}};
    if (way.alpha)
        if (auto weighed = weigh_files(without, with_it, saving); !weighed)
            return fail(std::move(weighed.error()));
    if (auto timed = time_all(without, with_it, seconds, saving); !timed)
        return fail(std::move(timed.error()));
    return saving;
}

} // namespace tidemark::lab
