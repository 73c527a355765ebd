#include "cli/capture_output.hpp"

#include "base/error.hpp"
#include "base/software_renderer.hpp"
#include "host/console.hpp"
#include "host/frame_files.hpp"
#include "host/gl_context.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"
#include "media/sound_file.hpp"
#include "render/sound_renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

namespace tidemark::cli {
namespace {

void find(FrameRecords::Found& found, size_t pixels, const FrameRecord& record) {
    if (pixels == 0)
        return;
    ++found.count;
    if (!found.first)
        found.first = record;
}

} // namespace

void FrameRecords::add(FrameRecord record) {
    ++count_;
    if (!first_)
        first_ = record;
    find(not_finite_, record.not_finite, record);
    find(no_coverage_, record.no_coverage, record);
    if (listed_)
        list_.push_back(record);
    last_ = std::move(record);
}

namespace {

/// One frame is drawn while the previous one is copied and the one before that is encoded.
constexpr size_t k_depth = 2;

} // namespace

/// A driver that draws on the CPU copies pixels itself and waits for the drawing before: nothing more
/// overlaps, and there is one copy more (README.md in this folder has figures).
bool FramesAhead::pays(std::string_view renderer) {
    const char* const variable = std::getenv("TIDEMARK_READ_BACK");
    const std::string_view wish = variable ? variable : "";
    return wish == "ahead" || (wish != "at-once" && !is_software_renderer(renderer));
}

FramesAhead::FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit)
    : renderer_(renderer), dog_(dog), limit_(limit), ring_(k_depth) {}

bool FramesAhead::add(const FrameRecord& record, Watchdog::Clock::time_point begun) {
    if (!renderer_.read_ahead(ring_))
        return false;
    waiting_.push_back({record, begun});
    return true;
}

DrawnFrame FramesAhead::take() {
    Waiting oldest = std::move(waiting_.front());
    waiting_.pop_front();
    std::optional<Watchdog::Watch> watch;
    if (!ring_.ready())
        watch.emplace(dog_,
                      Watchdog::frame_task(oldest.record.frame, limit_, std::max(oldest.begun, last_taken_)));
    DrawnFrame frame{std::move(oldest.record), renderer_.take(ring_)};
    last_taken_ = Watchdog::Clock::now();
    return frame;
}

int frame_behind(const std::vector<int>& frames) {
    const int last = frames.back();
    return frames.size() > 1 ? 2 * last - frames[frames.size() - 2] : last + 1;
}

void LoopCheck::see(const image::Image& picture) {
    if (++seen_ == 1) {
        first_ = picture;
        return;
    }
    closing_ = image::compare(first_, picture)->psnr;
    if (seen_ == 2)
        step_ = closing_;
}

std::string LoopCheck::words() const {
    return fmt::format(
        "loop: {}; the frame after the last matches the first with {:.1f} dB (the second: {:.1f} dB)",
        closing_ >= step_ ? "seamless" : "jumps at the start", closing_, step_);
}

namespace {

constexpr size_t k_block_bytes = 1 << 18; ///< fits a processor's cache while it is filled and written

} // namespace

Result<void> put_raw(const image::Image& image) {
    const size_t row_bytes = size_t(image.extent.width) * 3;
    const size_t rows_at_once = std::max<size_t>(1, k_block_bytes / row_bytes);
    std::vector<std::byte> block;
    for (int row = image.extent.height; row > 0;) {
        const auto rows = int(std::min(rows_at_once, size_t(row)));
        block.resize(size_t(rows) * row_bytes);
        for (int i = 0; i < rows; ++i)
            copy_colours(image, --row, block.data() + size_t(i) * row_bytes);
        if (auto done = put(block); !done)
            return done;
    }
    return {};
}

void add_rows(Sha256& hash, const image::Image& image) {
    const std::span<const std::byte> bytes(image.bytes);
    for (auto row = size_t(image.extent.height); row-- > 0;)
        hash.add(bytes.subspan(row * image.row_bytes(), image.row_bytes()));
}

BandOutput::BandOutput(std::optional<image::PictureStream> stream, bool hashed) : stream_(std::move(stream)) {
    if (hashed)
        hash_.emplace();
}

Result<image::Image> BandOutput::take(image::Image band) {
    TRY(wait());
    std::swap(band, band_);
    writing_ = std::async(std::launch::async, [this] { return write(); });
    return band;
}

Result<void> BandOutput::write() {
    not_finite_ += image::take_non_finite(band_);
    if (band_.type == image::SampleType::f32)
        no_coverage_ += image::pixels_of_no_coverage(band_);
    if (hash_)
        add_rows(*hash_, band_);
    return stream_ ? stream_->add(band_) : put_raw(band_);
}

Result<void> BandOutput::wait() {
    return writing_.valid() ? writing_.get() : Result<void>();
}

Result<void> BandOutput::finish() {
    return wait().and_then([&] { return stream_ ? stream_->finish() : Result<void>(); });
}

namespace {

/// One picture of a pass that is not shown.
struct Source {
    std::string name;
    size_t pass;
    int face = 0;
    bool cube = false;
};

std::vector<Source> sources(const render::Renderer& renderer) {
    std::vector<Source> all;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = renderer.scene().passes[planned.pass];
        if (planned.pass == renderer.shown_index())
            continue;
        if (pass.kind != scene::PassKind::cubemap) {
            all.push_back({pass.name, planned.pass});
            continue;
        }
        for (int face = 0; face < int(k_face_names.size()); ++face)
            all.push_back(
                {fmt::format("{} {}", pass.name, k_face_names[size_t(face)]), planned.pass, face, true});
    }
    return all;
}

} // namespace

std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth) {
    const image::PictureFormat format{
        .depth = depth, .transfer = image::Transfer::data, .alpha = image::Alpha::straight};
    std::vector<image::PictureLayer> layers;
    for (const Source& source : sources(renderer)) {
        const image::Image drawn = renderer.read_floats(source.pass, source.face);
        // The first row of a face is its top row (image::CubeFaces).
        layers.push_back({source.name, source.cube ? image::flipped(drawn) : drawn, format});
    }
    return layers;
}

std::vector<std::string> layer_names(const render::Renderer& renderer) {
    std::vector<std::string> names{renderer.shown_pass().name};
    for (const Source& source : sources(renderer))
        names.push_back(source.name);
    return names;
}

Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt) {
    if (constexpr double k_last = render::SoundRenderer::k_longest_seconds; start + duration > k_last)
        return fail(
            ErrorCode::usage,
            fmt::format("sound cannot be longer than {} s, because iSampleOffset counts samples in an int",
                        k_last));
    auto renderer = TRY(render::SoundRenderer::create(scene, render::Date{}, precision));
    const auto count = 2 * size_t(std::llround(duration * render::k_sample_rate));
    const auto first = int(std::llround(start * render::k_sample_rate));
    const auto block = 2 * size_t(render::SoundRenderer::block_samples());
    std::vector<int16_t> samples;
    Progress progress("blocks of sound", (count + block - 1) / block);
    while (samples.size() < count && !interrupt.requested()) {
        const std::vector<int16_t> drawn = renderer.draw(first + int(samples.size() / 2));
        samples.insert(samples.end(), drawn.begin(), drawn.end());
        progress.advance();
    }
    samples.resize(count);
    return samples;
}

std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt) {
    if (!plan.output.video() || plan.shard) // `gather` draws it
        return std::nullopt;
    const std::vector<int>& frames = plan.frames.frames;
    const VideoPace& pace = plan.pace;
    const bool heard = plan.output.pattern().extension() != ".gif" && plan.scene.find(scene::PassKind::sound);
    if (!pace.not_in_time.empty())
        say(fmt::format("the video does not follow the scene's time: {}; it shows {:.4g} frames per second{}",
                        pace.not_in_time, pace.fps, heard ? "; it is silent" : ""));
    if (pace.holds)
        say(fmt::format("the frames are not evenly spaced: the video ({:.4g} frames per second) holds each "
                        "until the time of the next",
                        pace.fps));
    if (!heard || !pace.not_in_time.empty())
        return std::nullopt;
    const std::vector<int> shown = ticks_of(frames, pace);
    const auto ticks = std::accumulate(shown.begin(), shown.end(), size_t{0});
    const double first = plan.frames.state.at_frame(frames.front()).seconds();
    auto samples = draw_sound(plan.scene, plan.drawing.precision, std::max(0.0, first),
                              double(ticks) / pace.fps, interrupt);
    auto file = StagedFile::create(plan.output.of_frame(0), ".wav");
    Result<void> written = !file      ? fail(std::move(file.error()))
                           : !samples ? fail(std::move(samples.error()))
                                      : sound::write_wav(file->path(), int(render::k_sample_rate), *samples);
    if (written)
        return *std::move(file);
    say("the video is silent: " + to_string(written.error()));
    return std::nullopt;
}

Result<int> capture_sound(const SoundPlan& plan) {
    const Interrupt interrupt;
    const auto context = TRY(platform::HeadlessContext::create(plan.device));
    const auto samples = TRY(draw_sound(plan.scene, plan.precision, 0, plan.duration, interrupt));
    if (interrupt.requested())
        return Interrupt::k_exit_code;
    TRY(sound::write_wav(plan.output, int(render::k_sample_rate), samples));
    say(fmt::format("wrote {}", plan.output.string()));
    return 0;
}

} // namespace tidemark::cli
