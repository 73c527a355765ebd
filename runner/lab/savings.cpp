#include "lab/savings.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "media/picture_codecs.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

constexpr int k_first_frame = 60; ///< first frame drawn: late enough for everything to move
constexpr int k_frames_before = 10;
constexpr size_t k_most_timings = 60;

constexpr Omission k_omissions[] = {
    {"passes", "passes that nothing reads, drawn", [](Way& way) { way.options.extras.passes = true; }},
    {"unchanged", "passes whose inputs are unchanged, drawn",
     [](Way& way) { way.options.extras.unchanged = true; }},
    {"frames", "ten frames before the wanted one, drawn",
     [](Way& way) { way.frames_before = k_frames_before; }},
    {"uniforms", "uniforms and knobs that the programs do not have, set",
     [](Way& way) { way.options.extras.uniforms = true; }},
    {"channels", "pictures, noise and sounds that the programs do not read, loaded",
     [](Way& way) { way.options.extras.channels = true; }},
    {"mipmaps", "mipmaps that no sampler reads, made", [](Way& way) { way.options.extras.mipmaps = true; }},
    {"second-textures", "a second texture for buffers that do not read themselves",
     [](Way& way) { way.options.extras.second_textures = true; }},
    {"code", "code that main cannot reach, compiled",
     [](Way& way) { way.options.specialise = glsl::Specialise::nothing; }},
    {"alpha", "alpha that is 1 everywhere, encoded", [](Way& way) { way.alpha = true; }},
};

render::FrameInputs inputs_of(int frame) {
    return render::inputs_of_frame(frame, render::FrameInputs{}.frame_rate);
}

/// A frame's encoded file and the time for encoding it.
struct Encoded {
    std::vector<unsigned char> file;
    Elapsed time;

    /// Decodes the file and drops alpha. Files of our own encoder always decode.
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

/// One of the two ways to draw the scene, drawn and timed.
class Contender {
public:
    Contender(scene::Scene scene, Way way) : scene_(std::move(scene)), way_(std::move(way)) {}

    /// Creates the renderer and draws the first frame; returns the time for both.
    Result<Elapsed> start() {
        renderer_.reset();
        const Stopwatch watch;
        renderer_ = TRY(render::Renderer::create(scene_, way_.options));
        renderer_->draw(inputs_of(k_first_frame));
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
    int frames_before() const { return way_.frames_before; }
    void leave_no_frames_before() { way_.frames_before = 0; }

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

/// Times of both ways, one entry per round. Callers alternate which way is drawn first.
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

/// A time budget that starts at construction; wall-clock milliseconds.
class Allowance {
public:
    explicit Allowance(double milliseconds) : whole_(milliseconds) {}
    double left() const { return whole_ - watch_.elapsed().wall; }

    /// Returns whether to start another round, which should take as long as the last one. The first five
    /// rounds may use the whole budget, later ones only `share` milliseconds since the start.
    bool another(const Rounds& rounds, double last, double share) const {
        if (rounds.count() >= k_most_timings || left() < last)
            return false;
        return rounds.count() < k_fewest_runs || watch_.elapsed().wall + last < share;
    }

private:
    double whole_;
    Stopwatch watch_;
};

std::string too_few(const char* what, const Rounds& rounds) {
    return fmt::format("--budget is spent: {} {} of the {} rounds that a median needs", what, rounds.count(),
                       k_fewest_runs);
}

/// Estimated milliseconds per round, before the first one is measured.
struct Costs {
    double starts;
    double frames;
};

/// The two ways, and the measurements that are filled in.
struct Measuring {
    Contender& without;
    Contender& with_it;
    const Allowance& allowance;
    Saving& saving;

    /// Calls `round(number, rounds)`, which adds to the rounds, while the budget allows. Returns zeros and
    /// sets `saving.cut` if there were too few rounds.
    template <class Round>
    Result<SavedTime> repeat(const char* what, double share, double first, Round round) {
        Rounds rounds;
        double last = first;
        for (int number = 0; allowance.another(rounds, last, share); ++number) {
            const Stopwatch watch;
            TRY(round(number, rounds));
            last = watch.elapsed().wall;
        }
        if (rounds.count() >= k_fewest_runs)
            return rounds.saved();
        saving.cut = too_few(what, rounds);
        return SavedTime{};
    }

    /// Times starts; the first round only warms the driver's cache.
    Result<SavedTime> starts(double share, double first) {
        return repeat("starting:", share, first, [&](int number, Rounds& rounds) -> Result<void> {
            const bool swapped = number % 2 != 0;
            const auto one = (swapped ? with_it : without).start();
            const auto other = (swapped ? without : with_it).start();
            if (!one || !other)
                return fail(one ? other.error() : one.error());
            if (number > 0)
                rounds.add(swapped ? *other : *one, swapped ? *one : *other);
            return {};
        });
    }

    Result<SavedTime> frames(double share, double cost) {
        return repeat("a frame:", share, cost, [&](int number, Rounds& rounds) -> Result<void> {
            const int frame = k_first_frame + 2 + number;
            Contender& first = frame % 2 ? without : with_it;
            Contender& second = frame % 2 ? with_it : without;
            const Elapsed costs[] = {first.draw(frame), second.draw(frame)};
            rounds.add(costs[frame % 2 ? 0 : 1], costs[frame % 2 ? 1 : 0]);
            saving.same_pixels = saving.same_pixels && without.picture().bytes == with_it.picture().bytes;
            return {};
        });
    }

    /// Times encoding alone; drawing is not counted.
    Result<SavedTime> files(double share, double cost) {
        return repeat("encoding:", share, cost, [&](int number, Rounds& rounds) -> Result<void> {
            const int frame = k_first_frame + 2 + number;
            without.draw(frame);
            with_it.draw(frame);
            const bool in_turn = frame % 2 != 0;
            const auto first = (in_turn ? without : with_it).encoded();
            const auto second = (in_turn ? with_it : without).encoded();
            if (!first || !second)
                return fail(first ? second.error() : first.error());
            rounds.add((in_turn ? first : second)->time, (in_turn ? second : first)->time);
            saving.same_pixels = saving.same_pixels && first->colours().bytes == second->colours().bytes;
            return {};
        });
    }

    Result<void> all(double milliseconds, const Costs& costs) {
        const double share = milliseconds / (saving.in_frame() ? saving.in_file() ? 3 : 2 : 1);
        if (saving.in_frame()) {
            auto start = TRY(starts(share, costs.starts));
            saving.start = start;
            auto frame = TRY(frames(2 * share, costs.frames));
            saving.frame = frame;
        }
        if (saving.in_file()) {
            auto file = TRY(files(milliseconds, costs.frames));
            saving.file = file;
        }
        return {};
    }
};

Result<void> weigh_files(const Contender& without, const Contender& with_it, Saving& saving) {
    const auto small = without.encoded();
    const auto large = with_it.encoded();
    if (!small || !large)
        return fail(small ? large.error() : small.error());
    saving.without.file_bytes = small->file.size();
    saving.with_it.file_bytes = large->file.size();
    return {};
}

} // namespace

std::span<const Omission> omissions() {
    return k_omissions;
}

struct SavingsBench::Parts {
    scene::Scene scene;
    Way way;
    double start = 0; ///< milliseconds of one start; the least so far
};

SavingsBench::SavingsBench(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SavingsBench::SavingsBench(SavingsBench&&) noexcept = default;
SavingsBench::~SavingsBench() = default;

Result<SavingsBench> SavingsBench::create(const scene::Scene& scene, const render::RenderOptions& options) {
    const Way way{options};
    const auto started = TRY(Contender(scene, way).start());
    return SavingsBench(std::make_unique<Parts>(Parts{scene, way, started.wall}));
}

Result<Saving> SavingsBench::measure(std::span<const Omission> things, double seconds) {
    const Allowance allowance(1e3 * seconds);
    Way way = parts_->way;
    Contender without(parts_->scene, way);
    for (const Omission& thing : things)
        thing.put_back(way);
    Contender with_it(parts_->scene, way);
    Saving saving;
    const auto cut = [&](const char* what, double milliseconds) {
        saving.cut = fmt::format("--budget is spent: {:.2g} s are left, and {} {:.2g} s",
                                 std::max(allowance.left() / 1e3, 0.0), what, milliseconds / 1e3);
        return saving;
    };
    if (allowance.left() < 2 * parts_->start)
        return cut("starting takes", 2 * parts_->start);
    const auto one = without.start(), other = with_it.start();
    if (!one || !other)
        return fail(one ? other.error() : one.error());
    parts_->start = std::min(parts_->start, other->wall); // the driver's cache is warm now
    if (without.steps()) // a frame depends on those before it, so none is skipped
        with_it.leave_no_frames_before();
    const double frame = without.draw(k_first_frame + 1).wall; // a frame drawn right after another one
    const double frames = frame * (1 + with_it.frames_before());
    if (allowance.left() < frames)
        return cut("a frame with it takes", frames);
    with_it.draw(k_first_frame + 1);
    saving.without.frame = without.work();
    saving.with_it.frame = with_it.work();
    if (way.alpha)
        TRY(weigh_files(without, with_it, saving));
    const Costs costs{one->wall + other->wall, frame + frames};
    TRY(Measuring{without, with_it, allowance, saving}.all(1e3 * seconds, costs));
    return saving;
}

} // namespace tidemark::lab
